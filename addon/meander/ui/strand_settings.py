# SPDX-License-Identifier: GPL-3.0-or-later
"""What else there is beside the seed, as settings on an object."""

import bpy
from bpy.props import BoolProperty, PointerProperty

from ..scene.curve_reader import has_strands
from ..scene.linked_settings import owner_of


def _is_another(settings: bpy.types.PropertyGroup, object: bpy.types.Object) -> bool:
    return object != owner_of(settings)


def _is_another_curve(settings: bpy.types.PropertyGroup, object: bpy.types.Object) -> bool:
    return has_strands(object) and object != owner_of(settings)


class StrandSettings:
    """The part of MeanderSettings that says what else there is beside the seed."""

    stroke_from: PointerProperty(
        type=bpy.types.Object,
        name="From",
        description=(
            "Without a seed: begin one open strand at the origin of this object, on or close to "
            "the surface. Its ends stay there, so that one stroke fills the surface"
        ),
        poll=_is_another,
        options=set(),
    )
    stroke_to: PointerProperty(
        type=bpy.types.Object,
        name="To",
        description="End that strand at the origin of this object",
        poll=_is_another,
        options=set(),
    )
    guides: PointerProperty(
        type=bpy.types.Object,
        name="Guides",
        description=(
            "Curve or text that stays as drawn, moved to the surface, while the others keep the "
            "spacing from it. Its splines may cross and touch each other"
        ),
        poll=_is_another_curve,
        options=set(),
    )
    guide_collection: PointerProperty(
        type=bpy.types.Collection,
        name="Collection",
        description="All curves and texts in this collection are guides as well",
        options=set(),
    )
    keep_guides: BoolProperty(
        name="Keep Guides",
        description="Write the guides into the result, as splines of their own",
        default=True,
        options=set(),
    )
