"""What ``diff`` does: find where two runs part."""

from formicarium.commands.errors import UserError
from formicarium.commands.replaying import CHANGED, session_of
from formicarium.commands.runs import Run, find_run
from formicarium.views.parting import Parting, first_frame_apart, first_state_apart
from formicarium.views.style import clock


def compare(place_a: str, seed_a: int | None, place_b: str, seed_b: int | None) -> int:
    """Compare two runs, say where they part and return 0 if nowhere."""
    a, b = find_run(place_a, seed_a), find_run(place_b, seed_b)
    if a.system.name != b.system.name:
        raise UserError(f"{place_a} is a run of {a.system.name}, {place_b} one of {b.system.name}")
    if a.seed != b.seed:
        print(f"seed: {a.seed} against {b.seed}")
    for name, one, other in _differing(a.parameters.model_dump(), b.parameters.model_dump()):
        print(f"{name}: {one} against {other}")
    for deed in sorted({*a.interventions} ^ {*b.interventions}):
        print(f"only in {'A' if deed in a.interventions else 'B'}: {deed.deed} {deed.subject} at cycle {deed.cycle}")
    cycle_time = a.scene.cycle_time
    simulated = a.same_sources and b.same_sources
    if not simulated:
        print(f"comparing recorded frames: {CHANGED}")
    end = min(run.end for run in (a, b)) if any(run.outcome is None for run in (a, b)) else None
    parting = first_state_apart(session_of(a), session_of(b), end) if simulated else _frames_apart(a, b)
    if parting is None:
        print("the runs are the same")
        return 0
    who = f"robot {parting.robot}" if parting.robot else "no robot in particular"
    at = f"cycle {parting.cycle} ({clock(parting.cycle * cycle_time)})"
    print(f"the runs part at {at}, {who}, field {parting.field}: {parting.one} against {parting.other}")
    return 1


def _frames_apart(a: Run, b: Run) -> Parting | None:
    if a.frames is None or b.frames is None:
        raise UserError(f"{CHANGED}, and one of the runs has no frames to compare")
    return first_frame_apart(a.frames, b.frames)


def _differing(one: dict, other: dict, prefix: str = "") -> list[tuple[str, object, object]]:
    found: list[tuple[str, object, object]] = []
    for name in sorted({*one, *other}):
        left, right = one.get(name), other.get(name)
        if isinstance(left, dict) and isinstance(right, dict):
            found += _differing(left, right, f"{prefix}{name}.")
        elif left != right:
            found.append((prefix + name, left, right))
    return found
