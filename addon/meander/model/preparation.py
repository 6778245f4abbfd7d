# SPDX-License-Identifier: GPL-3.0-or-later
"""How a mesh is prepared: its faults, what is repaired, which part is filled; no bpy."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import core


class Share(float):
    """A size as a share of that of the whole mesh."""


@dataclass(frozen=True)
class Repair:
    """What is done to a mesh with faults, in the copy that is filled.

    strict             it is refused, but for what the others mend; else all that is safe is mended
    cut_non_manifold   edges with more than two faces become boundaries of each; else those faces
                       that continue each other stay joined
    smallest_part      parts of a smaller size, the diagonal of their bounding box, are left out; in
                       world units, or a Share of the size of the mesh; 0: none
    """

    merge_distance: float = 0.0  # world units; 0: none
    drop_degenerate: bool = False
    split_bow_ties: bool = False
    cut_non_manifold: bool = False
    strict: bool = False
    smallest_part: float = 0.0

    def options(
        self,
        vertices: NDArray[np.float64],
        radius: float,
        polygons: NDArray[np.integer] | None = None,
    ) -> core.SurfaceOptions:
        """For the surface; `radius` is half the spacing, in the unit of the vertices.

        polygons   (m,) of which polygon each triangle is a part; None: nobody knows
        """
        return core.SurfaceOptions(
            merge_distance=self.merge_distance,
            drop_degenerate=self.drop_degenerate or not self.strict,
            split_bow_ties=self.split_bow_ties,
            cut_non_manifold=self.cut_non_manifold,
            drop_doubled=self.drop_degenerate or not self.strict,
            polygons=None if polygons is None else polygons.astype(np.uint32),
            make_manifold=not self.strict,
            weld_distance=0.0 if self.strict else seam_width(vertices, radius),
            smallest_part=self.smallest_part
            * (_size(vertices) if isinstance(self.smallest_part, Share) else 1.0),
        )


# An open seam is closed where it is narrower than these shares of the size of the mesh and of half
# the spacing. Both are far below what is seen, and single precision is finer still.
_SEAM_OF_SIZE = 1e-4
_SEAM_OF_RADIUS = 0.02


def seam_width(vertices: NDArray[np.float64], radius: float) -> float:
    """How far apart the two sides of a seam may be to be closed; 0: there is nothing to close."""
    return min(_SEAM_OF_SIZE * _size(vertices), _SEAM_OF_RADIUS * radius)


def _size(vertices: NDArray[np.float64]) -> float:
    """The diagonal of the bounding box of vertices with a place; 0 without any."""
    finite = vertices[np.isfinite(vertices).all(axis=1)]
    return float(np.linalg.norm(np.ptp(finite, axis=0))) if len(finite) else 0.0


@dataclass(frozen=True)
class Mask:
    """Which part of a mesh is filled: as a panel or a command line says it."""

    source: str = "NONE"  # or "MATERIAL", "ATTRIBUTE", "GROUP"
    name: str = ""
    threshold: float = 0.5  # of a vertex group
    inverted: bool = False  # fill the rest instead


# Figures that say that something was wrong and has been mended.
_MENDED = (
    "dropped_faces",
    "split_vertices",
    "cut_edges",
    "welded_edges",
    "split_edges",
    "opened_edges",
)


def mended(figures: Mapping[str, Any], masked: bool) -> int:
    """How many faults were repaired.

    masked   whether a part was filled, whose edge splits vertices that are no faults
    """
    return sum(int(figures[key]) for key in _MENDED if not (masked and key == "split_vertices"))


def _count(number: int, one: str, many: str) -> str:
    return f"{number:,} {one if number == 1 else many}"


def described(
    figures: Mapping[str, Any], loose_edges: int = 0, instances: tuple[int, bool] = (0, False)
) -> str:
    """What was done to a mesh, in words; empty if nothing was.

    figures        of core.Surface.statistics(); with "skipped_outlines", of Surface.outlines()
    loose_edges    of the mesh, in no face
    instances      how many it consists of, and whether it shows some that are no part of it
    """
    figures = dict(figures)
    figures["dropped_faces"] -= figures["doubled_faces"]
    parts = [
        f"{verb} {_count(int(figures[key]), one, many)}"
        for key, verb, one, many in (
            ("turned_faces", "flipped", "face", "faces"),
            ("merged_vertices", "merged", "vertex", "vertices"),
            ("dropped_faces", "dropped", "face without area", "faces without area"),
            ("doubled_faces", "dropped", "doubled face", "doubled faces"),
            ("split_vertices", "split", "vertex", "vertices"),
            ("split_edges", "split", "edge at vertices on it", "edges at vertices on them"),
            ("welded_edges", "closed", "edge of a seam", "edges of seams"),
            ("opened_edges", "cut open", "edge of a one-sided part", "edges of one-sided parts"),
            ("cut_edges", "cut", "edge with more than two faces", "edges with more than two faces"),
            ("masked_faces", "left out", "face", "faces"),
            ("clipped_faces", "clipped", "face", "faces"),
            ("small_parts", "left out", "small part", "small parts"),
            ("unused_vertices", "ignored", "loose vertex", "loose vertices"),
        )
        if figures[key]
    ]
    if figures.get("skipped_outlines"):
        count = _count(int(figures["skipped_outlines"]), "stretch", "stretches")
        parts.append(f"left out {count} of the outline, which had no room")
    if loose_edges:
        parts.append(f"ignored {_count(loose_edges, 'loose edge', 'loose edges')}")
    filled, left_out = instances
    if filled:
        by_itself = ", each by itself" if filled > 1 else ""
        parts.append(f"filled {_count(filled, 'instance', 'instances')}{by_itself}")
    if left_out:
        parts.append("left out instances, which a Realize Instances node would make part of it")
    return ", ".join(parts)


def outlined(
    seed: core.Seed | None,
    surface: core.Surface,
    distance: float,
    spacing: float,
    context: core.Context | None = None,
) -> tuple[core.Seed | None, int]:
    """The seed with outlines along the boundary as guides behind it, and how many had no room.

    distance, spacing   in the surface's units
    context             stops the search where it is cancelled, with a core.MeanderError
    """
    outlines, skipped = surface.outlines(distance, spacing, context)
    count = len(outlines.closed)
    if not count:
        return seed, skipped
    if seed is None:
        return outlines, skipped
    flags = [part.guides for part in (seed, outlines)]
    guides = np.concatenate(
        [np.zeros(len(seed.closed), np.uint8) if flags[0] is None else flags[0], flags[1]]
    )
    moving = np.zeros(len(seed.points), np.uint8) if seed.fixed is None else seed.fixed
    joined = core.Seed(
        points=np.vstack([seed.points, outlines.points]),
        offsets=np.concatenate([seed.offsets, outlines.offsets[1:] + len(seed.points)]).astype(
            np.uint32
        ),
        closed=np.concatenate([seed.closed, outlines.closed]).astype(np.uint8),
        fixed=np.concatenate([moving, np.zeros(len(outlines.points), np.uint8)]),
        guides=guides.astype(np.uint8),
        loops=seed.loops or bool(guides.all()),
        max_distance=seed.max_distance,
    )
    return joined, skipped


# By core.FAULTS: of one, and of several.
_WORDS = {
    "not_finite": ("1 vertex without a position", "{} vertices without a position"),
    "no_area": ("1 face without area", "{} faces without area"),
    "doubled_face": ("1 face that lies on another", "{} faces that lie on others"),
    "crowded_edge": (
        "1 place where more than two faces share an edge",
        "{} places where more than two faces share an edge",
    ),
    "bow_tie": (
        "1 place where parts touch in one point only",
        "{} places where parts touch in one point only",
    ),
    "one_sided": ("only one side, as a Moebius strip has",) * 2,
    "seam": ("1 edge along an open seam", "{} edges along open seams"),
}


def faults_in_words(faults: core.Faults) -> str:
    """How many faults of each kind there are, the gravest first; empty if there are none."""
    counts = np.bincount(faults.kinds, minlength=len(core.FAULTS))
    parts = [
        _WORDS[kind][count > 1].format(f"{count:,}")
        for kind, count in zip(core.FAULTS, counts.tolist(), strict=True)
        if count
    ]
    if len(parts) < 2:
        return "".join(parts)
    return f"{', '.join(parts[:-1])} and {parts[-1]}"


def refusal(name: str, faults: core.Faults, strict: bool) -> str:
    """One sentence about a mesh that cannot be filled, and what to do.

    faults   all of them, at least one
    strict   whether those that are safe to repair were not
    """
    text = f"'{name}' has {faults_in_words(faults)}; press Show Faults to select them"
    if (faults.kinds != core.FAULTS.index("not_finite")).all() and strict:
        return f"{text}, or turn off Strict to have them repaired"
    return f"{text}, and correct them"
