# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command, and what can be refused before any file is read."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from .. import core
from ..model.export import SUFFIXES as EXPORTED
from ..model.files.meshes import SUFFIXES as MESHES
from ..model.files.whole import are_one, why_no_file
from ..model.toolpaths.toolpath import SUFFIXES
from . import (
    blender_flags,
    cut,
    density,
    export,
    flags,
    least_bend,
    limits,
    maps,
    mirror,
    motion,
    preparation,
    quality,
    sheets,
    standard,
    strands,
    target_length,
    terms,
    toolpath,
    values,
)
from .place import Place
from .places import asked, target_of
from .values import BadInput, file_name

# What --input may be, by its suffix.
INPUTS = (*MESHES, ".blend")

# What --output may be, by its suffix.
OUTPUTS = (".obj", ".blend", *SUFFIXES, *EXPORTED)

# Options that name what is written; all others that name a file are read.
_WRITTEN = ("output", "report", "cut", "maps")

# The last frame that Blender has; the first is its negative.
_LAST_FRAME = 1048574


def parser(place: Place) -> argparse.ArgumentParser:
    parser = values.Parser(
        prog=place.program,
        description="Grow a curve on a mesh until it fills the surface at an even spacing.",
        epilog=blender_flags.epilog() if place.host is None else None,
        allow_abbrev=False,
    )
    add = parser.add_argument
    _add_files(parser)
    flags.add_flags(parser)
    target_length.add_options(parser)
    limits.add_failing(parser)
    add("--quiet", action="store_true", help="print nothing but errors")
    add("--version", action="version", version=f"Meander {core.VERSION}")
    density.add_options(parser)
    terms.add_options(parser)
    strands.add_options(parser)
    preparation.add_options(parser)
    toolpath.add_options(parser)
    export.add_options(parser)
    motion.add_options(parser)
    cut.add_options(parser)
    maps.add_options(parser)
    limits.add_options(parser)
    return parser


def _add_files(parser: argparse.ArgumentParser) -> None:
    """What is read and written."""
    add = parser.add_argument
    add(
        "--input",
        type=file_name,
        required=True,
        metavar="MESH",
        help=".obj, .ply, .stl or .blend; - reads a mesh from the standard input",
    )
    add("--object", metavar="NAME", help="mesh object in the .blend; default: the active one")
    add(
        "--frame",
        type=values.reader(int, -_LAST_FRAME, _LAST_FRAME),
        metavar="N",
        help="of the .blend; default: the one it was saved in",
    )
    add(
        "--run-scripts",
        action="store_true",
        help="run the Python that the .blend holds: scripts that start when it is opened, and "
        "drivers; without it none is run, whatever Blender's preferences say",
    )
    kinds = ", ".join(OUTPUTS)
    add(
        "--output",
        type=file_name,
        required=True,
        metavar="OUT",
        help=f"one of {kinds}; - writes to the standard output",
    )
    standard.add_options(parser)
    add("--report", type=file_name, metavar="JSON", help="write figures of the run")
    add(
        "--seed",
        type=file_name,
        metavar="CURVE",
        help=".obj with v and l lines, in the mesh's space",
    )
    add(
        "--seed-object",
        metavar="NAME",
        help="curve, text, Grease Pencil or mesh without faces in the .blend; its ends stay put if "
        "the surface's settings say so",
    )


@cache
def read_options() -> tuple[str, ...]:
    """The names, in a namespace, of the options whose files are read, the input first."""
    actions = parser(Place("the batch command", lambda _line: None))._actions
    files = (action.dest for action in actions if action.type is file_name)
    return tuple(name for name in files if name not in _WRITTEN)


def files_read(arguments: argparse.Namespace) -> dict[str, Path]:
    """The files that a run is made from, by the name of the option."""
    given = {name: getattr(arguments, name) for name in read_options()}
    given |= density.images_read(arguments)
    return {name: path for name, path in given.items() if path is not None}


def parsed(argv: Sequence[str], place: Place) -> argparse.Namespace:
    """What the options say, with those that a preset of the panel stands for. Raises BadInput."""
    arguments = parser(place).parse_args(argv)
    quality.expand(arguments)
    return arguments


def check_arguments(arguments: argparse.Namespace, place: Place) -> None:
    """Refuses what can be refused before any file is read."""
    blender_flags.refuse(arguments, place)
    check_options(arguments)
    _check_outputs(arguments)


def check_options(arguments: argparse.Namespace) -> None:
    """Refuses options that do not fit each other or the input, wherever the outputs are to lie."""
    _refuse_blank(arguments)
    wrong = target_length.problem_of(arguments)
    if wrong is not None:
        raise BadInput(wrong)
    kind = arguments.input.suffix.lower()
    if kind not in INPUTS and not asked(Path.is_dir, "--input", arguments.input):
        kinds = ", ".join(INPUTS[:-1])
        raise BadInput(f"--input {arguments.input} is no {kinds} or {INPUTS[-1]} file")
    for name, path in files_read(arguments).items():
        option = f"--{name.replace('_', '-')}"
        fault = asked(why_no_file, option, path)
        if fault:
            raise BadInput(f"{option} {path} {fault}")
    if kind != ".blend":
        for option in ("object", "seed_object", "guides_object"):
            if getattr(arguments, option) is not None:
                name = option.replace("_", "-")
                raise BadInput(f"--{name} names an object of a .blend, but --input is {kind}")
        if arguments.frame is not None:
            raise BadInput(f"--frame is one of a .blend, but --input is {kind}")
        if arguments.run_scripts:
            raise BadInput(f"--run-scripts is for those of a .blend, but --input is {kind}")
    for part in (density, preparation, terms, motion):
        wrong = part.problem_of(arguments, kind)
        if wrong is not None:
            raise BadInput(wrong)
    if arguments.seed is not None and arguments.seed_object is not None:
        raise BadInput("--seed and --seed-object are both given; choose one")
    strand_problem = strands.problem_of(arguments)
    if strand_problem is not None:
        raise BadInput(strand_problem)
    if asked(Path.is_dir, "--output", arguments.output) or not arguments.output.name:
        raise BadInput(f"--output {arguments.output} is a folder; give a file name")
    if arguments.output.suffix.lower() not in OUTPUTS:
        kinds = ", ".join(OUTPUTS[:-1])
        raise BadInput(f"--output {arguments.output} is no {kinds} or {OUTPUTS[-1]} file")
    for output in (toolpath, export, cut, maps, least_bend, mirror):
        wrong = output.problem_of(arguments)
        if wrong is not None:
            raise BadInput(wrong)


def _refuse_blank(arguments: argparse.Namespace) -> None:
    """Refuses names without a letter, as a script passes on for a variable that is not set."""
    for name, value in vars(arguments).items():
        if isinstance(value, str) and not value.strip():
            option = f"--{name.replace('_', '-')}"
            raise BadInput(f"{option} is given without a name; give one, or leave it out")


def _check_outputs(arguments: argparse.Namespace) -> None:
    read = files_read(arguments).items()
    taken = {f"--{name.replace('_', '-')}": path for name, path in read}
    outputs = {f"--{name}": getattr(arguments, name) for name in _WRITTEN}
    for option, path in outputs.items():
        if path is None:
            continue
        target = target_of(option, path)
        for other, other_path in taken.items():
            if option == "--output" and sheets.may_write(arguments, path, other_path):
                raise BadInput(f"--sheet would overwrite {other} {other_path}; choose another name")
            # A scene may be saved over itself: it still holds all that was in it.
            scene = option == "--output" and other == "--input" and path.suffix == ".blend"
            if not scene and are_one(target, other_path):
                raise BadInput(f"{option} would overwrite {other} {path}; choose another name")
        taken[option] = path
