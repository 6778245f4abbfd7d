# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of tone: how dark a line is to look where. Pictures, surfaces and what a camera sees have
them in common.
"""

from __future__ import annotations

from .option import Flag, Option

_GROUP, _PANEL = "tone", "Density"

KIND = Option(
    "tone_kind",
    "Tone",
    "How dark the line is for a brightness",
    _PANEL,
    kind=str,
    default="eye",
    choices=(
        (
            "eye",
            "Eye",
            "The range of brightness is fitted into what the line can have, as an eye compares",
        ),
        ("light", "Light", "Reflect as much light; what the line cannot have is clipped"),
        ("value", "Value", "Dark in proportion to values on screen; what cannot be is clipped"),
    ),
    flag=Flag(
        "--tone",
        "how dark it is: eye fits the lightness into what the line can have; light reflects as "
        "much light, and value goes by values on screen, both clipped to that; default: eye",
        _GROUP,
    ),
)
DARKEST = Option(
    "tone_darkest",
    "Darkest",
    "Width of the line over the least spacing; strands are never closer",
    _PANEL,
    low="strands stay far apart",
    high="strands come so near that they nearly touch",
    unit="share",
    default=0.9,
    least=0.1,
    greatest=1.0,
    flag=Flag(
        "--darkest",
        "width of the line over the least spacing; default: 0.9",
        _GROUP,
        "D",
        least=0.1,
        greatest=1.0,
    ),
)
LIGHTEST = Option(
    "tone_lightest",
    "Lightest",
    "Width of the line over the greatest spacing; strands are never farther apart",
    _PANEL,
    low="open whites, with long ways round them",
    high="a line everywhere, and flat highlights",
    unit="share",
    default=0.06,
    least=0.01,
    greatest=0.5,
    flag=Flag(
        "--lightest",
        "width of the line over the greatest spacing; default: 0.06",
        _GROUP,
        "D",
        least=0.01,
        greatest=0.5,
    ),
)
# What pictures, surfaces and drawings of a view share.
COMMON = (KIND, DARKEST, LIGHTEST)

# And what surfaces have besides.
OF_SURFACES: tuple[Option, ...] = (
    Option(
        "tone_line",
        "Line Width",
        "Width of the line, in spacings: strands are as far apart as it is wide over how dark it "
        "is",
        _PANEL,
        low="a fine line, whose strands are close",
        high="a bold line, whose strands are far apart",
        unit="r",
        default=1.0,
        least=0.01,
        soft_least=0.1,
        soft_greatest=2.0,
        greatest=20.0,
        flag=Flag(
            "--pen",
            "width of the line, in the units of the mesh; default: half of --spacing, and where "
            "only this is given --spacing is twice as much",
            _GROUP,
            "W",
            above=0.0,
            in_scene_units=True,
        ),
    ),
    Option(
        "tone_negative",
        "Light Line",
        "A light line on a dark ground: strands are close where it is bright",
        _PANEL,
        kind=bool,
        default=False,
        flag=Flag(
            "--negative",
            "for a light line on a dark ground: strands are close where it is bright",
            _GROUP,
        ),
    ),
)
# The settings on an object, and the flags of the batch command.
ROWS: tuple[Option, ...] = COMMON + OF_SURFACES
