"""Where results come from: commit, versions, platform and time. Beside the results, never in them."""

import platform
import subprocess
import sys
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any


def session(command: Sequence[str], sources: Path, packages: Sequence[str]) -> dict[str, Any]:
    """Describe a session that starts now.

    Args:
        command: what was asked for.
        sources: folder of the code; its git commit is noted if it has one.
        packages: names of the distributions whose versions matter.
    """
    return {
        "command": list(command),
        "commit": _git(sources, "rev-parse", "HEAD"),
        "changed_files": bool(_git(sources, "status", "--porcelain", "--", ".")),
        "packages": {name: _version(name) for name in packages},
        "platform": platform.platform(),
        "python": sys.version.split()[0],
        "started_at": datetime.now(UTC).isoformat(timespec="seconds"),
    }


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def _git(folder: Path, *arguments: str) -> str | None:
    # A package in site-packages may lie inside somebody else's repository: only tracked sources count.
    try:
        for line in (("ls-files", "--error-unmatch", "__init__.py"), arguments):
            answer = subprocess.run(["git", *line], cwd=folder, capture_output=True, text=True, timeout=10, check=True)
    except (OSError, subprocess.SubprocessError):
        return None
    return answer.stdout.strip()
