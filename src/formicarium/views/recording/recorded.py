"""A trial run and recorded without anybody looking."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from formicarium.campaigns.files import replacing
from formicarium.systems.registry import System
from formicarium.trial.record import Trial
from formicarium.views.live.session import Session
from formicarium.views.recording.recorder import Recorder

SLICE = 1000  # cycles between two reports of progress


def record_trial(
    system: System,
    parameters: Any,
    seed: int,
    path: Path,
    head: Mapping[str, Any],
    every: float,
    watch: Callable[[float, float], None] | None = None,
) -> Trial:
    """Run a trial to its end, record it in ``path`` and return what ``system.run`` would return, without frames.

    Args:
        system: what to run.
        parameters: all its numbers.
        seed: decides everything that is random.
        path: of the recording; replaced if it is there.
        head: what the recording says of its trial.
        every: seconds between two frames.
        watch: called now and then with (seconds simulated, seconds at most).
    """
    session = Session(system, parameters, seed, scrubbed=False)
    cycle_time = session.scene.cycle_time
    with replacing(path) as temporary:
        temporary.unlink(missing_ok=True)
        cycles = max(1, round(every / cycle_time))
        session.record(Recorder(temporary, head, session.scene, session.state, cycles))
        while not session.finished:
            session.advance(SLICE)
            if watch:
                watch(session.cycle * cycle_time, session.last_cycle * cycle_time)
        session.stop()
    return Trial(session.outcome(), session.events, None, session.scene)
