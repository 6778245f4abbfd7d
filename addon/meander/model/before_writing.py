# SPDX-License-Identifier: GPL-3.0-or-later
"""What there is to say of a drawing before it is written: how large it is, which layout suits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .export import Format
from .geometry import surface_crossings
from .options.option import Values
from .toolpaths.drawing import VIEWS, Drawing
from .toolpaths.toolpath import Strand

# No plotter, laser or mill is wider, in millimetres.
_WIDEST = 10_000.0


# From above, a surface is seen that turns less of its area away, and not mostly edge on.
_HIDDEN, _UPRIGHT = 0.01, 0.1

# Machines count in hundredths of a millimetre: a drawing this small, in millimetres, is a point.
_LEAST = 0.01


# A drawing is seen edge on where it is this much narrower than wide, though the line in it is so
# many times as long.
_EDGE = 1e-4


_FOLDED = 3.0


@dataclass(frozen=True)
class Unusable:
    """Why no machine could take a drawing.

    what   as the middle of a sentence
    edge   whether it is seen edge on, and not too large
    """

    what: str
    edge: bool


def unusable(drawing: Drawing, kind: Format, values: Values) -> Unusable | None:
    """Whether a drawing is larger than any machine, or smaller than a step of one, or a surface
    that is seen edge on, and is not to be written anyway. Only of formats of machines."""
    if "force" not in kind.options or values["force"]:
        return None
    low, high = drawing.box()
    sides = (high - low)[:2] if drawing.flat else high - low
    widest = float(sides.max())
    if widest * drawing.millimetres > _WIDEST:
        text = f"would be {widest * drawing.millimetres / 1000.0:,.4g} m wide"
        return Unusable(f"{text}, which no machine can take", False)
    if widest * drawing.millimetres < _LEAST:
        text = f"would be {widest * drawing.millimetres:.2g} mm wide"
        return Unusable(f"{text}, which no machine can draw", False)
    # A straight line is as flat, but no longer than its drawing is wide.
    if drawing.flat and sides.min() < _EDGE * widest and drawing.length > _FOLDED * widest:
        size = " x ".join(f"{side:.4g}" for side in sides)
        return Unusable(f"is seen edge on: {size} {drawing.unit}", True)
    return None


def size_on_page(sides: ArrayLike, page: ArrayLike, margin: float) -> float:
    """The longest side of a drawing that fills a page, lying or standing, but for its margins.

    sides, page   width and height, in any order; all lengths in one unit
    """
    short, long = np.sort(np.asarray(sides, float))
    narrow, wide = np.sort(np.asarray(page, float)) - 2.0 * margin
    return float(min(wide, narrow * long / short if short > 0.0 else wide))


def better_layout(strands: Sequence[Strand]) -> str:
    """The layout of drawing.VIEWS in which strands in space have the largest area."""
    points = np.concatenate([strand.points for strand in strands])

    def area(layout: str) -> float:
        return float(np.prod(np.ptp(points @ np.transpose(VIEWS[layout]), axis=0)))

    return max(VIEWS, key=area)


def layout_by_shape(
    vertices: NDArray[np.float64],
    faces: NDArray[np.integer],
    strands: Sequence[Strand],
    has_map: bool,
) -> str:
    """How to lay a curve flat where nobody says: seen from above if the surface shows all of itself
    there, else unrolled by its UV map, and without one from where it is widest.

    strands   in space
    """
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    up, down = normals[:, 2].clip(min=0.0).sum(), -normals[:, 2].clip(max=0.0).sum()
    upright = up + down < _UPRIGHT * np.linalg.norm(normals, axis=1).sum()
    if not upright and min(up, down) <= _HIDDEN * (up + down):
        return "top"
    if has_map:
        return "uv"
    return better_layout(strands) if upright else "top"


@dataclass(frozen=True)
class Line:
    """The line of all its points that a drawing shows.

    in_space   its strands on the surface
    laid       the same as they are laid, before points are chosen
    spacing    the least one
    """

    in_space: Sequence[Strand]
    laid: Sequence[Strand]
    spacing: float

    def crosses_on_surface(self) -> bool:
        """As guides and bridges may."""
        of_each = ((each.points, each.normals, each.closed) for each in self.in_space)
        ways, normals, closed = zip(*of_each, strict=True)
        return len(surface_crossings.crossings(ways, normals, closed, self.spacing)) > 0

    def crosses_as_laid(self) -> bool:
        return len(Drawing(list(self.laid), "mm", True).crossings()) > 0


def crossing_warning(
    drawing: Drawing, kind: Format, values: Values, line: Line | None = None
) -> str:
    """What to say of a flat drawing that crosses itself, and what to do; else nothing.

    line   what it shows; None: that is not known
    """
    places = drawing.crossings()
    if not len(places):
        return ""
    where = " ".join(f"{value:.4g}" for value in places[0])
    many = "at 1 place" if len(places) == 1 else f"at {len(places):,} places, the first of them"
    if values["layout_as"] == "uv":
        what = "its UV map has parts on top of each other; pack the islands of the map"
    elif line is not None and line.crosses_on_surface():
        what = "guides and bridges cross there; give guides that do not, or leave them out"
    elif not values["visible_only"] and (line is None or line.crosses_as_laid()):
        what = (
            "one layer of the surface lies before another; leave out what is hidden by Visible "
            "Only (--visible-only)"
        )
    elif kind.name in ("DST", "PES"):
        what = "stitches cut corners; choose a smaller stitch tolerance"
    elif values["arc_tolerance"] > 0.0:
        what = "arcs lie too far beside the line; choose a smaller tolerance of the arcs"
    else:
        what = "its points are too far apart; choose a smaller tolerance or step"
    return f"the drawing crosses itself {many} at {where} {drawing.unit}: {what}"
