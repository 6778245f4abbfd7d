# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the batch command that say where the strands are closer, as a density or as a
tone; no bpy.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..model.density import (
    CURVATURES,
    FREE,
    INTERPOLATIONS,
    TONE,
    Choice,
    Stops,
    Values,
    mean_at_vertices,
    sample_repeated,
    srgb_luminance,
)
from ..model.files.meshes import SUFFIXES
from ..model.files.vertex_values import COLORS, colors_of, numbers_of, uvs_of
from ..model.files.whole import FileError
from ..model.options.tone import OF_SURFACES
from ..model.picture.image import Image
from ..model.picture.tone import light_of
from . import tone
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
# Of tone: how much a surface bends is no brightness.
_SOURCES_OF_TONE = _SOURCES[:-1]
# The kinds of --input that have such a source, where it is not .blend only.
_OF_FILES = {
    "attribute": (".blend", ".ply"),
    "color": (".blend", ".ply", ".obj", ".stl"),
    "image": (".blend", ".ply", ".obj"),
    "curvature": (".blend", *SUFFIXES),
}
# The options whose value names the file of an image, where the mesh comes from none of Blender's.
IMAGES = ("density_image", "tone_image")
# Options that mean nothing without a source.
_DETAILS = (
    "density_range",
    "density_smoothing",
    "spacing_factors",
    "density_interpolation",
    "density_ramp",
)
# And those that mean nothing without a tone.
_OF_TONE = (*tone.COMMON_NAMES, "pen")
_LEAST_FACTOR, _GREATEST_FACTOR = 0.05, 5.0


def add_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group(
        "density",
        "One source of values; where they are high the spacing is smaller, unless the factors "
        "say otherwise. What is left out is as saved with the .blend's object.",
    )
    _add_sources(group, "density")
    add = group.add_argument
    add("--density-curvature", choices=CURVATURES, help="absolute curvature of the surface")
    add_flags(group, "density")
    add(
        "--uv-map",
        metavar="NAME",
        help="for --density-image, --tone-image, --direction u and images of --direction-angle; "
        "default: active",
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
    group = parser.add_argument_group(
        "tone",
        "Instead of a density: one source of brightness that the line is to have, seen from "
        "afar. The spacing is the width of the line over the darkness.",
    )
    _add_sources(group, "tone")
    tone.add_common(group)
    add_flags(group, "tone", OF_SURFACES)


def _add_sources(group: argparse._ArgumentGroup, what: str) -> None:
    add = group.add_argument
    add(f"--{what}-group", metavar="NAME", help="vertex group of the .blend's object")
    add(
        f"--{what}-attribute",
        metavar="NAME",
        help="attribute of numbers, of points, faces or corners; of a .ply, one of its vertices or "
        "faces",
    )
    add(
        f"--{what}-color",
        metavar="NAME",
        help=f"color attribute: its brightness; of a .ply, .obj or .stl, where colours have no "
        f"name, {COLORS}",
    )
    add(
        f"--{what}-image",
        metavar="NAME",
        help="image in the .blend: its brightness; of a .ply or .obj, a file that lies on its UVs",
    )


def problem_of(arguments: argparse.Namespace, kind: str) -> str | None:
    """One sentence about options that do not fit each other, or the input of suffix `kind`."""
    given = _given(arguments)
    if len(given) > 1:
        names = " and ".join(f"--{option}" for option, _source, _kind in given[:2])
        what = "source of density" if given[1][0].startswith("density") else "source"
        return f"{names} are both given; choose one {what}"
    for option, _source, what in given:
        name = _named(arguments, option)
        plain = option.partition("-")[2]
        if plain == "image" and kind == ".stl":
            return f"--{option} needs UVs, which a .stl file has none of; give a .obj or a .ply"
        if kind not in _OF_FILES.get(plain, (".blend",)):
            return f"unknown {what} {name!r}: a {kind} file has none; give a .blend to --input"
        if plain == "color" and kind != ".blend" and name != COLORS:
            return f"--{option} {name}: the colours of a {kind} file are called {COLORS}"
    of_tone = bool(given) and given[0][0].startswith("tone")
    if not given or of_tone:
        for detail in _DETAILS:
            if getattr(arguments, detail) is not None:
                option = detail.replace("_", "-")
                return f"--{option} needs a source of density; give one such as --density-group"
    if not of_tone:
        for detail in _OF_TONE:
            if getattr(arguments, detail) is not None:
                return f"--{detail} needs a source of tone; give one such as --tone-image"
        if arguments.negative:
            return "--negative needs a source of tone; give one such as --tone-image"
    if arguments.uv_map is not None and kind != ".blend":
        return f"--uv-map {arguments.uv_map} names one of a .blend; a {kind} file has one at most"
    if arguments.uv_map is not None and arguments.density_image is None:
        if (
            arguments.tone_image is None
            and arguments.direction not in ("u", "v")
            and arguments.direction_angle is None
        ):
            return (
                "--uv-map is for --density-image, --tone-image, --direction u or v, and the image "
                "of --direction-angle; give one of them"
            )
    return tone.problem_of(arguments) if of_tone else _problem_of_ramp(arguments)


def _problem_of_ramp(arguments: argparse.Namespace) -> str | None:
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
    """The sources that are given: the option without its dashes, its source, and what it names."""
    options = [(f"density-{name}", source, what) for name, source, what in _SOURCES]
    options += [(f"tone-{name}", source, what) for name, source, what in _SOURCES_OF_TONE]
    return [entry for entry in options if _named(arguments, entry[0]) is not None]


def _named(arguments: argparse.Namespace, option: str) -> str | None:
    return getattr(arguments, option.replace("-", "_"))


def choice_of(arguments: argparse.Namespace, saved: Choice) -> Choice:
    """The density of the command: its source, and for the rest what it says or what is saved.
    Raises FileError for measurements of paper that are none."""
    given = _given(arguments)
    if not given:
        return replace(saved, source="NONE", name="")
    ((option, source, _what),) = given
    changes: dict[str, Any] = {"source": source, "name": _named(arguments, option)}
    if source != saved.source:
        changes["value_range"] = None  # what is saved is in the units of another source
    if arguments.uv_map is not None:
        changes["uv_map"] = arguments.uv_map
    if option.startswith("tone"):
        return replace(saved, **changes, **_as_tone(arguments, saved))
    if saved.interpolation == TONE:
        changes["interpolation"] = Choice.interpolation
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


def _as_tone(arguments: argparse.Namespace, saved: Choice) -> dict[str, Any]:
    """The part of a Choice that makes it a tone."""
    made: dict[str, Any] = {"interpolation": TONE, "tone": tone.tone_of(arguments, saved.tone)}
    if arguments.negative:
        made["tone"] = replace(made["tone"], negative=True)
    if arguments.levels is not None:
        low, high = light_of(np.array(arguments.levels))
        made["value_range"] = (float(low), float(high))
    if arguments.pen is not None:
        spacing = arguments.spacing
        made["line"] = Choice.line if spacing is None else arguments.pen / spacing
    return made


def images_read(arguments: argparse.Namespace) -> dict[str, Path]:
    """The files of images on a mesh that has a file of its own, by the name of the option."""
    if arguments.input.suffix.lower() == ".blend":
        return {}
    given = {name: getattr(arguments, name) for name in IMAGES}
    return {name: Path(image) for name, image in given.items() if image is not None}


def values_of_file(
    choice: Choice, path: Path, count: int, picture: Callable[[Path], Image]
) -> Values | None:
    """The values per vertex of a mesh file from what it says of its surface, as Choice.density()
    takes them; None: this is no source of that kind.

    count     of its vertices
    picture   reads an image

    Raises FileError.
    """
    if choice.source == "COLOR":
        found = colors_of(path)
        values = srgb_luminance(found.values)
    elif choice.source == "ATTRIBUTE":
        found = numbers_of(path, choice.name)
        values = found.values
    elif choice.source == "IMAGE":
        found = uvs_of(path)
        image = picture(Path(choice.name))
        values = sample_repeated(image.colours[::-1], found.values % 1.0, srgb_luminance)
    else:
        return None
    if found.vertices is not None:
        lone = np.bincount(found.vertices, minlength=count) == 0
        values = mean_at_vertices(values, found.vertices, count)
        values[lone] = values[~lone].min()  # which nothing of the surface has
    bad = np.flatnonzero(~np.isfinite(values))
    if len(bad):
        vertex = int(bad[0]) + (path.suffix.lower() == ".obj")  # which counts them from 1
        raise FileError(
            f"'{choice.name}' is not a finite number at vertex {vertex} of {path}; correct its "
            "values"
        )
    return values


def idle_of(choice: Choice, values: Values) -> list[str]:
    """What there is to warn of where values make the spacing the same everywhere."""
    if choice.is_tone:
        return []
    factors = choice.ramp(values).factors(values)
    if float(np.ptp(factors)) > 0.0:
        return []
    low, high = float(values.min()), float(values.max())
    why = f"its values are {low:.4g} everywhere; choose others"
    if low < high:
        why = (
            f"no difference is made between {low:.4g} and {high:.4g}; choose another "
            "--density-range, or other factors"
        )
    return [f"the density makes the spacing {factors[0]:.4g} times as large everywhere: {why}"]


def echo(arguments: argparse.Namespace, choice: Choice) -> dict[str, Any]:
    """The entries of the report about the density and the tone."""
    entries: dict[str, Any] = {
        f"{what}_{option}": getattr(arguments, f"{what}_{option}")
        for what, sources in (("density", _SOURCES), ("tone", _SOURCES_OF_TONE))
        for option, _source, _what in sources
    }
    of_tone = choice.is_tone
    varies = choice.source != "NONE" and not of_tone
    entries["uv_map"] = choice.uv_map or None if choice.source == "IMAGE" else None
    entries["density_range"] = choice.value_range if varies else None
    entries["spacing_factors"] = choice.factors if varies else None
    entries["density_smoothing"] = choice.smoothing if choice.source == "CURVATURE" else None
    entries["density_interpolation"] = choice.interpolation if varies else None
    entries["density_ramp"] = choice.stops if varies and choice.stops else None
    entries["tone"] = choice.tone.kind if of_tone else None
    entries["pen"] = choice.line * arguments.spacing if of_tone else None
    for name in ("darkest", "lightest", "negative"):
        entries[name] = getattr(choice.tone, name) if of_tone else None
    entries["paper"] = list(choice.tone.paper) or None if of_tone else None
    entries["levels"] = arguments.levels
    return entries
