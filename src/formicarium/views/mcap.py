"""A run as an MCAP file, which Foxglove and Rerun open: poses, point clouds, the scene, metrics and events.

Poses and point clouds stand beside scene entities because Rerun draws the first two and Foxglove all three.
"""

import json
import struct
from pathlib import Path

import foxglove
import numpy as np
from foxglove import Channel, Context
from foxglove.channels import LogChannel, PointCloudChannel, PosesInFrameChannel, SceneUpdateChannel
from foxglove.messages import (
    Color,
    LinePrimitive,
    LinePrimitiveLineType,
    Log,
    LogLevel,
    PackedElementField,
    PackedElementFieldNumericType,
    Point3,
    PointCloud,
    Pose,
    PosesInFrame,
    Quaternion,
    SceneEntity,
    SceneUpdate,
    Timestamp,
    Vector3,
)

from formicarium.campaigns.files import replacing
from formicarium.trial.record import Frames, Scene
from formicarium.views.style import NAMED, role_styles

WORLD = "world"  # name of the frame of reference: x and y as in the arena, z up
POINT = struct.Struct("<fffBBBB")  # x, y, z, red, green, blue, alpha


def write_mcap(path: Path, scene: Scene, frames: Frames, events: np.ndarray, sentences: list[str]) -> Path:
    """Write a run; message times are simulated time since the start.

    Args:
        path: of the file; replaced if it is there.
        scene: what does not move, sent once.
        frames: what does.
        events: EVENT (E,).
        sentences: one for every event.

    Raises:
        StoreError: if it cannot be written.
    """

    context = Context()
    poses, clouds, scenes, log = (
        kind(topic, context=context)
        for kind, topic in (
            (PosesInFrameChannel, "/robots/poses"),
            (PointCloudChannel, "/robots/points"),
            (SceneUpdateChannel, "/scene"),
            (LogChannel, "/events"),
        )
    )
    metrics = Channel("/metrics", schema=_metrics_schema(scene), message_encoding="json", context=context)
    with replacing(path) as temporary:
        writer = foxglove.open_mcap(temporary, allow_overwrite=True, context=context)
        try:
            scenes.log(_scene_update(scene), log_time=0)
            for k in range(len(frames.cycle)):
                time = _nanoseconds(frames.cycle[k] * scene.cycle_time)
                poses.log(_poses(frames, k, time), log_time=time)
                clouds.log(_cloud(scene, frames, k, time), log_time=time)
                counts = np.bincount(frames.role[k], minlength=len(scene.roles))
                values = {name: int(count) for name, count in zip(scene.roles, counts)}
                metrics.log(json.dumps({"seconds": time / 1e9, **values}).encode(), log_time=time)
            for event, sentence in zip(events, sentences, strict=True):
                time = _nanoseconds((int(event["cycle"]) + 1) * scene.cycle_time)
                log.log(_log_line(sentence, time), log_time=time)
        finally:
            writer.close()
    return path


def _nanoseconds(seconds: float) -> int:
    return round(float(seconds) * 1e9)


def _metrics_schema(scene: Scene) -> dict:
    numbers = {name: {"type": "integer"} for name in scene.roles}
    return {"type": "object", "title": "metrics", "properties": {"seconds": {"type": "number"}, **numbers}}


def _timestamp(time: int):
    return Timestamp(time // 10**9, time % 10**9)


def _pose(x: float, y: float, heading: float = 0.0):
    turn = Quaternion(x=0.0, y=0.0, z=float(np.sin(heading / 2)), w=float(np.cos(heading / 2)))
    return Pose(position=Vector3(x=float(x), y=float(y), z=0.0), orientation=turn)


def _poses(frames: Frames, k: int, time: int):
    found = [_pose(*place) for place in zip(frames.x[k], frames.y[k], frames.heading[k])]
    return PosesInFrame(timestamp=_timestamp(time), frame_id=WORLD, poses=found)


def _rgb(colour: str) -> tuple[int, int, int]:
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)


def _cloud(scene: Scene, frames: Frames, k: int, time: int):
    kind = PackedElementFieldNumericType
    fields = [PackedElementField(name=name, offset=4 * i, type=kind.Float32) for i, name in enumerate("xyz")]
    fields += [
        PackedElementField(name=name, offset=12 + i, type=kind.Uint8)
        for i, name in enumerate(("red", "green", "blue", "alpha"))
    ]
    colours = [_rgb(style.fill) for style in role_styles(scene.roles)]
    data = b"".join(
        POINT.pack(x, y, 0.0, *colours[role], 255) for x, y, role in zip(frames.x[k], frames.y[k], frames.role[k])
    )
    return PointCloud(
        timestamp=_timestamp(time), frame_id=WORLD, pose=_pose(0, 0), point_stride=POINT.size, fields=fields, data=data
    )


def _scene_update(scene: Scene):
    lines = []
    for polygon in scene.polygons:
        red, green, blue = (value / 255 for value in _rgb(NAMED.get(polygon.colour, "#808080")))
        lines.append(
            LinePrimitive(
                type=LinePrimitiveLineType.LineLoop,
                pose=_pose(0, 0),
                thickness=0.01,
                scale_invariant=False,
                points=[Point3(x=float(x), y=float(y), z=0.0) for x, y in polygon.points],
                color=Color(r=red, g=green, b=blue, a=1.0),
            )
        )
    return SceneUpdate(entities=[SceneEntity(timestamp=_timestamp(0), frame_id=WORLD, id="arena", lines=lines)])


def _log_line(sentence: str, time: int):
    return Log(timestamp=_timestamp(time), level=LogLevel.Info, message=sentence, name="trial")
