# SPDX-License-Identifier: GPL-3.0-or-later
"""What is done to the mesh, and which part of it is filled, as settings on an object."""

import bpy
from bpy.props import EnumProperty, StringProperty

from ..scene.attributes import mask_names


class PreparationSettings:
    """The part of MeanderSettings that says what is done to the mesh, and which part is filled."""

    mask_source: EnumProperty(
        name="Fill",
        description="Which part of the mesh the curve fills; its edge acts as a boundary",
        items=(
            ("NONE", "Whole Mesh", "All faces"),
            ("MATERIAL", "Material", "The faces that have a material"),
            ("ATTRIBUTE", "Face Attribute", "The faces for which an attribute is true or not 0"),
            ("GROUP", "Vertex Group", "Where the weight is high enough, also across faces"),
        ),
        default="NONE",
        options=set(),
    )
    mask_material: StringProperty(
        name="Material", description="Only faces with this material are filled", options=set()
    )
    mask_attribute: StringProperty(
        name="Attribute",
        description=(
            "Boolean or integer attribute of faces, or a face map in Blender before 4.0; faces "
            "where it is false or 0 are left out"
        ),
        search=mask_names,
        search_options={"SUGGESTION"},
        options=set(),
    )
    mask_group: StringProperty(
        name="Group",
        description="Vertex group; what has less than the threshold is left out",
        options=set(),
    )


class MeanderProblem(bpy.types.PropertyGroup):
    """Why the mesh was refused last."""

    sentence: StringProperty(name="Sentence", options=set())  # empty: it was not
