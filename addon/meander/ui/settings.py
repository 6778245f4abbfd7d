# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings on an object: those of the next run, on a surface and on its curve.

Both have the same: see scene.shared_settings. They are saved with the file, those of linked
surfaces with the scene: see scene.linked_settings. A result is a curve object whose settings name
its surface.
"""



import bpy

from ..model.options.table import TABLE, in_panel
from ..run import motion
from ..scene import look, results
from ..scene.curve_reader import has_strands
from ..scene.fillable import has_faces, is_result
from ..scene.linked_settings import owner_of
from ..scene.shared_settings import watched
from .alignment import AlignmentSettings
from .declared import declared
from .density import DensitySettings
from .look import ProfileSettings
from .motion import FollowSettings
from .points import PointSettings
from .preparation import MeanderProblem, PreparationSettings
from .registered import registration
from .strands import StrandSettings
from .unanimated import (
    BoolProperty,
    CollectionProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)


# A class either takes its annotations from the table or writes its own: from Python 3.14 on it
# cannot do both.
class TableSettings:
    """The part of MeanderSettings that the table declares."""

    __annotations__ = declared(option for option in TABLE if option.panel != "Motion")


class MotionSettings:
    """The settings of a result that follows its surface, which starts again when they change."""

    __annotations__ = declared(
        in_panel("Motion"),
        update=lambda settings, context: motion.begin(owner_of(settings), context),
    )


def _is_surface(_settings: bpy.types.PropertyGroup, object: bpy.types.Object) -> bool:
    return has_faces(object)


def _is_result(settings: bpy.types.PropertyGroup, object: bpy.types.Object) -> bool:
    return results.is_result_of(object, owner_of(settings))


def _is_made_by_meander(_settings: bpy.types.PropertyGroup, object: bpy.types.Object) -> bool:
    return is_result(object)


def _is_curve(settings: bpy.types.PropertyGroup, object: bpy.types.Object) -> bool:
    return has_strands(object) and object != owner_of(settings)


class MeanderGap(bpy.types.PropertyGroup):
    """A place that the curve leaves empty."""

    position: FloatVectorProperty(
        name="Position",
        description="In the space of the surface, which is that of the curve",
        subtype="TRANSLATION",
    )
    size: FloatProperty(
        name="Size",
        description="Distance to the curve over half the spacing there; 1 is as wanted",
    )


class MeanderFigures(bpy.types.PropertyGroup):
    """What the last run came to; shown in the panel, set by the operator."""

    stop_reason: StringProperty(name="Stop Reason")
    nodes: IntProperty(name="Nodes")
    iterations: IntProperty(name="Iterations")
    length: FloatProperty(name="Length", unit="LENGTH")
    spacing: FloatProperty(
        name="Spacing",
        description="That of the run; the setting may be another by now. 0: not kept",
        unit="LENGTH",
    )
    spacing_median: FloatProperty(name="Median Spacing", unit="LENGTH")
    seconds: FloatProperty(name="Seconds")
    variation: IntProperty(
        name="Variation",
        description="Which of the curves of the same settings it is; New Curve makes the next",
    )
    run_number: IntProperty(name="Run", description="Among those on its surface")
    empty_parts: IntProperty(name="Empty Parts")
    # On results only: which of their splines are guides.
    strands: IntProperty(name="Strands")
    first_guide: IntProperty(name="First Guide")
    guides: IntProperty(name="Guides")
    # Of results made before this was counted there are no figures: -1, and no lines at all.
    evenness: FloatProperty(
        name="Evenness",
        description="Share of the curve whose spacing is within a fifth of what is wanted",
        default=-1.0,
    )
    smoothing: FloatProperty(
        name="Smoothing",
        description="What a rough surface was smoothed by where its spacing is measured, in half "
        "spacings",
    )
    stretch: FloatProperty(
        name="Stretch",
        description="Lengths on the surface in those on the smoothed one",
        default=1.0,
    )
    lines: IntProperty(name="Lines")
    closed_lines: IntProperty(name="Closed Lines")
    lines_why: StringProperty(name="Why So Many Lines")
    bridge_count: IntProperty(name="Bridges")
    bridge_length: FloatProperty(name="Length of Bridges", unit="LENGTH")
    bridges: StringProperty(name="Joined")  # how to take the line apart again
    wide_gaps: IntProperty(
        name="Gaps That Matter",
        description="Those farther than 0.75 spacings from the curve",
        default=-1,
    )
    gap_count: IntProperty(name="Gaps")
    largest_gap: FloatProperty(name="Largest Gap")
    empty_share: FloatProperty(
        name="Empty",
        description="Share of the surface that is farther than 0.8 spacings from the curve",
    )
    narrow_share: FloatProperty(
        name="Too Narrow",
        description="Share of the surface that is as far, and narrower than a spacing",
    )
    began: StringProperty(name="How It Began")
    preparation: StringProperty(name="Preparation")
    mended: IntProperty(name="Faults Repaired")
    # On results only: what their look has been told; the spacing in their own space.
    look_material: PointerProperty(type=bpy.types.Material, name="Material of the Look")
    look_spacing: FloatProperty(name="Spacing of the Look")
    look_follows: FloatProperty(name="Radius Follows Spacing in the Look")
    # How often Live has changed the curve, and what the settings asked for at the last run.
    live_changes: IntProperty(name="Live Changes")
    asked: StringProperty(name="Asked For")
    # The tolerance with which the drawn line was made, and of which points.
    round_told: FloatProperty(name="Round of the Drawn Line")
    round_of: StringProperty(name="Points of the Drawn Line")
    # On results only, and of many gaps only the largest.
    gaps: CollectionProperty(type=MeanderGap)
    whole_points: IntProperty(name="Points of the Whole Curve")
    least_spacing: FloatProperty(name="Least Spacing")  # world units; 0: unknown
    room: StringProperty(name="Room")  # r+ and r- of every point, packed
    points: PointerProperty(type=bpy.types.Object, name="Points")


class MeanderSettings(
    DensitySettings,
    AlignmentSettings,
    PreparationSettings,
    StrandSettings,
    TableSettings,
    MotionSettings,
    FollowSettings,
    ProfileSettings,
    PointSettings,
    bpy.types.PropertyGroup,
):
    """How to fill a surface; the parts that a feature of its own needs come from its module."""

    surface: PointerProperty(
        type=bpy.types.Object,
        name="Surface",
        description="The mesh that this curve fills; set on curves that Meander has made",
        poll=_is_surface,
    )
    last_result: PointerProperty(
        type=bpy.types.Object,
        name="Result",
        description=(
            "The curve that is updated when this mesh is filled again, and keeps its looks. "
            "Empty: a new one is made"
        ),
        poll=_is_result,
    )
    made_from: PointerProperty(
        type=bpy.types.Object,
        name="Made From",
        description=(
            "The curve that this object was made from, as by Two-Tone. Empty: it can be filled"
        ),
        poll=_is_made_by_meander,
    )
    made_material: PointerProperty(
        type=bpy.types.Material,
        name="Surface Material",
        description="The material of images that Make Material has made of this curve",
    )
    made_material_by: StringProperty(
        name="Material Made By",
        description="How that material was made, to make its images again",
    )
    made_by: StringProperty(
        name="Made By",
        description="How this object was made of its curve, to make it again",
    )
    keep_up: BoolProperty(
        name="Follow Curve",
        description=(
            "Make this object again whenever its curve is another. What you edit is left alone"
        ),
        default=True,
    )
    seed: PointerProperty(
        type=bpy.types.Object,
        name="Seed",
        description=(
            "Curve, text, Grease Pencil or mesh without faces to start from, on or close to the "
            "surface; each spline, outline, stroke, or chain of edges becomes a strand and stays "
            "open or cyclic. Empty: a small loop on every part of the mesh"
        ),
        poll=_is_curve,
    )
    live: BoolProperty(
        name="Live",
        description=(
            "Let the curve follow changes of spacing, density and strand shape at once, while it "
            "grows and after, also while you paint"
        ),
        default=False,
    )
    fixed_ends: BoolProperty(
        name="Fixed Ends",
        description="Keep the end points of open seed splines where they are",
        default=False,
    )
    use_bevel: BoolProperty(
        name="Thickness",
        description="Give a new curve a body, which the modifier of its look makes",
        default=True,
    )
    bevel_share: FloatProperty(
        name="Radius",
        description=(
            "Half the thickness of a new curve as a share of the spacing; at 0.5 neighbours touch"
        ),
        default=0.2,
        min=0.001,
        max=1.0,
        soft_min=0.02,
        soft_max=0.5,
        subtype="FACTOR",
    )
    round_share: FloatProperty(
        name="Round",
        description=(
            "How far a new line may be drawn beside the curve to make its turns round, as a share "
            "of the spacing"
        ),
        default=look.ROUND,
        min=0.0,
        max=0.5,
        soft_max=0.25,
        subtype="FACTOR",
    )
    figures: PointerProperty(type=MeanderFigures)
    problem: PointerProperty(
        type=MeanderProblem,
        name="Problem",
        description="Why the mesh was refused last",
    )


for _part in (*MeanderSettings.__bases__[:-1], MeanderSettings):
    watched(_part.__annotations__)


class MeanderLinked(bpy.types.PropertyGroup):
    """The settings of an object from another file, which cannot keep them itself."""

    surface: PointerProperty(type=bpy.types.Object, name="Surface")
    settings: PointerProperty(type=MeanderSettings)


_register, _unregister = registration(
    MeanderGap, MeanderFigures, MeanderProblem, MeanderSettings, MeanderLinked
)


def register() -> None:
    _register()
    bpy.types.Object.meander = PointerProperty(type=MeanderSettings)
    bpy.types.Scene.meander_linked = CollectionProperty(type=MeanderLinked)


def unregister() -> None:
    del bpy.types.Scene.meander_linked
    del bpy.types.Object.meander
    _unregister()
