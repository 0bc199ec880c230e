"""Where results go if nobody says."""

import os
import re
from pathlib import Path

WINDOWS = os.name == "nt"
STRANGE = re.compile(r"[^\w.+-]+")
UNWELCOME = re.compile(r'[<>:"/\\|?*@]+')  # in the name of a folder on Windows; @ is only awkward to type there


def results_folder(system: str, identity: str, windows: bool = WINDOWS) -> Path:
    """Return the folder of a configuration's runs: formicarium-results/SYSTEM-IDENTITY, eight digits of it.

    A name with failures, "mark-i3+kill:3@120", stays as it is but on Windows: "mark-i3+kill-3-120" there.
    """
    name = UNWELCOME.sub("-", system) if windows else system
    return Path("formicarium-results") / f"{name}-{identity[:8]}"


def named_folder(kind: str, name: str, *more: str) -> Path:
    """Return formicarium-results/KIND-NAME-MORE for a name that a person gave: never a path out of it."""
    short = STRANGE.sub("-", name).strip("-.").encode()[:80].decode(errors="ignore").strip("-.")
    return Path("formicarium-results") / "-".join((kind, short or "own", *more))
