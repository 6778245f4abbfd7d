# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result looks like, and what is made beside it, as settings on an object."""

import bpy
from bpy.props import BoolProperty, EnumProperty

from ..scene import look_modifier

# The cross sections that the look of a curve has, by the numbers that its modifier keeps.
PROFILES = (
    ("ROUND", "Round", "A tube"),
    ("SQUARE", "Square", "A bar with four edges, one side on the surface"),
    ("RIBBON", "Ribbon", "Flat on the surface"),
    ("WALL", "Wall", "Thin, and upright on the surface"),
    ("ROPE", "Rope", "Plies that wind round one another, as in rope and yarn"),
)


def _shown_profile(settings: bpy.types.PropertyGroup) -> int:
    modifier = look_modifier.modifier_of(settings.id_data)
    number = None if modifier is None else look_modifier.value_of(modifier, "Profile")
    return min(max(int(number or 0), 0), len(PROFILES) - 1)


def _choose_profile(settings: bpy.types.PropertyGroup, number: int) -> None:
    modifier = look_modifier.modifier_of(settings.id_data)
    if modifier is not None:
        look_modifier.set_value(modifier, "Profile", number)


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
        get=_shown_profile,
        set=_choose_profile,
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
