# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the table of options for export that are about machines by G-code; no bpy."""

from __future__ import annotations

from collections.abc import Collection

from ..toolpaths.gcode import MACHINES, TOOLS, Motion
from .option import Flag, Option, Values

PANEL = "File > Export"
GROUP = "export"

MACHINE_ROWS: tuple[Option, ...] = (
    Option(
        "feed",
        "Feed",
        "Speed along the curve, in millimetres per minute",
        PANEL,
        default=Motion.feed,
        least=0.1,
        greatest=1e6,
        soft_greatest=10000.0,
        step=1000,
        flag=Flag(
            "--feed",
            "speed along the curve in G-code, in mm a minute; default: 1200",
            GROUP,
            "F",
            entry="feed",
        ),
    ),
    Option(
        "travel_feed",
        "Travel Feed",
        "Speed between strands, in millimetres per minute",
        PANEL,
        default=Motion.travel_feed,
        least=0.1,
        greatest=1e6,
        soft_greatest=10000.0,
        step=1000,
        flag=Flag(
            "--travel-feed",
            "speed between strands in G-code, in mm a minute; default: 3000",
            GROUP,
            "F",
            entry="travel_feed",
        ),
    ),
    Option(
        "lift",
        "Travel Height",
        "Height at which the tool travels, above the highest point of the curve, in millimetres",
        PANEL,
        default=Motion.lift,
        least=0.0,
        greatest=1e6,
        soft_greatest=50.0,
        flag=Flag(
            "--lift",
            "height above the curve at which the tool travels, in mm; default: 5",
            GROUP,
            "H",
            least=0.0,
            entry="lift",
        ),
    ),
    Option(
        "layer_offset",
        "Layer Offset",
        "Distance of the tool from the surface along its normal, in millimetres; negative cuts "
        "into it",
        PANEL,
        default=Motion.layer_offset,
        least=-1e6,
        greatest=1e6,
        soft_least=-10.0,
        soft_greatest=10.0,
        digits=3,
        flag=Flag(
            "--layer-offset",
            "distance of the tool from the surface along its normal, in mm; default: 0",
            GROUP,
            "D",
            entry="layer_offset",
        ),
    ),
    Option(
        "layers",
        "Layers",
        "How often the curve is followed, one layer upon the other",
        PANEL,
        kind=int,
        default=Motion.layers,
        least=1,
        greatest=10000,
        soft_greatest=20,
        flag=Flag(
            "--layers",
            "how often the curve is followed; default: 1",
            GROUP,
            "N",
            least=1,
            greatest=10000,
            entry="layers",
        ),
    ),
    Option(
        "layer_height",
        "Layer Height",
        "From each layer to the next along the surface's normal, in millimetres",
        PANEL,
        default=Motion.layer_height,
        least=-1e6,
        greatest=1e6,
        soft_least=0.0,
        soft_greatest=5.0,
        digits=3,
        flag=Flag(
            "--layer-height",
            "from each layer to the next along the normal, in mm; default: 0.2",
            GROUP,
            "D",
            entry="layer_height",
        ),
    ),
    Option(
        "extrusion",
        "Extrusion",
        "Millimetres of filament for each millimetre of the curve; 0 is a tool that extrudes "
        "nothing",
        PANEL,
        default=Motion.extrusion,
        least=0.0,
        greatest=1000.0,
        soft_greatest=1.0,
        digits=4,
        step=1,
        flag=Flag(
            "--extrusion",
            "mm of filament for each mm of the curve, for printers; default: 0",
            GROUP,
            "E",
            least=0.0,
            entry="extrusion",
        ),
    ),
    Option(
        "arc_tolerance",
        "Arcs",
        "Draw lines and arcs of circles in place of points, this near to the curve in millimetres; "
        "0 draws none. The drawing has to be flat",
        PANEL,
        default=0.0,
        least=0.0,
        soft_greatest=1.0,
        digits=3,
        flag=Flag(
            "--arcs",
            "draw lines and arcs of circles in place of points, this near to the curve, in mm",
            GROUP,
            "D",
            above=0.0,
            entry="arc_tolerance",
        ),
    ),
    Option(
        "tool",
        "Tool",
        "What draws, and how it is switched on and off",
        PANEL,
        kind=str,
        default=Motion.tool,
        choices=TOOLS,
        flag=Flag(
            "--tool",
            "what draws in G-code: it goes down and up, or is switched on and off; default: pen",
            GROUP,
            entry="tool",
        ),
    ),
    Option(
        "machine",
        "Machine",
        "The controller that reads the file, which decides head, foot and the words of the tool",
        PANEL,
        kind=str,
        default=Motion.machine,
        choices=MACHINES,
        flag=Flag(
            "--machine",
            "the controller that reads the G-code; default: generic",
            GROUP,
            entry="machine",
        ),
    ),
    Option(
        "power",
        "Power",
        "Of a laser or a spindle, in per cent of its greatest",
        PANEL,
        default=Motion.power,
        least=0.0,
        greatest=100.0,
        flag=Flag(
            "--power",
            "of a laser or a spindle, in per cent; default: 100",
            GROUP,
            "P",
            least=0.0,
            greatest=100.0,
            entry="power",
        ),
    ),
    Option(
        "servo_down",
        "Servo Down",
        "Angle at which a servo has its pen on the paper, in degrees",
        PANEL,
        default=Motion.servo_down,
        least=0.0,
        greatest=1000.0,
        flag=Flag(
            "--servo-down",
            "angle at which a servo has its pen on the paper; default: 0",
            GROUP,
            "A",
            least=0.0,
            greatest=1000.0,
            entry="servo_down",
        ),
    ),
    Option(
        "servo_up",
        "Servo Up",
        "Angle at which a servo has its pen off the paper, in degrees",
        PANEL,
        default=Motion.servo_up,
        least=0.0,
        greatest=1000.0,
        flag=Flag(
            "--servo-up",
            "angle at which a servo has its pen off the paper; default: 60",
            GROUP,
            "A",
            least=0.0,
            greatest=1000.0,
            entry="servo_up",
        ),
    ),
    Option(
        "relative",
        "Relative Moves",
        "Give moves by how far they go, from the first strand on",
        PANEL,
        kind=bool,
        default=Motion.relative,
        flag=Flag(
            "--relative",
            "give moves in G-code by how far they go, from the first strand on",
            GROUP,
            entry="relative",
        ),
    ),
    Option(
        "dip_every",
        "Dip Every",
        "Way along the curve after which a brush is dipped into paint again, in millimetres, and "
        "at first; 0 is a pen that needs no paint",
        PANEL,
        default=Motion.dip_every,
        least=0.0,
        greatest=1e6,
        soft_greatest=1e3,
        flag=Flag(
            "--dip-every",
            "dip a brush into paint again after so many mm along the curve, and at first",
            GROUP,
            "D",
            least=0.0,
            entry="dip_every",
        ),
    ),
    Option(
        "dip_x",
        "Palette X",
        "Where the brush is dipped, in millimetres from the left of a flat drawing",
        PANEL,
        default=Motion.dip_x,
        least=-1e6,
        greatest=1e6,
        soft_least=-1e3,
        soft_greatest=1e3,
        flag=Flag(
            "--dip-x",
            "where the brush is dipped, in mm from the left of a flat drawing; default: 0",
            GROUP,
            "D",
            least=-1e6,
            greatest=1e6,
            entry="dip_x",
        ),
    ),
    Option(
        "dip_y",
        "Palette Y",
        "Where the brush is dipped, in millimetres up from the foot of a flat drawing",
        PANEL,
        default=Motion.dip_y,
        least=-1e6,
        greatest=1e6,
        soft_least=-1e3,
        soft_greatest=1e3,
        flag=Flag(
            "--dip-y",
            "where the brush is dipped, in mm up from the foot of a flat drawing; default: 0",
            GROUP,
            "D",
            least=-1e6,
            greatest=1e6,
            entry="dip_y",
        ),
    ),
    Option(
        "dip_height",
        "Palette Height",
        "How low the brush goes where it is dipped, in millimetres; a flat drawing lies at 0",
        PANEL,
        default=Motion.dip_height,
        least=-1e6,
        greatest=1e6,
        soft_least=-1e3,
        soft_greatest=1e3,
        flag=Flag(
            "--dip-height",
            "how low the brush goes there, in mm; a flat drawing lies at 0, the default",
            GROUP,
            "H",
            least=-1e6,
            greatest=1e6,
            entry="dip_height",
        ),
    ),
)

# Settings that mean something beside another only, and the values of that; none: any above one, or
# above 0.
_BESIDE: tuple[tuple[tuple[str, ...], str, tuple[str, ...]], ...] = (
    (("dip_x", "dip_y", "dip_height"), "dip_every", ()),
    (("layer_height",), "layers", ()),
    (("servo_down", "servo_up"), "tool", ("servo",)),
    (("power",), "tool", ("laser", "spindle")),
    (("lift",), "tool", ("pen", "spindle")),
)
_LEAST = {"layers": 1}


def without_effect(given: Collection[str], values: Values) -> tuple[str, str, str] | None:
    """Of settings that are given, the first that changes nothing, what it is for, and the choices
    of that, as words; None: all do.

    values   of all settings
    """
    for settings, other, choices in _BESIDE:
        effective = values[other] in choices if choices else values[other] > _LEAST.get(other, 0)
        for setting in settings:
            if setting in given and not effective:
                return setting, other, " or ".join(choices)
    return None
