# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result looks like, and what is made beside it, as settings on an object."""

from bpy.props import BoolProperty, EnumProperty


class ProfileSettings:
    """Settings of the thickness of a result, mixed into MeanderSettings."""

    flat_profile: BoolProperty(
        name="Flat Profile",
        description=(
            "Tilt the points so that an extrusion or a bevel object lies flat on the surface, with "
            "its X axis along the surface normal"
        ),
        default=False,
        options=set(),
    )
    radius_follows: BoolProperty(
        name="Radius Follows Spacing",
        description="Make the curve thicker where neighbouring strands are farther apart",
        default=False,
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
