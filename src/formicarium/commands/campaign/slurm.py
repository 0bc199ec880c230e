"""A plain Slurm job array: each task of it runs its share of a campaign; no scheduler process is needed."""

import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from formicarium.campaigns.files import write_text
from formicarium.commands.campaign.study import Overrides, Study
from formicarium.commands.errors import UserError

SCRIPT = """#!/bin/bash
#SBATCH --job-name={name}
#SBATCH --array=0-{last}
#SBATCH --cpus-per-task={workers}
#SBATCH --output="{folder}/slurm/%A_%a.log"
{options}
# Written by: formicarium campaign run --slurm-array {tasks}
# Submit with: sbatch {script}
# Task k does runs k, k + {tasks}, k + 2 * {tasks}, ... of the design. Submit it again if tasks were lost: what is done
# is not repeated.
cd {here}
exec {command} --share "$SLURM_ARRAY_TASK_ID/{tasks}"
"""


def write_script(
    study: Study, overrides: Overrides, tasks: int, workers: int, more: Sequence[str], sbatch: Sequence[str]
) -> Path:
    """Write ``slurm.sh`` into the folder of the campaign and return its path.

    Args:
        study: what is run.
        overrides: of the command line; every task gets them too.
        tasks: of the array.
        workers: processes of each task.
        more: other words of the command that every task gets.
        sbatch: options for Slurm ("--time=01:00:00"), a line each.

    Raises:
        UserError: if an option is not one.
        StoreError: if the script cannot be written.
    """
    if tasks < 1:
        raise UserError(f"--slurm-array {tasks}: must be at least 1")
    for option in sbatch:
        if not option.startswith("-") or "\n" in option:
            raise UserError(f"--sbatch {option!r}: expected an option of sbatch, for example --sbatch=--time=01:00:00")
    folder = study.folder.resolve()
    words = [sys.executable, "-m", "formicarium.commands.main", "campaign", "run", str(Path(study.source).resolve())]
    words += ["--out", str(folder), "--workers", str(workers), *overrides.words]
    script = folder / "slurm.sh"
    text = SCRIPT.format(
        name=study.design.name,
        last=tasks - 1,
        workers=workers,
        folder=folder,
        options="".join(f"#SBATCH {option}\n" for option in sbatch),
        tasks=tasks,
        script=shlex.quote(str(script)),
        here=shlex.quote(str(Path.cwd())),
        command=shlex.join([*words, *more]),
    )
    write_text(folder / "slurm" / "README.txt", "What the tasks of slurm.sh said, one file a task.\n")
    write_text(script, text)
    return script
