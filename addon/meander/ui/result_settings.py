# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result looks like, and what is made beside it, as settings on an object."""

import bpy
from bpy.props import BoolProperty, EnumProperty

from ..scene import look

# The cross sections that the look of a curve has, by the numbers that its modifier keeps.
PROFILES = (
    ("ROUND", "Round", "A tube"),
    ("SQUARE", "Square", "A bar with four edges, one side on the surface"),
    ("RIBBON", "Ribbon", "Flat on the surface"),
    ("WALL", "Wall", "Thin, and upright on the surface"),
    ("ROPE", "Rope", "Plies that wind round one another, as in rope and yarn"),
)
# The same of the ends of open lines.
ENDS = (
    ("FLAT", "Flat", "Cut off"),
    ("ROUND", "Round", "Half a ball"),
    ("NEON", "Neon", "The sleeves and wires of a neon tube"),
    ("PLUG", "Plug", "The plugs of a cable, which rise from the surface"),
)


def _modifier_of(settings: bpy.types.PropertyGroup) -> bpy.types.Modifier | None:
    """That of the look; settings of a linked surface are the scene's, which has none."""
    thing = settings.id_data
    return look.modifier_of(thing) if isinstance(thing, bpy.types.Object) else None


def _shown(settings: bpy.types.PropertyGroup, name: str, count: int) -> int:
    modifier = _modifier_of(settings)
    number = None if modifier is None else look.value_of(modifier, name)
    return min(max(int(number or 0), 0), count - 1)


def _choose(settings: bpy.types.PropertyGroup, name: str, number: int) -> None:
    modifier = _modifier_of(settings)
    if modifier is not None:
        look.set_value(modifier, name, number)


def _choose_ends(settings: bpy.types.PropertyGroup, number: int) -> None:
    _choose(settings, "Ends", number)
    if isinstance(settings.id_data, bpy.types.Object):
        look.give_ends_material(settings.id_data)


class ProfileSettings:
    """Settings of the thickness of a result, mixed into MeanderSettings."""

    profile: EnumProperty(
        name="Profile",
        description="Cross section of a new curve",
        items=PROFILES,
        default="ROUND",
        options=set(),
    )
    shown_profile: EnumProperty(
        name="Profile",
        description="Cross section of the curve",
        items=PROFILES,
        get=lambda settings: _shown(settings, "Profile", len(PROFILES)),
        set=lambda settings, number: _choose(settings, "Profile", number),
        options=set(),
    )
    shown_ends: EnumProperty(
        name="Ends",
        description="What is at the ends of open lines",
        items=ENDS,
        get=lambda settings: _shown(settings, "Ends", len(ENDS)),
        set=_choose_ends,
        options=set(),
    )
    radius_follows: BoolProperty(
        name="Radius Follows Spacing",
        description="With a density, make the curve thinner where its strands are closer",
        default=True,
        options=set(),
    )


class PointSettings:
    """What a run makes beside its curve, mixed into MeanderSettings."""

    points_as: EnumProperty(
        name="Points As",
        description=(
            "Make a second object of all points of the curve, with arc length, surface normal, "
            "tangent, r+, r-, triangle and weights as attributes, for Geometry Nodes and materials"
        ),
        items=(
            ("NONE", "None", "Only the curve"),
            ("MESH", "Mesh", "A mesh of points and edges"),
            ("CURVES", "Hair Curves", "A curve with attributes; Blender 4.2 or later"),
        ),
        default="NONE",
        options=set(),
    )
