# SPDX-License-Identifier: GPL-3.0-or-later
"""Poses of a robot's tool as messages of ROS in YAML: a document for each strand, as `ros2 topic
echo` prints them and `ros2 topic pub` takes each; no bpy.

Lengths are in metres, with z up, in a right-handed frame: REP 103.
"""

from __future__ import annotations

import json
from collections.abc import Sequence

from .poses import Poses

# Messages as options have them.
MESSAGES = (
    ("pose_array", "Pose Array", "Poses of one frame: geometry_msgs/PoseArray"),
    ("path", "Path", "Poses with a header each: nav_msgs/Path"),
)
FRAME = "world"


def ros_text(poses: Sequence[Poses], message: str, frame_id: str, version: str) -> str:
    """The text of a file.

    poses      in metres, strand after strand
    message    one of MESSAGES
    frame_id   of the headers: the frame of the surface's coordinates
    """
    kind = next(tip for name, _label, tip in MESSAGES if name == message).split(": ")[1]
    header = [
        "header:",
        "  stamp:",
        "    sec: 0",
        "    nanosec: 0",
        f"  frame_id: {json.dumps(frame_id)}",
    ]
    lines = [f"# {kind}, by Meander {version}"]
    for each in poses:
        lines += ["---", *header, "poses:"]
        for place, turn in zip(each.places.tolist(), each.quaternions.tolist(), strict=True):
            pose = ["position:", *_fields("xyz", place), "orientation:", *_fields("xyzw", turn)]
            if message == "path":
                pose = [*header, "pose:", *(f"  {line}" for line in pose)]
            lines += [f"- {pose[0]}", *(f"  {line}" for line in pose[1:])]
    return "\n".join([*lines, ""])


def _fields(names: str, values: Sequence[float]) -> list[str]:
    """Numbers that YAML 1.1 reads as such: a point, and no exponent without one."""
    return [f"  {name}: {value:.9f}" for name, value in zip(names, values, strict=True)]
