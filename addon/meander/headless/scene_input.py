# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a .blend: the surface, and what objects beside it say."""

from __future__ import annotations

import argparse
from dataclasses import replace

import bpy

from .. import core
from ..cli import density, mirror, preparation, terms
from ..cli.input import Input
from ..cli.spacing import settled
from ..cli.values import BadInput
from ..model.problem import Problem
from ..scene.alignment import angle_source_of, directions_of
from ..scene.curve_reader import strands_of_curve
from ..scene.density import choice_of, density_of
from ..scene.errors import DataError
from ..scene.evaluated import instances_of, matrix_of
from ..scene.fillable import has_faces, why_not_this
from ..scene.linked_settings import settings_of
from ..scene.meshes import in_polygons as renumbered
from ..scene.meshes import loose_edge_count, polygons_of, triangles_of
from ..scene.preparation import surface_options
from ..scene.strands import part_of
from .saved_settings import saved_settings


def read(arguments: argparse.Namespace) -> Input:
    """What --input holds, with the objects that other options name. Raises BadInput."""
    try:
        return _read_scene(arguments)
    except DataError as refusal:
        raise BadInput(str(refusal)) from refusal


def _read_scene(arguments: argparse.Namespace) -> Input:
    """Opens a .blend and takes surface, seed and density from its objects, in world units."""
    try:
        bpy.ops.wm.open_mainfile(
            filepath=str(arguments.input.absolute()),
            load_ui=False,
            use_scripts=arguments.run_scripts,  # and not what the preferences say
        )
    except RuntimeError as problem:
        raise BadInput(
            f"{arguments.input} is no .blend file that Blender {bpy.app.version_string} can open; "
            "save it again with this version or an older one"
        ) from problem
    if arguments.frame is not None:
        bpy.context.scene.frame_set(arguments.frame)
    surface_object = _mesh_object(arguments)
    with saved_settings():
        settings = settings_of(surface_object)
        choice = density.choice_of(arguments, choice_of(settings))
        fixed_ends = settings.fixed_ends
    depsgraph = bpy.context.evaluated_depsgraph_get()
    vertices, faces = triangles_of(surface_object, depsgraph)
    problem = Problem(vertices, faces, settled(arguments, vertices, faces))
    mirror.reflect(problem, arguments, matrix_of(surface_object, depsgraph))
    given = Input(problem, choice, surface_object=surface_object)
    given.polygons = polygons_of(surface_object, depsgraph)
    given.mask = preparation.mask_of(arguments)
    if given.mask.source != "NONE":
        mended = preparation.repair_of(arguments).options(problem.vertices, arguments.spacing / 2)
        problem.surface_options = surface_options(mended, given.mask, surface_object, depsgraph)
    given.loose_edges = loose_edge_count(surface_object, depsgraph)
    shown = instances_of(surface_object, depsgraph)
    given.instances = shown.in_words
    # What is made of the surface itself takes it as it is.
    if len(shown.sizes) and arguments.cut is None and arguments.maps is None:
        problem.copies = shown.sizes
    radius = arguments.spacing / 2
    alignment = given.alignment = terms.alignment_of(arguments)
    if arguments.direction_angle is not None:
        alignment = given.alignment = replace(
            alignment,
            angle_source=angle_source_of(arguments.direction_angle, surface_object, depsgraph),
            angle_name=arguments.direction_angle,
            angle_uv_map=arguments.uv_map or "",
        )
    problem.density = density_of(choice, surface_object, depsgraph, radius)
    problem.directions = directions_of(alignment, surface_object, depsgraph, radius)
    if arguments.seed_object is not None:
        seed_object = _curve_object(arguments, "seed_object")
        given.fixed_ends = fixed_ends
        seed = strands_of_curve(seed_object, depsgraph, fixed_ends)
        given.parts.append(part_of(seed_object, seed))
    if arguments.guides_object is not None:
        guides_object = _curve_object(arguments, "guides_object")
        guides = strands_of_curve(guides_object, depsgraph, branches=True)
        given.parts.append(part_of(guides_object, guides, guide=True))
    if bpy.app.autoexec_fail:  # known once the scene was evaluated
        given.warnings.append(_not_run(arguments))
    return given


def _not_run(arguments: argparse.Namespace) -> str:
    """What is said of Python in the file that was kept from running."""
    what = " ".join(bpy.app.autoexec_fail_message.split())
    return (
        f"{arguments.input} holds Python that was not run ({what}), so the scene may look "
        "different; if you trust the file, --run-scripts runs it"
    )


def _curve_object(arguments: argparse.Namespace, option: str) -> bpy.types.Object:
    """The object that --seed-object or --guides-object names."""
    name = getattr(arguments, option)
    named = bpy.context.scene.objects.get(name)
    if named is None:
        raise BadInput(
            f"{arguments.input} has no object {name!r} in its scene; give the name of a curve "
            f"object to --{option.replace('_', '-')}"
        )
    return named


def _mesh_object(arguments: argparse.Namespace) -> bpy.types.Object:
    """--object, else the active object that can be filled, else the only one."""
    scene_objects = bpy.context.scene.objects
    if arguments.object is not None:
        named = scene_objects.get(arguments.object)
        if named is None:
            raise BadInput(
                f"{arguments.input} has no object {arguments.object!r} in its scene; give the "
                "name of a mesh object to --object"
            )
        return named
    active = bpy.context.view_layer.objects.active
    if has_faces(active):
        return active
    # A mesh before what Blender makes a mesh of.
    found = [item for item in scene_objects if item.type == "MESH" and has_faces(item)]
    found = found or [item for item in scene_objects if has_faces(item)]
    if len(found) == 1:
        return found[0]
    if found:
        raise BadInput(
            f"{arguments.input} has {len(found)} objects to fill, none of it active; name one with "
            "--object"
        )
    reasons = filter(None, map(why_not_this, [active, *scene_objects]))
    raise BadInput(
        f"{arguments.input} has nothing to fill: "
        + next(reasons, "there is no mesh in its scene; name another .blend")
    )


def in_polygons(error: core.MeanderError, surface_object: bpy.types.Object) -> core.MeanderError:
    """The same error, with faces counted as Blender counts them."""
    return renumbered(error, surface_object, bpy.context.evaluated_depsgraph_get())
