"""A crew of one: this very process. For debuggers, notebooks and tests."""

from collections import deque

from formicarium.campaigns.crew import Task, attempt
from formicarium.campaigns.result import Finished


class Here:
    """Does each run when its result is asked for; a run that kills its process kills the campaign."""

    def __init__(self, capacity: int = 1):
        """Prepare; with a capacity above 1 as many runs wait in line."""
        self.capacity = capacity
        self._line: deque[Task] = deque()

    @property
    def busy(self) -> int:
        """How many runs wait in line."""
        return len(self._line)

    def start(self, task: Task) -> None:
        """Put a run in line."""
        self._line.append(task)

    def finished(self, seconds: float | None) -> list[Finished]:
        """Do the next run and return it; do nothing if there is no time (0 seconds)."""
        if not self._line or seconds == 0:
            return []
        return [attempt(self._line.popleft(), "here")]

    def close(self) -> None:
        """Forget what waits in line."""
        self._line.clear()
