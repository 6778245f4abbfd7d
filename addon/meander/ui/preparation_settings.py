# SPDX-License-Identifier: GPL-3.0-or-later
"""What is done to the mesh, and which part of it is filled, as settings on an object."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntVectorProperty, StringProperty

from ..scene.attributes import mask_names


class PreparationSettings:
    """The part of MeanderSettings that says what is done to the mesh, and which part is filled."""

    mask_source: EnumProperty(
        name="Fill",
        description="Which part of the mesh the curve fills; its edge acts as a border",
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
    mask_threshold: FloatProperty(
        name="Threshold",
        description="The border runs where the weight is this, straight through faces",
        default=0.5,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
        options=set(),
    )
    mask_inverted: BoolProperty(
        name="Invert",
        description="Fill what would be left out, and leave out what would be filled",
        default=False,
        options=set(),
    )
    border_distance: FloatProperty(
        name="Distance",
        description=(
            "Distance of the last strand from borders and holes, in spacings. "
            "At 0 strands run along the border"
        ),
        default=0.5,
        min=0.0,
        max=2.0,
        precision=2,
        step=5,
        options=set(),
    )
    use_outline: BoolProperty(
        name="Outline First",
        description=(
            "Lay a fixed strand along every border at the border distance, and fill what is "
            "left inside"
        ),
        default=False,
        options=set(),
    )
    use_merge: BoolProperty(
        name="Merge Close Vertices",
        description="Take vertices that are very near each other as one; the mesh stays as it is",
        default=False,
        options=set(),
    )
    merge_distance: FloatProperty(
        name="Distance",
        description="Vertices this near to each other are one, in world units",
        default=0.0001,
        min=0.0,
        soft_max=0.1,
        precision=5,
        step=1,
        unit="LENGTH",
        options=set(),
    )
    drop_degenerate: BoolProperty(
        name="Dissolve Degenerate",
        description="Do without faces that have no area or are there twice, instead of refusing",
        default=False,
        options=set(),
    )
    split_bow_ties: BoolProperty(
        name="Split Bow-Ties",
        description="Part faces that meet in one vertex only, instead of refusing the mesh",
        default=False,
        options=set(),
    )
    cut_non_manifold: BoolProperty(
        name="Cut Non-Manifold Edges",
        description=(
            "Take edges with more than two faces as borders, where every sheet ends, instead of "
            "refusing the mesh"
        ),
        default=False,
        options=set(),
    )


class MeanderProblem(bpy.types.PropertyGroup):
    """The element of the mesh because of which the last run did not begin."""

    kind: StringProperty(name="Kind", options=set())  # "vertex", "edge", "face"; empty: none
    elements: IntVectorProperty(name="Elements", size=2, options=set())
    sentence: StringProperty(name="Sentence", options=set())
