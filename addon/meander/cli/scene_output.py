# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what has grown into a scene: the curve beside its surface, its points, baked frames."""

from __future__ import annotations

import argparse
from pathlib import Path

import bpy

from ..model import thinning, toolpath
from ..model.problem import Problem
from ..run import baking
from ..scene import point_attributes
from ..scene import strands as scene_strands
from ..scene.alignment import store_alignment
from ..scene.curve_writer import write_curve
from ..scene.density import store_choice
from ..scene.errors import DataError
from ..scene.preparation import store_mask, store_repair
from ..scene.settings import copy_settings
from ..scene.terms import store_terms
from ..scene.transforms import world_matrix
from . import terms
from .grown import Grown
from .input import Input
from .saved_settings import saved_settings
from .scene_input import empty_scene
from .values import BadInput


def refuse_points(points: str | None) -> None:
    """Refuses a --points that this Blender cannot make."""
    try:
        point_attributes.refuse((points or "none").upper())
    except DataError as refusal:
        raise BadInput(f"--points {points} is not possible here: {refusal}") from refusal


def write_scene(
    path: Path,
    arguments: argparse.Namespace,
    given: Input,
    grown: Grown,
) -> None:
    """Adds the curve beside its surface and saves a copy of the scene at `path`.

    The curve keeps what it was made with, so that Continue works on it in a window.
    """
    surface_object = given.surface_object or _new_surface(arguments.input.stem, given.problem)
    distance = thinning.merge_distance(arguments.spacing / 2, grown.density)
    kept = thinning.kept_points(grown.curve, distance)
    thinned = thinning.thinned(grown.curve, distance)
    curve_object = write_curve(thinned, surface_object, f"{surface_object.name} Meander")
    with saved_settings():
        _store(arguments, given, surface_object, curve_object)
        scene_strands.note_guides(curve_object, grown.guides, keep=True)
        matrix = world_matrix(surface_object)
        point_attributes.remember_room(curve_object, grown.data.radii[kept], matrix)
        if arguments.points is not None:
            curve_object.meander.figures.points = point_attributes.make(
                arguments.points.upper(),
                f"{curve_object.name} Points",
                toolpath.strands_of(grown.curve, grown.data),
                surface_object,
                matrix,
            )
        _bake(arguments, curve_object)
        _save(path, arguments)


def _new_surface(name: str, problem: Problem) -> bpy.types.Object:
    """The mesh of an OBJ file, as the only object of an empty scene."""
    empty_scene()
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(problem.vertices.tolist(), [], problem.faces.tolist())
    mesh.update()
    surface_object = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(surface_object)
    return surface_object


def _store(
    arguments: argparse.Namespace,
    given: Input,
    surface_object: bpy.types.Object,
    curve_object: bpy.types.Object,
) -> None:
    """Writes what the curve was made with into its settings."""
    copy_settings(surface_object.meander, curve_object.meander)
    made_with = curve_object.meander
    made_with.surface = surface_object
    made_with.spacing = arguments.spacing
    made_with.preset = arguments.preset.upper()
    made_with.medial_axis = arguments.medial_axis.upper()
    store_choice(given.density_choice, made_with)
    store_alignment(given.alignment, made_with)
    store_terms(terms.terms_of(arguments), made_with)
    made_with.seed_every_part = arguments.fill_every_part
    if arguments.guides_object is not None:
        made_with.guides = bpy.context.scene.objects.get(arguments.guides_object)
    made_with.keep_guides = not arguments.leave_out_guides
    if arguments.points is not None:
        made_with.points_as = arguments.points.upper()
    store_repair(given.repair, made_with)
    store_mask(given.mask, made_with)
    made_with.use_outline = arguments.outline
    if arguments.border_distance is not None:
        made_with.border_distance = arguments.border_distance


def _bake(arguments: argparse.Namespace, curve_object: bpy.types.Object) -> None:
    curve_object.meander.motion = arguments.motion.upper()
    curve_object.meander.motion_steps = arguments.motion_steps
    if arguments.bake_frames is None:
        return
    try:
        baking.bake_motion(curve_object, bpy.context, *arguments.bake_frames)
    except DataError as refusal:
        raise BadInput(f"the frames cannot be baked: {refusal}") from refusal


def _save(path: Path, arguments: argparse.Namespace) -> None:
    try:
        bpy.ops.wm.save_as_mainfile(filepath=str(path.absolute()), copy=True, check_existing=False)
    except RuntimeError as failure:
        raise BadInput(
            f"Blender cannot save {arguments.output} ({' '.join(str(failure).split())}); "
            "choose another place"
        ) from failure
