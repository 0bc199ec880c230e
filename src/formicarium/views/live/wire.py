"""What goes over the WebSocket: frames as bytes, everything else as JSON, and what a page may ask for."""

import json
import struct
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter

from formicarium.trial.record import Frames, Scene
from formicarium.trial.watching import Inspection
from formicarium.views.scenes import scene_content
from formicarium.views.style import NAMED, role_styles

FRAME = 1  # kind of a binary message
HEAD = struct.Struct("<8i")  # kind, cycle, robots, devices, packets, turns, frontier, jump


def frame_bytes(frame: Frames, packets: np.ndarray, turns: int, frontier: int, jump: bool) -> bytes:
    """Write one frame: the head, then x, y, heading (float32), packets and joined (16 bits), bytes for the rest."""
    robots, devices = frame.x.shape[1], frame.lit.shape[1]
    assert frame.joined is not None and frame.colour is not None
    head = HEAD.pack(FRAME, int(frame.cycle[0]), robots, devices, len(packets), turns, frontier, jump)
    parts = [frame.x, frame.y, frame.heading, packets.astype("<u2"), frame.joined.astype("<i2")]
    parts += [frame.role, frame.carried, frame.colour, frame.lit]
    return head + b"".join(part.tobytes() for part in parts)


def said(kind: str, **content: Any) -> str:
    """Write a message of this kind as JSON."""
    return json.dumps({"kind": kind, **content}, separators=(",", ":"))


def look_of(scene: Scene) -> dict[str, Any]:
    """Return a scene with the colours and letters in which it is drawn."""
    styles = [style._asdict() for style in role_styles(scene.roles)]
    return {"scene": scene_content(scene), "styles": styles, "colours": NAMED}


def greeting(session: Any, title: str, kinds: tuple[str, ...]) -> dict[str, Any]:
    """Return what a page is told first of a Session or LoggedFrames; ``kinds`` are the names of the event kinds."""
    return {
        "title": title,
        **look_of(session.scene),
        "identity": [int(robot) for robot in session.identity],
        "kinds": list(kinds),
        "last_cycle": session.last_cycle,
        "touchable": session.touchable,
        "blockable": session.blockable,
        "radio": session.radio,
    }


def inspection_content(inspection: Inspection) -> dict[str, Any]:
    """Return an inspection as plain values."""
    sections = [section._asdict() for section in inspection.sections]
    return {"identity": inspection.identity, "summary": inspection.summary, "sections": sections}


class _Wish(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


class Play(_Wish):
    """Go on."""

    do: Literal["play"]


class Pause(_Wish):
    """Stand still."""

    do: Literal["pause"]


class Step(_Wish):
    """Go so many cycles on."""

    do: Literal["step"]
    cycles: int = Field(1, ge=1, le=100_000)


class Speed(_Wish):
    """Run so many times as fast as real time; 0 is as fast as it goes."""

    do: Literal["speed"]
    times: float = Field(ge=0, le=1_000_000, allow_inf_nan=False)


class Seek(_Wish):
    """Go to a cycle."""

    do: Literal["seek"]
    cycle: int = Field(ge=0, le=2**40)


class Select(_Wish):
    """Tell what is in a robot; 0 for none."""

    do: Literal["select"]
    robot: int = Field(ge=0, le=2**31)


class Show(_Wish):
    """Send packets along, or not."""

    do: Literal["packets"]
    on: bool


class Touch(_Wish):
    """Intervene."""

    do: Literal["move", "kill", "block", "unblock"]
    subject: int = Field(ge=0, le=2**31)
    x: float = Field(0.0, ge=-1e6, le=1e6, allow_inf_nan=False)
    y: float = Field(0.0, ge=-1e6, le=1e6, allow_inf_nan=False)


Wish = Play | Pause | Step | Speed | Seek | Select | Show | Touch
_wishes: TypeAdapter[Wish] = TypeAdapter(Annotated[Wish, Field(discriminator="do")])


def wish_of(text: str) -> Wish:
    """Read what a page asks for.

    Raises:
        pydantic.ValidationError: if it makes no sense.
    """
    return _wishes.validate_json(text)
