"""The command ``formicarium``: its verbs, and one clear message for everything that goes wrong.

Exit codes: 0 all well, 1 a run failed or something unexpected happened, 2 bad input, 130 interrupted.
Nothing heavy is imported before a verb needs it, so that ``--help`` answers at once.
"""

import sys
import tempfile
import traceback
from collections.abc import Sequence
from pathlib import Path

from cyclopts import App, CycloptsError

from formicarium import __version__
from formicarium.campaigns.errors import CrewError, DesignError, Explained, Futile
from formicarium.campaigns.files import StoreError
from formicarium.commands.campaign import campaign
from formicarium.commands.check import check
from formicarium.commands.connectivity import connectivity
from formicarium.commands.debug import debug
from formicarium.commands.describe import describe
from formicarium.commands.diff import diff
from formicarium.commands.doctor import doctor
from formicarium.commands.errors import UserError
from formicarium.commands.export import export
from formicarium.commands.movie import movie
from formicarium.commands.new import new
from formicarium.commands.onboard import onboard
from formicarium.commands.replay import replay
from formicarium.commands.run import run
from formicarium.commands.schedule import schedule
from formicarium.commands.study import study
from formicarium.commands.systems import systems
from formicarium.commands.tune import tune
from formicarium.commands.watch import watch
from formicarium.scheduling.instance import InstanceError

HELP = """Robot swarms that organise their own work: run, watched, measured and compared.

Start here:

    formicarium systems                     which systems there are
    formicarium run mark-i3                 one run, with pictures
    formicarium run mark-i3 --runs 30       thirty runs on all cores
    formicarium watch mark-i3               one run on a live page
    formicarium describe mark-i3            every number --set can change
    formicarium campaign --help             studies of many settings and many runs
    formicarium study sequencing            a published study again, beside the paper's figures
    formicarium new my-swarm                a system of your own, laid out and working
    formicarium connectivity FILE           how connected a graph is, and what its nodes can find out
    formicarium schedule tasks.toml         tasks for a connected swarm, scheduled and proven
"""

app = App(
    name="formicarium",
    version=__version__,
    help=HELP,
    help_format="plaintext",
    help_flags=["--help", "-h"],
    suppress_keyboard_interrupt=False,
)
app.command(run)
app.command(watch)
app.command(replay)
app.command(diff)
app.command(movie)
app.command(export)
app.command(systems)
app.command(describe)
app.command(campaign)
app.command(study)
app.command(new)
app.command(check)
app.command(debug)
app.command(tune)
app.command(onboard)
app.command(doctor)
app.command(connectivity)
app.command(schedule)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit."""
    sys.path.append("")  # a reader's own system may be a file in this folder; last, so that it hides nothing
    sys.exit(exit_code(sys.argv[1:] if arguments is None else arguments))


def exit_code(arguments: Sequence[str]) -> int:
    """Run the command line and return the exit code; messages about trouble go to stderr."""
    try:
        answer = app(list(arguments), exit_on_error=False, print_error=False, result_action="return_value")
        return answer if isinstance(answer, int) else 0
    except CycloptsError as error:
        command = " ".join(["formicarium", *arguments[:1]]) if arguments[:1] != ["--help"] else "formicarium"
        return _say(f"{_plain(error)} See: {command} --help", 2)
    except (UserError, DesignError, InstanceError, StoreError) as error:
        return _say(str(error), 2)
    except (CrewError, Explained, Futile) as error:
        return _say(str(error), 1)
    except KeyboardInterrupt as interruption:
        return _say(str(interruption) or "interrupted", 130)
    except Exception as error:
        with tempfile.NamedTemporaryFile(
            "w", prefix="formicarium-", suffix=".txt", delete=False, encoding="utf-8"
        ) as file:
            file.write(f"formicarium {' '.join(arguments)}\n\n{traceback.format_exc()}")
        reason = f"{type(error).__name__}: {error}"
        return _say(
            f"unexpected {reason}\nThis is a defect, not your mistake. "
            f"The traceback is in {Path(file.name)}; please send it with a report.",
            1,
        )


def _plain(error: CycloptsError) -> str:
    return " ".join(str(error).split())


def _say(message: str, code: int) -> int:
    print(f"formicarium: {message}", file=sys.stderr)
    return code


if __name__ == "__main__":
    main()
