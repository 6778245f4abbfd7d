# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the table of options that say what a curve does when its surface moves."""

from __future__ import annotations

from .option import Flag, Option

_MOTION = "Motion"

MOTION_ROWS: tuple[Option, ...] = (
    Option(
        "motion",
        "Motion",
        "What happens to the curve when the surface changes its shape",
        _MOTION,
        kind=str,
        default="even",
        choices=(
            ("even", "Keep Even", "The flow continues, so that strands keep the spacing"),
            ("stick", "Stick", "Points stay on their faces, as a texture would"),
        ),
        flag=Flag(
            "--motion",
            "baked frames keep the spacing, or their points stay on their faces",
            "motion",
            entry="motion",
            default="even",
        ),
    ),
    Option(
        "motion_steps",
        "Steps",
        "Iterations per frame; more of them keep the spacing under faster motion",
        _MOTION,
        low="fast, the spacing lags behind the motion",
        high="even in fast motion, slower frames",
        kind=int,
        default=3,
        least=1,
        greatest=1000,
        soft_greatest=20,
        flag=Flag(
            "--motion-steps",
            "iterations for each frame; default: 3",
            "motion",
            "N",
            least=1,
            greatest=1000,
            entry="motion_steps",
            default=3,
        ),
    ),
    Option(
        "motion_subframes",
        "Subframes",
        "Places between two frames that a bake goes by way of: Stick has keys there too, for "
        "motion that is curved or blurred, and Keep Even runs its steps there, for fast motion",
        _MOTION,
        low="points go straight from frame to frame",
        high="curved paths, slower bakes",
        kind=int,
        default=0,
        least=0,
        greatest=32,
        soft_greatest=8,
        flag=Flag(
            "--motion-subframes",
            "places between two frames that a bake goes by way of; default: 0",
            "motion",
            "N",
            least=0,
            greatest=32,
            entry="motion_subframes",
            default=0,
        ),
    ),
)
