# SPDX-License-Identifier: GPL-3.0-or-later
"""The outcome of a run of the batch command, as it is written; no bpy."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .. import core
from ..model import strands
from ..model.geometry import thinning
from ..model.geometry.simplification import Light, light_points
from ..model.opening import Opened
from ..model.options.input import light_of
from ..model.problem import Problem
from ..model.toolpaths import bridges, toolpath
from . import flags


@dataclass(frozen=True)
class Grown:
    """The curve, what is known of its points, and which of its strands are guides.

    data      None: what is written says nothing of it
    density   per vertex of the surface; None: 1 everywhere
    cut       of the surface along all of the curve; None: none is wanted
    line      what was joined to one line by bridges; None: nothing
    images    image files of the curve by a UV map, by their paths
    """

    curve: core.Polylines
    data: core.PointData | None
    guides: NDArray[np.bool_]
    density: NDArray[np.float64] | None
    cut: core.CutSurface | None = None
    line: bridges.Joined | None = None
    images: dict[Path, bytes] = field(default_factory=dict)


def grown_of(
    found: core.Findings, opened: Opened, without_guides: bool, with_data: bool = True
) -> Grown:
    """The curve of a run that has ended as it is drawn.

    with_data   with what is known of its points, which takes more memory than they
    """
    curve, data = found.drawn or (found.polylines, found.point_data)
    if not with_data:
        data = None
    guides = found.guides
    if without_guides:
        kept = strands.points_without_guides(curve, guides)
        data = _kept(data, kept)
        curve = strands.without_guides(curve, guides)
        guides = guides[~guides]
    return Grown(curve, data, guides, opened.density)


def _kept(data: core.PointData | None, kept: NDArray[np.integer]) -> core.PointData | None:
    """What is known of some of the points."""
    return None if data is None else core.PointData(*(values[kept] for values in data))


def lightened(grown: Grown, radius: float, light: Light | None) -> Grown:
    """What has grown with the points of a light curve only; None: all of them."""
    if light is None:
        return grown
    spacing = thinning.least_spacing(radius, grown.density)
    kept = light_points(grown.curve, light, spacing)
    data = _kept(grown.data, kept)
    return replace(grown, curve=thinning.with_points(grown.curve, kept), data=data)


def bridged(grown: Grown, problem: Problem) -> Grown:
    """What has grown as one line; what is one line already stays as it is."""
    spacing = thinning.least_spacing(problem.options.radius, grown.density)
    line = bridges.joined(grown.curve, spacing, grown.guides)
    if line is None:
        return grown
    data = grown.data
    if data is not None:
        data = bridges.data_of(line, data, toolpath.Mesh(problem.vertices, problem.faces))
    return replace(grown, curve=line.polylines, data=data, guides=line.guides, line=line)


def written(grown: Grown, arguments: argparse.Namespace, problem: Problem) -> Grown:
    """What has grown as the line that a file has: light, and joined by bridges, where asked for."""
    light = light_of(flags.chosen(arguments))
    grown = lightened(grown, problem.options.radius, light)
    return bridged(grown, problem) if arguments.bridge else grown


def length_of(grown: Grown) -> float:
    """Of all strands, in the units of the mesh."""
    return sum(strand.length for strand in toolpath.strands_of(grown.curve))


def bridge_figures(line: bridges.Joined | None) -> dict[str, float]:
    """The report's "bridges"."""
    lengths = np.zeros(0) if line is None else line.bridge_lengths
    return {"count": len(lengths), "length": float(lengths.sum())}
