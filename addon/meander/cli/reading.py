# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what the batch command fills: the file, and what is made of it; no bpy."""

from __future__ import annotations

import argparse

import numpy as np

from ..model import strands
from ..model.density import Choice, curvature_density
from ..model.files import meshes, obj
from ..model.geometry.inside_out import inside_out
from ..model.options.option import OF_PRESET
from ..model.problem import Problem, begin_along_directions
from . import density, mirror, preparation, terms
from . import strands as strand_options
from .input import Input
from .place import Place
from .spacing import settled
from .values import BadInput


def read_input(arguments: argparse.Namespace, place: Place) -> Input:
    """Everything that the options name, read and put together; a spacing that was not given is in
    the arguments then.

    Raises BadInput, files.whole.FileError, core.MeanderError.
    """
    if arguments.input.suffix.lower() == ".blend":
        given = place.blender(arguments.input).read_scene(arguments)
    else:
        mesh = meshes.read(arguments.input)
        options = settled(arguments, mesh.vertices, mesh.faces)
        problem = Problem(mesh.vertices, mesh.faces, options)
        given = Input(problem, mesh_file=mesh, polygons=mesh.polygons)
        given.warnings += mesh.remarks
        mirror.reflect(given.problem, arguments)
    _turn_outward(given, arguments)
    given.repair = preparation.repair_of(arguments)
    problem, options = given.problem, given.problem.options
    if arguments.input.suffix.lower() != ".blend":
        _set_fields(given, arguments, place)
    if given.mask.source == "NONE":
        problem.surface_options = given.repair.options(
            problem.vertices, arguments.spacing / 2, given.polygons
        )
    _put_seed_together(given, arguments)
    problem.alignment = given.alignment.kind
    options.alignment_weight = given.alignment.weight
    if arguments.outline:
        problem.outline = options.boundary_distance * arguments.spacing
    if arguments.start == OF_PRESET:
        begin_along_directions(problem)
    return given


def _turn_outward(given: Input, arguments: argparse.Namespace) -> None:
    """Turns closed bodies that are inside out where that is asked for, and else says that a tool
    would be led into them."""
    away = arguments.standoff or arguments.approach or arguments.layer_offset
    if not (arguments.outward or away):
        return
    problem = given.problem
    inward = inside_out(problem.vertices, problem.faces)
    if arguments.outward:
        problem.faces = np.where(inward[:, None], problem.faces[:, ::-1], problem.faces)
    elif inward.any():
        option = "--layer-offset" if arguments.layer_offset else "--standoff"
        given.warnings.append(
            f"a closed body is inside out, so that {option} leads into it; turn it by --outward"
        )


def _put_seed_together(given: Input, arguments: argparse.Namespace) -> None:
    """Seed, stroke and guides: those of the scene, which are there already, and those of files."""
    if arguments.seed is not None:
        seed = obj.read_obj_curve(arguments.seed)
        given.parts.insert(0, strands.Part(str(arguments.seed), seed))
    given.stroke = strand_options.stroke_of(arguments, given.problem.vertices)
    if isinstance(given.stroke, str):
        raise BadInput(given.stroke)
    if given.stroke is not None:
        given.parts.insert(0, strands.Part("the stroke", strands.stroke(*given.stroke)))
    if arguments.guides is not None:
        guides = obj.read_obj_curve(arguments.guides)
        given.parts.append(strands.Part(str(arguments.guides), guides, guide=True))
    most = strands.max_distance_of(given.problem.vertices)
    given.problem.seed = strands.assembled(given.parts, arguments.fill_every_part, most)


def _set_fields(given: Input, arguments: argparse.Namespace, place: Place) -> None:
    """Density and directions of a mesh from a file of its own: what can be computed on it."""
    problem, radius = given.problem, arguments.spacing / 2
    given.alignment = terms.alignment_of(arguments)
    given.density_choice = density.choice_of(arguments, Choice())
    if given.density_choice.source == "CURVATURE":
        problem.density = curvature_density(given.density_choice, radius)
    else:
        given.values = density.values_of_file(
            given.density_choice, arguments.input, len(problem.vertices), place.picture
        )
        if given.values is not None:
            problem.density = given.density_choice.density(given.values)
            given.warnings += density.idle_of(given.density_choice, given.values)
    problem.directions = terms.directions_without_a_scene(
        given.alignment, problem.vertices, problem.faces, radius
    )
