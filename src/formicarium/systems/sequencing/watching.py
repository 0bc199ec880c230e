"""How the sequencing systems are shown and touched: frames, what is in a robot, what a person may do."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from formicarium.robots.records import SILENCE
from formicarium.systems.sequencing.memory import NEVER, Role, State
from formicarium.systems.sequencing.messages import MESSAGE, decode
from formicarium.trial.record import Frames
from formicarium.trial.showing import (
    byte,
    colour,
    degrees,
    fields,
    metres,
    plain,
    poses,
    reading_sections,
    said,
    side_by_side,
)
from formicarium.trial.touching import touch_robot
from formicarium.trial.watching import Impossible, Inspection, Intervention, Section

PARTS = ("bodies", "robots", "memories", "commands", "booths")
FRAME_ROLES = np.array([0, 1, 3, 2])  # Role -> number in frames
DEAD = 4
FARTHEST = 0.6  # m between neighbours of a chain; who is farther is not shown as joined


def frames(reel: Mapping[str, Any]) -> Frames:
    """Return the frames of a reel."""
    alive = reel["robots"]["alive"] == 1
    role = np.where(alive, FRAME_ROLES[reel["memories"]["role"]], DEAD)
    booths = reel["booths"]
    lit = (booths["occupied"] == 0) & (booths["blocked"] == 0)
    shown = poses(reel, role, reel["memories"]["count"], lit)
    order = np.argsort(reel["robots"]["identity"][0])
    return shown._replace(joined=joined(reel["memories"][:, order], shown))


def joined(memories: np.ndarray, shown: Frames) -> np.ndarray:
    """Return for every chain member the column of the one before it in the chain, -1 for none.

    Members of a branch are known by branch and link number; a guardian heads its own branch as number 0, and is
    joined to the last of the branch before when that is established.
    """
    role, branch, number = memories["role"], memories["branch"], memories["link_number"]
    member = (role != Role.RUNNER) & (shown.role != DEAD)
    guardian = member & (role == Role.GUARDIAN)
    place = branch * 100 + np.where(guardian, 0, number)
    wanted = np.where(guardian, -1, place - 1)
    last = np.where(member & ~guardian, place, -1)[:, None, :]
    docked = guardian & (memories["established"] == 1) & (branch > 1)
    last = np.where(last // 100 == branch[:, :, None] - 1, last, -1).max(axis=2)
    wanted = np.where(docked, np.where(last < 0, (branch - 1) * 100, last), wanted)
    gap = np.hypot(shown.x[:, :, None] - shown.x[:, None, :], shown.y[:, :, None] - shown.y[:, None, :])
    same = (wanted[:, :, None] == place[:, None, :]) & member[:, :, None] & member[:, None, :]
    gap = np.where(same & (gap < FARTHEST) & (gap > 0.0), gap, np.inf)
    return np.where(np.isfinite(gap.min(axis=2)), gap.argmin(axis=2), -1).astype("i2")


def inspect(state: Any, identity: int) -> Inspection:
    """Return what one robot senses, remembers, hears and says."""
    i = int(np.nonzero(np.asarray(state.robots["identity"]) == identity)[0][0])
    reading, memory, command = (np.asarray(part)[i] for part in (state.readings, state.memories, state.commands))
    words = words_at(int(reading["cycle"]), float(state.world.settings["cycle_time"][0]))
    packets = reading["packets"][: int(reading["packet_count"])]
    heard = {f"{metres(p['distance'])}, {degrees(p['bearing'])}": message_of(p["payload"]) for p in packets}
    sent = {head: message_of(content) for head, content in said(command).items()}
    leave = ("message", "heard", "adverts", "target", "predecessor", "successor")
    tracks = [(name, track(memory[name])) for name in leave[3:]]
    adverts = {
        colour(c): memory["adverts"][c] for c in range(1, len(memory["adverts"])) if memory["adverts"][c]["heard"] > NEVER
    }  # fmt: skip
    wheels = tuple((side, f"{float(command[side]):.4f} m/s") for side in ("left", "right"))
    role = Role(int(memory["role"])).name.lower() if state.robots["alive"][i] == 1 else "dead"
    summary = f"{role}, {State(int(memory['state'])).name.lower().replace('_', ' ')}"
    return Inspection(
        identity,
        summary,
        (
            Section("Memory", ("field", "value"), (*fields(memory, words, leave), *tracks)),
            side_by_side("Guardians heard of", adverts, words),
            side_by_side("Messages heard", heard, {"colour": colour}),
            side_by_side("Messages sent", sent, {"colour": colour}),
            *reading_sections(reading),
            Section(
                "Command",
                ("field", "value"),
                (*wheels, ("colour", colour(command["colour"])), ("infrared", byte(command["infrared"]))),
            ),
        ),
    )


def message_of(payload: np.ndarray) -> Any:
    """Return four bytes as a message."""
    message = np.zeros(1, MESSAGE).view(np.recarray)
    decode(payload, message[0])
    return np.asarray(message)[0]


def track(record: Any) -> str:
    """Write where a robot believes something to be."""
    if not record["known"]:
        return "nowhere"
    distance, bearing = np.hypot(record["x"], record["y"]), np.arctan2(record["y"], record["x"])
    return f"{metres(distance)} at {degrees(bearing)}"


def words_at(cycle: int, cycle_time: float) -> dict[str, Any]:
    """Return how the fields of a memory are written at a cycle."""

    def moment(value: int) -> str:
        seconds = (int(value) - cycle) * cycle_time
        if value <= NEVER:
            return "never"
        return f"in {seconds:.1f} s" if seconds > 0 else f"{-seconds:.1f} s ago"

    moments = (
        *("since", "inhibition_heard", "inhibition_ahead", "echo_heard", "chain_seen", "watched_since", "verdict_heard"),
        *("inhibiting_until", "refuse_until", "abstain_until", "wander_until", "requested", "settled", "echo_until"),
        "heard",
    )
    return {
        **dict.fromkeys(moments, moment),
        **dict.fromkeys(("colour", "watched", "last_success"), colour),
        **dict.fromkeys(("turn_left", "sector", "bearing", "turn"), degrees),
        **dict.fromkeys(("travelled", "forward"), metres),
        "role": lambda value: Role(int(value)).name.lower(),
        "state": lambda value: State(int(value)).name.lower(),
        "exchange": lambda value: byte(SILENCE if value < 0 else value),
        "draws": lambda value: f"{int(value):#x}",
        "candidate": lambda value: "guards it next" if value else plain(value),
    }


def intervene(state: Any, intervention: Intervention) -> None:
    """Move or kill a robot, block or unblock a booth.

    A blocked booth is dark and answers nobody; a visitor that is inside waits in vain, as at a failed exchange.

    Raises:
        Impossible: if it cannot be done; nothing has changed then.
    """
    if intervention.deed not in ("block", "unblock"):
        return touch_robot(state, intervention)
    if not 0 <= intervention.subject < len(state.booths):
        raise Impossible(f"there is no booth {intervention.subject}")
    booth = state.booths[intervention.subject]
    booth.blocked = 1 if intervention.deed == "block" else 0
    if booth.blocked == 1:
        booth.mute = 1
    return None
