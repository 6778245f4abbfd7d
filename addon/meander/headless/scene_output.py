# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what has grown into a scene: the curve beside its surface, its points, baked frames."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np

from .. import core
from ..cli import flags
from ..cli.grown import Grown, bridged
from ..cli.input import Input
from ..cli.values import BadInput
from ..model.density import Choice
from ..model.geometry import surface_crossings, thinning
from ..model.geometry.simplification import result_points
from ..model.options.input import light_of
from ..model.options.option import store
from ..model.options.table import TABLE
from ..model.problem import Problem
from ..model.toolpaths import bridges, toolpath
from ..run import bake
from ..scene import points as point_attributes
from ..scene import strands as scene_strands
from ..scene.alignment import store_alignment
from ..scene.bake import frames_of
from ..scene.curve_writer import write_curve
from ..scene.cut import keep_shading, skin_of, write_cut
from ..scene.density import store_choice
from ..scene.errors import DataError
from ..scene.evaluated import matrix_of
from ..scene.linked_settings import settings_of
from ..scene.options import keep_shape
from ..scene.preparation import store_mask, store_repair
from ..scene.settings import copy_settings
from ..scene.view_aid import lay_on_what_is_shown
from .saved_settings import saved_settings

# What the curve keeps of the flags: how long a run may take, and on how many threads, is for the
# next one to say.
_KEPT = tuple(
    option
    for option in TABLE
    if option.flag is not None and option.setting not in ("iteration_limit", "threads")
)


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
) -> tuple[int, bridges.Joined | None, np.ndarray | None]:
    """Adds the curve beside its surface and saves a copy of the scene at `path`.

    The curve keeps what it was made with, so that Continue works on it in a window. Returns the
    number of its points, what was joined to one line, and where a light curve crosses itself.
    """
    surface_object = given.surface_object or _new_surface(arguments.input.stem, given.problem)
    spacing = thinning.least_spacing(arguments.spacing / 2, grown.density)
    light = light_of(flags.chosen(arguments))
    kept = result_points(grown.curve, spacing, light)
    shown, radii = thinning.with_points(grown.curve, kept), grown.data.radii[kept]
    guides = grown.guides
    line = bridges.joined(shown, spacing, guides) if arguments.bridge else None
    if line is not None:
        shown, radii, guides = line.polylines, line.values(radii), line.guides
        grown = bridged(grown, given.problem)
    matrix = matrix_of(surface_object, bpy.context.evaluated_depsgraph_get())
    name = f"{surface_object.name} Meander"
    curve_object = write_curve(shown, surface_object, name, matrix=matrix)
    lay_on_what_is_shown(curve_object, surface_object, bpy.context.scene)
    with saved_settings():
        _store(arguments, given, surface_object, curve_object)
        scene_strands.note_guides(curve_object, guides, keep=True)
        curve_object.meander.figures.least_spacing = spacing
        curve_object.meander.figures.whole_points = len(grown.curve.positions)
        point_attributes.store_medial_radii(curve_object, radii, matrix)
        if line is not None:
            curve_object.meander.figures.bridges = bridges.to_text(line)
        if arguments.points is not None:
            curve_object.meander.figures.points = point_attributes.make(
                arguments.points.upper(),
                f"{curve_object.name} Points",
                toolpath.strands_of(grown.curve, grown.data),
                surface_object,
                matrix,
            )
        _bake(arguments, curve_object)
        _save(path, arguments.output)
    places = None if light is None else surface_crossings.of_polylines(shown, spacing)
    return len(shown.positions), line, places


def baked_frames(
    arguments: argparse.Namespace, given: Input, grown: Grown
) -> tuple[list[tuple[float, list[toolpath.Strand]]], float]:
    """The frames of --bake-frames, each with its strands, and how many are a second. The curve is
    in the scene from then on."""
    surface_object, scene = given.surface_object, bpy.context.scene
    matrix = matrix_of(surface_object, bpy.context.evaluated_depsgraph_get())
    curve_object = write_curve(grown.curve, surface_object, "Meander", matrix=matrix)
    with saved_settings():
        _store(arguments, given, surface_object, curve_object)
        scene_strands.note_guides(curve_object, grown.guides, keep=True)
        spacing = thinning.least_spacing(arguments.spacing / 2, grown.density)
        curve_object.meander.figures.least_spacing = spacing
        _bake(arguments, curve_object)
        try:
            frames = frames_of(curve_object, bpy.context, *arguments.bake_frames)
        except DataError as refusal:
            raise BadInput(f"the frames cannot be baked: {refusal}") from refusal
    return frames, scene.render.fps / scene.render.fps_base


def write_cut_scene(
    path: Path, arguments: argparse.Namespace, given: Input, cut: core.CutSurface
) -> None:
    """Adds the cut beside its surface and saves a copy of the scene at `path`."""
    surface_object = given.surface_object or _new_surface(arguments.input.stem, given.problem)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    skin = skin_of(surface_object, depsgraph)
    matrix = matrix_of(surface_object, depsgraph)
    name = f"{surface_object.name} Cut"
    faces = given.problem.faces
    made = write_cut(name, cut, surface_object, faces, skin, matrix, arguments.spacing)
    keep_shading(made)
    with saved_settings():
        _save(path, arguments.cut)


def _empty_scene() -> None:
    # read_factory_settings would take installed add-ons out of the session.
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


def _new_surface(name: str, problem: Problem) -> bpy.types.Object:
    """The mesh of a file of its own, as the only object of an empty scene."""
    _empty_scene()
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
    copy_settings(settings_of(surface_object), curve_object.meander)
    made_with = curve_object.meander
    made_with.surface = surface_object
    store(_KEPT, flags.chosen(arguments), made_with)
    if made_with.use_weights:
        stiffness = arguments.bending  # it may have been raised for --least-bend-radius
        options = given.problem.options
        if stiffness is not None:
            options = replace(options, bending_weight=stiffness)
        keep_shape(options, made_with)
    store_choice(_density_choice(given, surface_object), made_with)
    store_alignment(given.alignment, made_with)
    if arguments.guides_object is not None:
        made_with.guides = bpy.context.scene.objects.get(arguments.guides_object)
    made_with.keep_guides = not arguments.leave_out_guides
    if arguments.points is not None:
        made_with.points_as = arguments.points.upper()
    store_repair(given.repair, made_with)
    store_mask(given.mask, made_with)


def _density_choice(given: Input, surface_object: bpy.types.Object) -> Choice:
    """Where the density comes from in the scene: what a mesh file says of its surface becomes an
    attribute of the new one."""
    choice, values = given.density_choice, given.values
    if values is None:
        return choice
    attribute = surface_object.data.attributes.new("Density Values", "FLOAT", "POINT")
    attribute.data.foreach_set("value", values.astype(np.float32))
    value_range = choice.value_range
    if value_range is None and not choice.is_tone:
        ramp = choice.ramp(values)
        value_range = (ramp.low, ramp.high)
    return replace(
        choice, source="ATTRIBUTE", name=attribute.name, uv_map="", value_range=value_range
    )


def _bake(arguments: argparse.Namespace, curve_object: bpy.types.Object) -> None:
    if arguments.bake_frames is None:
        return
    try:
        bake.bake_motion(
            curve_object, bpy.context, *arguments.bake_frames, arguments.round or 0.0
        )
    except DataError as refusal:
        raise BadInput(f"the frames cannot be baked: {refusal}") from refusal


def is_whole(path: Path) -> bool:
    """Whether a .blend ends as Blender ends one: by the block ENDB, or a table of compressed parts.

    From 5.0 on Blender says that it has saved a file of which the disk took a part.
    """
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 40))
        end = file.read()
    return b"ENDB" in end or end.endswith(b"\xb1\xea\x92\x8f")


def _save(path: Path, wanted: Path) -> None:
    try:
        bpy.ops.wm.save_as_mainfile(filepath=str(path.absolute()), copy=True, check_existing=False)
        if not is_whole(path):
            raise RuntimeError("it did not take the whole file")
    except RuntimeError as failure:
        raise BadInput(
            f"Blender cannot save {wanted} ({' '.join(str(failure).split())}); "
            "choose another place"
        ) from failure
