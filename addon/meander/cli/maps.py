# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command that write the curve as images by a UV map."""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from .. import core
from ..model import image_files, maps
from .input import Input
from .place import Place
from .values import BadInput, file_name, one_of_several, reader

_DEFAULT = maps.Style()
# A line of progress after so long at most.
_PROGRESS_SECONDS = 2.0


def add_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group(
        "maps", "The curve as images by a UV map of the surface: PNG of 16 bits a channel, or EXR."
    )
    add = group.add_argument
    add(
        "--maps",
        type=file_name,
        metavar="OUT.(png|exr)",
        help="also write them: OUT_mask.png and so on, with UDIM numbers for several tiles",
    )
    add(
        "--map-kinds",
        type=one_of_several(maps.KINDS),
        metavar="LIST",
        help=f"some of {','.join(maps.KINDS)}; default: all of them",
    )
    least, most = maps.SIZES
    add("--map-size", type=reader(int, least, most), metavar="N", help="pixels; default: 2048")
    add(
        "--map-margin",
        type=reader(int, 0, most),
        metavar="N",
        help="pixels that islands go on beyond their edges; default: 16",
    )
    add("--map-uv", metavar="NAME", help="the UV map; default: the active one")


def problem_of(arguments: argparse.Namespace) -> str | None:
    """What is wrong with the options, as a sentence, or None."""
    if arguments.maps is None:
        for option in ("map_kinds", "map_size", "map_margin", "map_uv"):
            if getattr(arguments, option) is not None:
                return f"--{option.replace('_', '-')} needs --maps FILE"
        return None
    if arguments.maps.suffix.lower() not in maps.SUFFIXES:
        return f"--maps {arguments.maps} is no {' or '.join(maps.SUFFIXES)} file"
    if arguments.input.suffix.lower() != ".blend":
        return "--maps needs a UV map; give a .blend as --input"
    return None


def echo(arguments: argparse.Namespace) -> dict[str, Any]:
    """What is in effect, for the report."""
    if arguments.maps is None:
        return {"maps": None}
    style = _style(arguments)
    return {
        "maps": str(arguments.maps),
        "map_kinds": list(arguments.map_kinds or maps.KINDS),
        "map_size": style.size,
        "map_margin": style.margin,
        "map_uv": arguments.map_uv,
    }


def refuse_inputs(arguments: argparse.Namespace, given: Input, place: Place) -> None:
    """Raises BadInput where an image would be written over one that the run is made from, before
    anything grows. Those that only materials show may be written again."""
    if arguments.maps is None:
        return
    of_density, of_angle = given.density_choice, given.alignment
    names = [of_density.name] * (of_density.source == "IMAGE")
    names += [of_angle.angle_name] * (of_angle.angle_source == "IMAGE")
    for name in names:
        path = place.blender("--maps").image_file(name)
        if path is not None and image_files.is_of(arguments.maps, path):
            raise BadInput(
                f"--maps {arguments.maps} would overwrite {path}, from which this run is made; "
                "choose another name"
            )


def images_of(
    flow: core.Flow, arguments: argparse.Namespace, given: Input, place: Place
) -> dict[Path, bytes]:
    """The images of a run that has ended, by their paths; none where none are wanted.

    Raises BadInput for a UV map that is not there or cannot be drawn on, and core.MeanderError.
    """
    if arguments.maps is None:
        return {}
    corners = place.blender("--maps").map_corners(given, arguments.map_uv or "")
    detail = maps.DETAIL * arguments.spacing
    cut = core.cut_surface(flow, detail, True)
    mapped = maps.Mapped.of(cut, corners, arguments.spacing)
    try:
        kinds, style = arguments.map_kinds or maps.KINDS, _style(arguments)
        images, overlap = image_files.images(
            mapped, arguments.maps, kinds, style, progress=_saying(place)
        )
    except maps.NoPlace as problem:
        raise BadInput(f"--maps is not possible here: the UV map {problem}") from problem
    warning = image_files.overlap_warning(overlap)
    if warning:
        place.warn(warning)
    return images


def _saying(place: Place) -> Callable[[float], None]:
    """Says how far images are, where they take long."""
    said = time.monotonic()

    def say(share: float) -> None:
        nonlocal said
        if time.monotonic() - said > _PROGRESS_SECONDS:
            said = time.monotonic()
            place.say(f"meander: images {100.0 * share:.0f} %")

    return say


def _style(arguments: argparse.Namespace) -> maps.Style:
    size, margin = arguments.map_size, arguments.map_margin
    return maps.Style(
        size=_DEFAULT.size if size is None else size,
        margin=_DEFAULT.margin if margin is None else margin,
    )
