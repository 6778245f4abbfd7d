# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command that say where the strands are closer; no bpy."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..model.density import (
    CURVATURES,
    FREE,
    INTERPOLATIONS,
    Choice,
    Stops,
    Values,
    srgb_luminance,
)
from ..model.files.meshes import SUFFIXES
from ..model.files.vertex_values import COLORS, vertex_colors, vertex_numbers
from ..model.files.whole import FileError
from .flags import add_flags
from .values import number

# How an option's name ends, its source, and what it names.
_SOURCES = (
    ("group", "GROUP", "vertex group"),
    ("attribute", "ATTRIBUTE", "attribute of numbers"),
    ("color", "COLOR", "color attribute"),
    ("image", "IMAGE", "image"),
    ("curvature", "CURVATURE", "curvature"),
)
# The kinds of --input that have such a source, where it is not .blend only.
_OF_FILES = {
    "attribute": (".blend", ".ply"),
    "color": (".blend", ".ply", ".obj"),
    "curvature": (".blend", *SUFFIXES),
}
# Options that mean nothing without a source.
_DETAILS = (
    "density_range",
    "density_smoothing",
    "spacing_factors",
    "density_interpolation",
    "density_ramp",
)
_LEAST_FACTOR, _GREATEST_FACTOR = 0.05, 5.0


def add_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group(
        "density",
        "One source of values; where they are high the spacing is smaller, unless the factors "
        "say otherwise. What is left out is as saved with the .blend's object.",
    )
    add = group.add_argument
    add("--density-group", metavar="NAME", help="vertex group of the .blend's object")
    add(
        "--density-attribute",
        metavar="NAME",
        help="attribute of numbers, of points, faces or corners; of a .ply, one of its vertices",
    )
    add(
        "--density-color",
        metavar="NAME",
        help=f"color attribute: its brightness; of a .ply or .obj, where colours have no name, "
        f"{COLORS}",
    )
    add("--density-image", metavar="NAME", help="image in the .blend: its brightness")
    add("--density-curvature", choices=CURVATURES, help="absolute curvature of the surface")
    add_flags(group, "density")
    add(
        "--uv-map",
        metavar="NAME",
        help="for --density-image, --direction u and images of --direction-angle; default: active",
    )
    add(
        "--density-range",
        type=number,
        nargs=2,
        metavar=("LOW", "HIGH"),
        help="the values that get the two factors; default: 0 and 1, for attributes the least and "
        "the greatest, for curvature 0 and what 95 %% stay below",
    )
    add(
        "--spacing-factors",
        type=number,
        nargs=2,
        metavar=("LOW", "HIGH"),
        help="what the spacing is multiplied by at both; 0.05 to 5; default: 1 and 0.5",
    )
    add("--density-interpolation", choices=INTERPOLATIONS, help="default: linear")
    add(
        "--density-ramp",
        metavar="STOPS",
        help="instead of both: factors at places in the range, from 0 at LOW to 1 at HIGH, such as "
        "0:0.5,0.4:1,1:2; straight in between",
    )


def problem_of(arguments: argparse.Namespace, kind: str) -> str | None:
    """One sentence about options that do not fit each other, or the input of suffix `kind`."""
    given = _given(arguments)
    if len(given) > 1:
        names = " and ".join(f"--density-{option}" for option, _source, _kind in given[:2])
        return f"{names} are both given; choose one source of density"
    for option, _source, what in given:
        if kind not in _OF_FILES.get(option, (".blend",)):
            name = getattr(arguments, f"density_{option}")
            return f"unknown {what} {name!r}: a {kind} file has none; give a .blend to --input"
        name = getattr(arguments, f"density_{option}")
        if option == "color" and kind != ".blend" and name != COLORS:
            return f"--density-color {name}: the colours of a {kind} file are called {COLORS}"
    if not given:
        for detail in _DETAILS:
            if getattr(arguments, detail) is not None:
                option = detail.replace("_", "-")
                return f"--{option} needs a source of density; give one such as --density-group"
    if arguments.uv_map is not None and arguments.density_image is None:
        if arguments.direction not in ("u", "v") and arguments.direction_angle is None:
            return (
                "--uv-map is for --density-image, --direction u or v, and the image of "
                "--direction-angle; give one of them"
            )
    if arguments.density_smoothing is not None:
        if arguments.density_curvature is None:
            return "--density-smoothing is for --density-curvature; give both or none"
    for factor in arguments.spacing_factors or ():
        if not _LEAST_FACTOR <= factor <= _GREATEST_FACTOR:
            return (
                f"--spacing-factors {factor:g} is out of range; choose from {_LEAST_FACTOR:g} to "
                f"{_GREATEST_FACTOR:g}"
            )
    if arguments.density_ramp is None:
        return None
    for detail in ("spacing_factors", "density_interpolation"):
        if getattr(arguments, detail) is not None:
            return f"--density-ramp and --{detail.replace('_', '-')} are both given; choose one"
    stops = _read_stops(arguments.density_ramp)
    return f"--density-ramp {arguments.density_ramp}: {stops}" if isinstance(stops, str) else None


def _read_stops(text: str) -> Stops | str:
    """Places and factors of --density-ramp, or what is wrong with them."""
    stops = []
    for part in text.split(","):
        try:
            place, factor = (float(number) for number in part.split(":"))
        except ValueError:
            return f"{part.strip()!r} is no stop; write PLACE:FACTOR, such as 0.4:1"
        if not 0.0 <= place <= 1.0:
            return f"the place {place:g} is out of range; choose from 0 to 1"
        if not _LEAST_FACTOR <= factor <= _GREATEST_FACTOR:
            return (
                f"the factor {factor:g} is out of range; choose from {_LEAST_FACTOR:g} to "
                f"{_GREATEST_FACTOR:g}"
            )
        if stops and place <= stops[-1][0]:
            return (
                f"the place {place:g} does not come after {stops[-1][0]:g}; put the stops in order"
            )
        stops.append((place, factor))
    if len(stops) < 2:
        return "one stop makes no ramp; give two or more"
    return tuple(stops)


def _free_ramp(stops: Stops) -> dict[str, Any]:
    """The part of a Choice for factors at places: least and greatest, and the shape in between."""
    least, greatest = min(factor for _, factor in stops), max(factor for _, factor in stops)
    span = (greatest - least) or 1.0
    shape = tuple((place, (factor - least) / span) for place, factor in stops)
    return {"factors": (least, greatest), "interpolation": FREE, "stops": shape}


def _given(arguments: argparse.Namespace) -> list[tuple[str, str, str]]:
    return [entry for entry in _SOURCES if getattr(arguments, f"density_{entry[0]}") is not None]


def choice_of(arguments: argparse.Namespace, saved: Choice) -> Choice:
    """The density of the command: its source, and for the rest what it says or what is saved."""
    given = _given(arguments)
    if not given:
        return replace(saved, source="NONE", name="")
    ((option, source, _what),) = given
    changes: dict[str, Any] = {"source": source, "name": getattr(arguments, f"density_{option}")}
    if source != saved.source:
        changes["value_range"] = None  # what is saved is in the units of another source
    if arguments.uv_map is not None:
        changes["uv_map"] = arguments.uv_map
    if arguments.density_smoothing is not None:
        changes["smoothing"] = arguments.density_smoothing
    if arguments.density_range is not None:
        changes["value_range"] = tuple(arguments.density_range)
    if arguments.spacing_factors is not None:
        changes["factors"] = tuple(arguments.spacing_factors)
    if arguments.density_interpolation is not None:
        changes["interpolation"] = arguments.density_interpolation
        changes["stops"] = ()
    if arguments.density_ramp is not None:
        changes.update(_free_ramp(_read_stops(arguments.density_ramp)))
    return replace(saved, **changes)


def of_file(choice: Choice, path: Path) -> Values | None:
    """The density per vertex of a mesh file from what it says of its vertices; None: this is no
    source of that kind. Raises FileError."""
    if choice.source == "COLOR":
        values = srgb_luminance(vertex_colors(path))
    elif choice.source == "ATTRIBUTE":
        values = vertex_numbers(path, choice.name)
    else:
        return None
    bad = np.flatnonzero(~np.isfinite(values))
    if len(bad):
        raise FileError(
            f"'{choice.name}' is not a finite number at vertex {int(bad[0])} of {path}; correct "
            "its values"
        )
    return choice.ramp(values).density(values)


def echo(arguments: argparse.Namespace, choice: Choice) -> dict[str, Any]:
    """The entries of the report about the density."""
    entries: dict[str, Any] = {
        f"density_{option}": getattr(arguments, f"density_{option}")
        for option, _source, _what in _SOURCES
    }
    varies = choice.source != "NONE"
    entries["uv_map"] = choice.uv_map or None if choice.source == "IMAGE" else None
    entries["density_range"] = choice.value_range if varies else None
    entries["spacing_factors"] = choice.factors if varies else None
    entries["density_smoothing"] = choice.smoothing if choice.source == "CURVATURE" else None
    entries["density_interpolation"] = choice.interpolation if varies else None
    entries["density_ramp"] = choice.stops if varies and choice.stops else None
    return entries
