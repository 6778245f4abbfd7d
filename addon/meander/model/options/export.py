# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the table of options that are about files for machines; no bpy.

They are not settings of an object but of one export: of the operator, and flags of the command.
"""

from __future__ import annotations

from ..toolpaths.embroidery import LEAST_STITCH, LONGEST_STITCH
from ..toolpaths.lights import PITCH
from ..toolpaths.ros import MESSAGES
from .machines import GROUP, MACHINE_ROWS, PANEL
from .option import Flag, Option

STITCH_LENGTH = 2.5
LINE_WIDTH = 0.3
THICKNESS = 0.25

ROWS: tuple[Option, ...] = (
    Option(
        "layout_as",
        "Layout",
        "How the curve is laid into the file",
        PANEL,
        kind=str,
        default="space",
        choices=(
            ("space", "In Space", "As it is; formats that are flat take the view from the top"),
            ("top", "Top", "Seen from above, along Z"),
            ("front", "Front", "Seen from the front, along Y"),
            ("side", "Right Side", "Seen from the right, along X"),
            ("view", "View", "As the 3D view shows it, without perspective"),
            ("uv", "Unrolled", "Laid flat by a UV map, and cut where that has seams"),
        ),
        flag=Flag(
            "--layout",
            "as it is, seen along an axis, or laid flat by the UV map of a .blend; 'view' needs a "
            "window; default: space",
            GROUP,
            entry="layout",
        ),
    ),
    Option(
        "visible_only",
        "Visible Only",
        "Leave out what the surface hides from where the layout sees it",
        PANEL,
        kind=bool,
        default=False,
        flag=Flag(
            "--visible-only",
            "leave out what the surface hides in the layouts top, front and side",
            GROUP,
            entry="visible_only",
        ),
    ),
    Option(
        "unit",
        "Unit",
        "Unit of length of the file",
        PANEL,
        kind=str,
        default="mm",
        choices=(
            ("mm", "Millimetres", "What most machines expect"),
            ("cm", "Centimetres", "Not for G-code"),
            ("in", "Inches", "25.4 mm"),
        ),
        flag=Flag(
            "--unit", "unit of length of the file; default: mm", GROUP, entry="unit"
        ),
    ),
    Option(
        "scale",
        "Scale",
        "Multiplies the true size; a scene unit is a metre unless the scene says otherwise",
        PANEL,
        default=1.0,
        least=1e-9,
        greatest=1e9,
        soft_least=0.001,
        soft_greatest=1000.0,
        digits=4,
        flag=Flag(
            "--scale",
            "multiplies the true size, in which a scene unit is a metre, or what the .blend says",
            GROUP,
            "K",
            above=0.0,
            entry="scale",
        ),
    ),
    Option(
        "size",
        "Size",
        "Longest side of the drawing in the unit of the file, whatever its true size; 0 keeps that",
        PANEL,
        default=0.0,
        least=0.0,
        greatest=1e9,
        soft_greatest=1000.0,
        flag=Flag(
            "--size",
            "longest side of the drawing, in the unit of the file; default: the true size",
            GROUP,
            "D",
            above=0.0,
            entry="size",
        ),
    ),
    Option(
        "line_width",
        "Line Width",
        "Width of the line in an SVG file, in millimetres",
        PANEL,
        default=LINE_WIDTH,
        least=0.001,
        greatest=1000.0,
        soft_greatest=5.0,
        flag=Flag(
            "--line-width",
            "width of the line in an SVG file, in millimetres; default: 0.3",
            GROUP,
            "W",
            above=0.0,
            entry="line_width",
        ),
    ),
    *MACHINE_ROWS,
    Option(
        "force",
        "Write Anyway",
        "Write a drawing that no machine can take: wider than 10 m, or seen edge on",
        PANEL,
        kind=bool,
        default=False,
        flag=Flag(
            "--force",
            "write a drawing that no machine can take: wider than 10 m, or seen edge on",
            GROUP,
            entry="force",
        ),
    ),
    Option(
        "stitch_length",
        "Stitch Length",
        "Longest stitch of an embroidery, in millimetres",
        PANEL,
        default=STITCH_LENGTH,
        least=0.3,
        greatest=LONGEST_STITCH,
        soft_least=1.0,
        soft_greatest=6.0,
        flag=Flag(
            "--stitch-length",
            "longest stitch of an embroidery, in mm, from 0.3 to 12.1; default: 2.5",
            GROUP,
            "D",
            least=0.3,
            greatest=LONGEST_STITCH,
            entry="stitch_length",
        ),
    ),
    Option(
        "stitch_tolerance",
        "Stitch Tolerance",
        "How far a stitch of an embroidery may be from the curve, in millimetres: stitches are "
        "shorter in turns. 0 is a tenth of the spacing",
        PANEL,
        default=0.0,
        least=0.0,
        soft_greatest=1.0,
        flag=Flag(
            "--stitch-tolerance",
            "how far a stitch may be from the curve, in mm; default: a tenth of the spacing",
            GROUP,
            "D",
            above=0.0,
            entry="stitch_tolerance",
        ),
    ),
    Option(
        "stitch_least",
        "Least Stitch",
        "Shortest stitch of an embroidery, in millimetres, whatever the tolerance: thread breaks "
        "where the needle comes down in one place",
        PANEL,
        default=LEAST_STITCH,
        least=0.1,
        greatest=LONGEST_STITCH,
        soft_greatest=1.0,
        flag=Flag(
            "--least-stitch",
            "shortest stitch of an embroidery, in mm, from 0.1 to 12.1; default: 0.3",
            GROUP,
            "D",
            least=0.1,
            greatest=LONGEST_STITCH,
            entry="least_stitch",
        ),
    ),
    Option(
        "thickness",
        "Thickness",
        "Diameter of the curve in USD and of the tube in glTF, in spacings; 0 is lines in glTF, "
        "and in USD no width of their own",
        PANEL,
        default=THICKNESS,
        least=0.0,
        greatest=2.0,
        soft_greatest=1.0,
        flag=Flag(
            "--thickness",
            "diameter of the curve in USD, and of the tube in glTF, in spacings, from 0 to 2; 0: "
            "lines; default: 0.25",
            GROUP,
            "T",
            least=0.0,
            greatest=2.0,
            entry="thickness",
        ),
    ),
    Option(
        "pitch",
        "Pitch",
        "From one LED of a strip to the next, in millimetres: 16.67 of 60 a metre",
        PANEL,
        default=PITCH,
        least=0.1,
        greatest=1e6,
        soft_least=1.0,
        soft_greatest=100.0,
        digits=3,
        flag=Flag(
            "--pitch",
            "from one LED of a strip to the next, in mm; default: 16.667, as of 60 a metre",
            GROUP,
            "D",
            least=0.1,
            greatest=1e6,
            entry="pitch",
        ),
    ),
    Option(
        "ros_message",
        "Message",
        "The message of ROS that a file of poses holds, one for each strand",
        PANEL,
        kind=str,
        default=MESSAGES[0][0],
        choices=MESSAGES,
        flag=Flag(
            "--ros-message",
            "the message of ROS that a .yaml holds, one for each strand; default: pose_array",
            GROUP,
            entry="ros_message",
        ),
    ),
    Option(
        "standoff",
        "Standoff",
        "Distance of a robot's tool from the surface, along its normal, in scene units",
        PANEL,
        default=0.0,
        least=-1e6,
        greatest=1e6,
        soft_least=-1.0,
        soft_greatest=1.0,
        digits=3,
        flag=Flag(
            "--standoff",
            "distance of the tool from the surface in --poses and .yaml, in scene units; default: "
            "0",
            GROUP,
            "D",
            entry="standoff",
        ),
    ),
    Option(
        "approach",
        "Approach",
        "How much farther from the surface a robot's tool begins and ends each strand, in scene "
        "units",
        PANEL,
        default=0.0,
        least=0.0,
        greatest=1e6,
        soft_greatest=1.0,
        digits=3,
        flag=Flag(
            "--approach",
            "in --poses and .yaml: begin and end each strand this much farther from the surface",
            GROUP,
            "D",
            above=0.0,
            entry="approach",
        ),
    ),
)
