"""What a crew is: workers that take runs, one at a time each, and hand back what became of them."""

import pickle
import time
import traceback
from collections.abc import Callable
from typing import NamedTuple, Protocol

from formicarium.campaigns.errors import Explained, Futile
from formicarium.campaigns.result import Ending, Finished, Function, Watch, checked


class Task(NamedTuple):
    """One run to be done."""

    function: bytes  # pickled Function
    seed: int
    identity: str = ""  # of the configuration, where there are several


class Crew(Protocol):
    """Workers that take runs and hand back what became of each."""

    @property
    def capacity(self) -> int:
        """How many runs can be under way at once."""

    @property
    def busy(self) -> int:
        """How many are under way."""

    def start(self, task: Task) -> None:
        """Begin a run; at most ``capacity`` may be under way."""

    def finished(self, seconds: float | None) -> list[Finished]:
        """Wait until a run has ended, or for so many seconds, and return what has ended."""

    def close(self) -> None:
        """End all workers, whatever they are doing."""


def attempt(
    task: Task, worker: int | str, watch: Watch | None = None, begun: Callable[[], None] = lambda: None
) -> Finished:
    """Do a run in this process; ``begun`` is told when everything it needs is imported.

    Raises:
        Futile: if the function says that no run can succeed.
    """
    started = time.perf_counter()
    try:
        function: Function = pickle.loads(task.function)
        begun()
        result, failure, ending = checked(function(task.seed, watch)), "", Ending.DONE
    except Futile:
        raise
    except Explained as reason:
        result, failure, ending = None, str(reason), Ending.FAILED
    except Exception:
        result, failure, ending = None, traceback.format_exc(), Ending.FAILED
    return Finished(task.seed, result, failure, time.perf_counter() - started, worker, ending, task.identity)
