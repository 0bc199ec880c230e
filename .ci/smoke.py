"""Check an installed formicarium: it runs, and what its extras bring can be imported. Arguments: names of extras."""

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from importlib import import_module
from pathlib import Path

import formicarium
from formicarium.commands.extras import MODULES

COMMAND = shutil.which("formicarium", path=sysconfig.get_path("scripts"))
RUN = ["run", "mark-i3", "--seed", "1", "--set", "time_cap=60", "--workers", "1", "--out", "smoke"]


def main(extras: list[str]) -> None:
    """Run a minute of Mark I3 in an empty folder and look at its results."""
    assert COMMAND is not None, f"there is no command formicarium in {sysconfig.get_path('scripts')}"
    assert "site-packages" in Path(formicarium.__file__).parts, f"{formicarium.__file__} is not installed"
    for name in [name for extra in extras for name in MODULES.get(extra, ())]:
        import_module(name)
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as place:
        os.chdir(place)
        subprocess.run([COMMAND, *RUN], check=True)
        results = formicarium.load_results("smoke")
        assert results.columns["seed"].tolist() == [1] and results.columns["duration_s"].tolist() == [60.0]
        os.chdir(before)  # not everywhere can a folder be removed in which somebody stands
    print(f"formicarium {formicarium.__version__} runs with Python {sys.version.split()[0]}", *extras)


if __name__ == "__main__":
    main(sys.argv[1:])
