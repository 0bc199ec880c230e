"""Laying out the files of a new system under its own name."""

import keyword
import re
import shutil
import tempfile
from importlib.util import find_spec
from pathlib import Path

from formicarium.commands.errors import UserError
from formicarium.systems.registry import names

LAYOUT = Path(__file__).parent / "layout"
KINDS = {".py", ".toml", ".md"}
NAME, MODULE = "own-swarm", "own_swarm"  # as they stand in the layout


def lay_out(name: str) -> tuple[Path, str]:
    """Write the files of a system called ``name``; return their folder and the name of the package in it.

    The folder is whole or not there at all.

    Raises:
        UserError: if the name cannot be used, or the folder is there already.
    """
    if not re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", name):
        raise UserError(f"new {name}: a name has small letters, digits and single hyphens, for example my-swarm")
    module, folder = name.replace("-", "_"), Path(name)
    if folder.exists():
        raise UserError(f"new {name}: there is a {name} in this folder already; choose another name or place")
    if name in names():
        raise UserError(f"new {name}: a system has that name already; choose another")
    if keyword.iskeyword(module) or find_spec(module) is not None:
        raise UserError(f"new {name}: Python knows {module} already, as a word or a module; choose another name")
    try:
        with tempfile.TemporaryDirectory(prefix=f".{name}-", dir=".") as temporary:
            made = Path(temporary) / name
            for file in sorted(LAYOUT.rglob("*")):
                if file.suffix in KINDS:  # nothing that a tool or an editor has left there
                    place = made / str(file.relative_to(LAYOUT)).replace(MODULE, module)
                    place.parent.mkdir(parents=True, exist_ok=True)
                    text = file.read_text(encoding="utf-8")
                    place.write_text(text.replace(NAME, name).replace(MODULE, module), encoding="utf-8")
            shutil.move(made, folder)
    except OSError as error:
        raise UserError(f"new {name}: cannot write {folder}: {error}") from error
    return folder, module
