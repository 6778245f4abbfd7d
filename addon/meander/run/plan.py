# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run needs to know of the scene, read once when it begins.

A plan keeps keys and arrays, never references to Blender's data: those die with undo, with
deletion and with a new file.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import bpy
import numpy as np

from .. import core
from ..model import strands
from ..model.density import TONE, Choice
from ..model.geometry.reflection import mirror_of
from ..model.geometry.simplification import Light
from ..model.options.input import light_of
from ..model.options.option import OF_PRESET, as_typed, chosen
from ..model.options.table import in_panel
from ..model.preparation import Mask
from ..model.problem import Problem, begin_along_directions
from ..scene import points, results
from ..scene import strands as scene_strands
from ..scene.alignment import alignment_of, directions_of
from ..scene.density import choice_of, chosen_density, density_of, unused_paint
from ..scene.errors import DataError
from ..scene.evaluated import evaluated_once, instances_of, matrix_of
from ..scene.fillable import why_not
from ..scene.home_scene import HomeScene
from ..scene.identity import Key
from ..scene.linked_settings import settings_of
from ..scene.look import Look
from ..scene.meshes import loose_edge_count, triangles_of
from ..scene.options import options_of
from ..scene.picture import tones_of
from ..scene.preparation import (
    mask_of,
    repair_of,
    selected_faces,
    surface_options,
    triangles_of_region,
)
from ..scene.settings import surface_of


@dataclass(frozen=True)
class Plan:
    """Everything that a run needs to know of the scene, read once when it begins."""

    problem: Problem
    home: HomeScene  # of the surface
    surface: Key
    settings: Key  # whose settings were used: the surface or the result
    result: Key | None  # the result that gets the curve; None makes a new one
    matrix: np.ndarray  # of the surface
    spacing: float
    look: Look  # of a new result
    parts: tuple[strands.Part, ...]  # what the seed was put together from
    materials: scene_strands.SplineMaterials  # materials of the splines
    name: str  # of a new result
    from_surface: bool = True  # the surface was filled; else a result goes on or starts over
    loose_edges: int = 0  # of the surface, in no face
    instances: tuple[int, bool] = (0, False)  # that the surface consists of; whether others show
    keeps_guides: bool = True  # the result has the guides as splines of its own
    radius_follows: bool = False  # a density makes the curve thinner where it is closer
    density_group: str = ""  # the vertex group that the spacing follows
    region: np.ndarray | None = None  # polygons of the mesh, selected in Edit Mode; None: all
    remark: str = ""  # on what the run leaves out, for its one line
    points_as: str = "NONE"  # a second object of all points: one of points.KINDS
    bridges: bool = False  # all that has grown becomes one line
    light: Light | None = None  # which points the result has; None: all
    begins: bool = True  # from a seed or from nothing; else with the line that a result has
    beside: bool = False  # another curve was asked for: the run has chosen which


def plan_run(context: bpy.types.Context, restart: bool = False, beside: bool = False) -> Plan:
    """Reads the scene for a run on the active object: a mesh, or a result to go on with.

    restart   start a result from the seed again, not from its own splines
    beside    make a new result beside those that the mesh has, instead of updating one

    Raises DataError or core.MeanderError with a sentence for what cannot be used.
    """
    depsgraph = context.evaluated_depsgraph_get()
    return plan_of(context.active_object, context.scene, depsgraph, restart, beside)


def plan_of(
    active: bpy.types.Object | None,
    scene: bpy.types.Scene,
    depsgraph: bpy.types.Depsgraph,
    restart: bool = False,
    beside: bool = False,
) -> Plan:
    """The plan of a run on any object, wherever the context is; see plan_run()."""
    with evaluated_once(depsgraph):
        return _plan_of(active, scene, depsgraph, restart, beside)


def _ask_more(problem: Problem, settings: bpy.types.PropertyGroup, matrix: np.ndarray) -> None:
    """What the settings ask of a run beside its seed and its fields."""
    problem.least_bend_radius = float(f"{settings.least_bend_radius:.6g}")
    if settings.mirror != "NONE":
        problem.mirror = mirror_of(settings.mirror.lower(), matrix, settings.hide_seam)
    if settings.start == OF_PRESET.upper():
        begin_along_directions(problem)


def _plan_of(
    active: bpy.types.Object | None,
    scene: bpy.types.Scene,
    depsgraph: bpy.types.Depsgraph,
    restart: bool,
    beside: bool,
) -> Plan:
    surface = surface_of(active)
    _refuse_missing(surface, active, scene)
    settings = settings_of(active)
    points.refuse(settings.points_as)
    vertices, faces = triangles_of(surface, depsgraph)
    spacing = as_typed(settings.spacing) or core.automatic_spacing(vertices, faces)
    choice = chosen_density(settings, surface)
    density = density_of(choice, surface, depsgraph, spacing / 2.0)
    alignment = alignment_of(settings)
    directions = directions_of(alignment, surface, depsgraph, spacing / 2.0)
    from_surface = active is surface or beside
    parts, materials = scene_strands.parts_of(active, depsgraph, restart or beside)
    seed = _seed_of(parts, settings, vertices, faces, spacing / 2.0)
    region = selected_faces(surface) if active is surface else None
    prepared = _prepared(vertices, spacing / 2.0, region, settings, surface, depsgraph)
    options = options_of(settings, spacing)
    options.alignment_weight = alignment.weight if directions is not None else 0.0
    outline = _outline_distance(active, options, from_surface or restart)
    earlier = results.last_result(surface, scene) if from_surface else active
    if beside:
        earlier = None
        options.variation = results.next_variation(surface, settings.variation)
    problem = Problem(
        vertices, faces, options, seed, density, prepared, directions, alignment.kind, outline
    )
    shown = instances_of(surface, depsgraph)
    problem.copies = shown.sizes if len(shown.sizes) else None
    matrix = matrix_of(surface, depsgraph)
    _ask_more(problem, settings, matrix)
    problem.tones = tones_of(choice, problem, matrix, settings.bevel_share)
    plan = Plan(
        problem=problem,
        home=HomeScene(scene, depsgraph.view_layer),
        surface=Key(surface),
        settings=Key(active),
        result=Key(earlier) if earlier is not None else None,
        from_surface=from_surface,
        matrix=matrix,
        spacing=spacing,
        look=_look_of(settings, choice),
        parts=tuple(parts),
        materials=materials,
        name=f"{(settings.seed or surface).name} Meander",
        loose_edges=loose_edge_count(surface, depsgraph),
        instances=shown.in_words,
        keeps_guides=settings.keep_guides,
        density_group=choice.name if choice.source == "GROUP" else "",
        region=region,
        remark=unused_paint(choice, settings, surface),
        begins=from_surface or restart,
        beside=beside,
    )
    return with_looks(plan, settings)


def _refuse_missing(
    surface: bpy.types.Object | None, active: bpy.types.Object | None, scene: bpy.types.Scene
) -> None:
    if surface is None:
        raise DataError(why_not(active))
    if scene not in surface.users_scene[:]:
        raise DataError(
            f"The surface '{surface.name}' is not in this scene any more; choose a mesh to fill"
        )
    core.library_version()  # before anything is read, a missing library is reported


def _seed_of(
    parts: list[strands.Part],
    settings: bpy.types.PropertyGroup,
    vertices: np.ndarray,
    faces: np.ndarray,
    radius: float,
) -> core.Seed | None:
    """What the run starts from; None: nothing was drawn."""
    most = 0.0
    if any(part.drawn for part in parts):
        most = strands.max_distance_of(vertices)
        scene_strands.check_on_surface(parts, vertices, faces, radius)
    return strands.assembled(parts, settings.seed_every_part, most)


def _prepared(
    vertices: np.ndarray,
    radius: float,
    region: np.ndarray | None,
    settings: bpy.types.PropertyGroup,
    surface: bpy.types.Object,
    depsgraph: bpy.types.Depsgraph,
) -> core.SurfaceOptions:
    """How the surface is prepared, with the part to fill: a region, else what the settings say."""
    mask = mask_of(settings) if region is None else Mask()
    mended = repair_of(settings).options(vertices, radius)
    prepared = surface_options(mended, mask, surface, depsgraph)
    if region is not None:
        prepared.face_mask = triangles_of_region(region, surface, depsgraph)
    return prepared


def with_looks(plan: Plan, settings: bpy.types.PropertyGroup) -> Plan:
    """The same plan with what a result shows of its curve as the settings say now."""
    return replace(
        plan,
        radius_follows=settings.radius_follows and choice_of(settings).interpolation != TONE,
        points_as=settings.points_as,
        bridges=settings.bridge_parts,
        light=light_of(chosen(in_panel("Make"), settings)),
    )


def _look_of(settings: bpy.types.PropertyGroup, choice: Choice) -> Look:
    """What a new result is to look like. With a tone it is as thick as the line that was thought
    of, or it would look darker or lighter."""
    profile = settings.bl_rna.properties["profile"].enum_items[settings.profile].value
    share = choice.line / 2.0 if choice.is_tone else settings.bevel_share
    radius = share if settings.use_bevel else 0.0
    return Look(radius, profile, round=settings.round_share)


def _outline_distance(
    active: bpy.types.Object, options: core.FlowOptions, from_seed: bool
) -> float:
    """How far from the boundary a run lays outlines; 0: it lays none."""
    if not settings_of(active).use_outline or not (from_seed or _lays_outline_again(active)):
        return 0.0
    if options.boundary_distance < 0.1:
        raise DataError("An outline needs a boundary distance of 0.1 or more; raise it")
    return options.boundary_distance * 2.0 * options.radius


def _lays_outline_again(active: bpy.types.Object) -> bool:
    """Whether a result that goes on gets an outline: where it has its own it goes on with that."""
    if not active.meander.figures.guides:
        return True
    if active.meander.guides is not None or active.meander.guide_collection is not None:
        raise DataError(
            f"'{active.name}' has drawn guides and an outline, which cannot be told apart; use "
            "Fill Again"
        )
    return False
