# SPDX-License-Identifier: GPL-3.0-or-later
"""What of a seed lies on one side of a plane. numpy only, no bpy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .. import core

_Piece = tuple[NDArray[np.float64], NDArray[np.uint8], bool]  # points, fixed, closed


def half_of_seed(
    seed: core.Seed | None,
    heights: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    radius: float,
) -> tuple[core.Seed | None, NDArray[np.int64]]:
    """The seed where `heights` is above 0, and the given strand that each of its strands is of.

    A strand that grows is closed again where one piece of a closed one is left, half a radius from
    the plane; other pieces are open. Guides end at the plane. None where nothing is left.
    """
    sources: list[int] = []
    found: list[_Piece] = []
    guides: list[bool] = []
    if seed is None:
        return None, np.zeros(0, dtype=np.int64)
    fixed = np.zeros(len(seed.points), dtype=np.uint8) if seed.fixed is None else seed.fixed
    for k, (begin, end) in enumerate(zip(seed.offsets[:-1], seed.offsets[1:], strict=True)):
        points = np.asarray(seed.points[begin:end], dtype=np.float64)
        guide = seed.guides is not None and bool(seed.guides[k])
        pieces = _pieces(points, np.asarray(fixed[begin:end]), bool(seed.closed[k]), heights)
        if not guide and len(pieces) == 1 and seed.closed[k] and not pieces[0][2]:
            pieces = [_closed(pieces[0], heights, radius)]
        for piece in pieces:
            sources.append(k)
            found.append(piece)
            guides.append(guide)
    if not found:
        return None, np.zeros(0, dtype=np.int64)
    half = replace(
        seed,
        points=np.vstack([points for points, _fixed, _closed in found]),
        offsets=np.cumsum([0] + [len(points) for points, _f, _c in found]).astype(np.uint32),
        closed=np.array([closed for _points, _fixed, closed in found], dtype=np.uint8),
        fixed=np.concatenate([flags for _points, flags, _closed in found]).astype(np.uint8),
        guides=np.array(guides, dtype=np.uint8),
        loops=seed.loops or all(guides),
    )
    return half, np.array(sources, dtype=np.int64)


def _pieces(
    points: NDArray[np.float64],
    fixed: NDArray[np.uint8],
    closed: bool,
    heights: Callable[[NDArray[np.float64]], NDArray[np.float64]],
) -> list[_Piece]:
    """The pieces of a strand above the plane, with a point in it where they end there."""
    above = heights(points) > 0.0
    if above.all():
        return [(points, fixed, closed)]
    if not above.any():
        return []
    if closed:  # begin where it is below
        first = int(np.argmin(above))
        points, fixed, above = (np.roll(each, -first, axis=0) for each in (points, fixed, above))
        points, fixed = np.vstack([points, points[:1]]), np.concatenate([fixed, fixed[:1]])
        above = np.concatenate([above, above[:1]])
    pieces: list[_Piece] = []
    edges = np.flatnonzero(np.diff(np.concatenate([[0], above.astype(np.int8), [0]])))
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        own, flags = points[begin:end], fixed[begin:end]
        if begin > 0:
            own = np.vstack([_in_plane(points[begin - 1], own[0], heights), own])
            flags = np.concatenate([[0], flags])
        if end < len(points):
            own = np.vstack([own, _in_plane(own[-1], points[end], heights)])
            flags = np.concatenate([flags, [0]])
        pieces.append((own, flags.astype(np.uint8), False))
    return pieces


def _in_plane(
    one: NDArray[np.float64],
    other: NDArray[np.float64],
    heights: Callable[[NDArray[np.float64]], NDArray[np.float64]],
) -> NDArray[np.float64]:
    here, there = heights(np.stack([one, other]))
    return one + here / (here - there) * (other - one)


def _closed(
    piece: _Piece,
    heights: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    radius: float,
) -> _Piece:
    """A piece that begins and ends in the plane as a closed strand beside it; as it is where too
    little of it is left."""
    points, fixed, _is_closed = piece
    away = np.flatnonzero(heights(points) > radius / 2.0)
    if len(away) < 3:
        return piece
    kept = slice(int(away[0]), int(away[-1]) + 1)
    return points[kept], fixed[kept], True
