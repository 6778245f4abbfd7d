# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the batch command for repairing the mesh, the part to fill, its boundary; no bpy."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from ..model.preparation import Mask, Repair
from .flags import add_flags

# How an option's name ends, its source, and what it names.
_SOURCES = (
    ("group", "GROUP", "vertex group"),
    ("material", "MATERIAL", "material"),
    ("attribute", "ATTRIBUTE", "face attribute"),
)
_COUNTED = (
    "unused_vertices",
    "merged_vertices",
    "dropped_faces",
    "split_vertices",
    "cut_edges",
    "welded_edges",
    "opened_edges",
    "doubled_faces",
    "split_edges",
    "small_parts",
    "masked_faces",
    "clipped_faces",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    mask = parser.add_argument_group(
        "part to fill", "One mask of the .blend's object, and the boundary."
    )
    mask.add_argument("--mask-group", metavar="NAME", help="vertex group: where it is high enough")
    mask.add_argument("--mask-material", metavar="NAME", help="the faces with this material")
    mask.add_argument(
        "--mask-attribute", metavar="NAME", help="boolean or integer attribute of faces"
    )
    add_flags(mask, "part to fill")
    repair = parser.add_argument_group(
        "mesh repair",
        "Faults that are safe to repair are repaired in a copy; the report counts what was done.",
    )
    add_flags(repair, "mesh repair")


def _given(arguments: argparse.Namespace) -> list[tuple[str, str, str]]:
    return [entry for entry in _SOURCES if getattr(arguments, f"mask_{entry[0]}") is not None]


def problem_of(arguments: argparse.Namespace, kind: str) -> str | None:
    """One sentence about options that do not fit each other, or the input of suffix `kind`."""
    given = _given(arguments)
    if len(given) > 1:
        names = " and ".join(f"--mask-{option}" for option, _source, _what in given[:2])
        return f"{names} are both given; choose one mask"
    for option, _source, what in given:
        if kind != ".blend":
            name = getattr(arguments, f"mask_{option}")
            return f"unknown {what} {name!r}: a {kind} file has none; give a .blend to --input"
    if arguments.mask_threshold is not None and arguments.mask_group is None:
        return "--mask-threshold is for --mask-group; give both or none"
    if arguments.mask_invert and not given:
        return "--mask-invert needs a mask; give one such as --mask-group"
    if arguments.outline and arguments.boundary_distance is not None:
        if arguments.boundary_distance < 0.1:
            return "--outline needs a --boundary-distance of at least 0.1; choose a larger one"
    return None


def repair_of(arguments: argparse.Namespace) -> Repair:
    return Repair(
        arguments.merge_distance or 0.0,
        arguments.drop_degenerate,
        arguments.split_bow_ties,
        arguments.cut_non_manifold,
        arguments.strict,
        arguments.smallest_part or 0.0,
    )


def mask_of(arguments: argparse.Namespace) -> Mask:
    for option, source, _what in _given(arguments):
        threshold = 0.5 if arguments.mask_threshold is None else arguments.mask_threshold
        name = getattr(arguments, f"mask_{option}")
        return Mask(source, name, threshold, arguments.mask_invert)
    return Mask()


def echo(repair: Repair, mask: Mask) -> dict[str, Any]:
    """The entries of the report about these options."""
    entries: dict[str, Any] = dict(asdict(repair))
    for option, source, _what in _SOURCES:
        entries[f"mask_{option}"] = mask.name if mask.source == source else None
    entries["mask_threshold"] = mask.threshold if mask.source == "GROUP" else None
    entries["mask_invert"] = mask.inverted
    return entries


def counts(figures: Mapping[str, Any], loose_edges: int) -> dict[str, int]:
    """What was done to the mesh, for the report's "preparation"."""
    return {key: int(figures[key]) for key in _COUNTED} | {
        "loose_edges": loose_edges,
        "skipped_outlines": int(figures.get("skipped_outlines", 0)),
    }
