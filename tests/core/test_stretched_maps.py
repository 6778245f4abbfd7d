# SPDX-License-Identifier: GPL-3.0-or-later
"""Images by maps that stretch, shear and close on themselves, against 64 places a pixel."""

from __future__ import annotations

from typing import NamedTuple

import geometry
import numpy as np
import pytest
from meander import core
from meander.model.maps import Mapped, Style, Tile

SPACING = 0.1
SIZE = 60
EVERY = 5  # of the pixels that lie in faces


class Developable(NamedTuple):
    """A surface that can be laid flat: where its corners lie then, and in the map.

    around   how far it is round it in the plane; 0: it does not close
    """

    vertices: np.ndarray
    faces: np.ndarray
    flat: np.ndarray
    uv: np.ndarray
    around: float


def disc() -> Developable:
    """Of radius 1, by the map of a square: its rings are the rings of that."""
    vertices, faces = geometry.grid(24)
    square = 2.0 * (vertices - vertices.mean(axis=0)) / np.ptp(vertices, axis=0).max()
    largest = np.abs(square).max(axis=1, keepdims=True)
    away = np.linalg.norm(square, axis=1, keepdims=True)
    round_ = square * largest / np.maximum(away, 1e-9)
    uv = (square[faces][:, :, :2] + 1.0) / 2.0
    return Developable(round_, faces, round_[faces][:, :, :2], uv, 0.0)


def pipe() -> Developable:
    """Of radius .5 and length 2, which fills the map: pixels are 1.6 times as wide as high."""
    count, rings = 48, 17
    column, row = np.meshgrid(np.arange(count + 1), np.arange(rings))
    places = np.column_stack([column.ravel(), row.ravel()]).astype(float)
    a = (np.arange(count) + (count + 1) * np.arange(rings - 1)[:, None]).ravel()
    corners = np.stack([a, a + 1, a + count + 2, a, a + count + 2, a + count + 1], axis=1)
    corners = corners.reshape(-1, 3)
    angle = 2.0 * np.pi * places[:, 0] / count
    height = 2.0 * places[:, 1] / (rings - 1)
    solid = np.column_stack([0.5 * np.cos(angle), 0.5 * np.sin(angle), height])
    side = np.sin(np.pi / count)
    flat = np.column_stack([places[:, 0] * side, height])
    kept = column.ravel() < count
    numbers = np.cumsum(kept) - 1
    first = np.flatnonzero(~kept) - count
    numbers[~kept] = numbers[first]
    uv = flat / [count * side, 2.0]
    return Developable(solid[kept], numbers[corners], flat[corners], uv[corners], count * side)


def means_at(shape: Developable, pieces: np.ndarray, size: int) -> dict[tuple, tuple]:
    """The mean distance and height of 64 places in pixels that lie in faces as a whole."""
    eighth = 8 * size
    corners = shape.uv * eighth - 0.5
    corners[:, :, 1] = eighth - 1 - corners[:, :, 1]
    fine = core.map_pixels(corners, eighth, 0)
    faces = fine.faces.reshape(size, 8, size, 8).swapaxes(1, 2).reshape(size, size, 64)
    weights = fine.weights.reshape(size, 8, size, 8, 3).swapaxes(1, 2).reshape(size, size, 64, 3)
    starts, ends = pieces[:, 0], pieces[:, 1]
    reach = np.linalg.norm(ends - starts, axis=1).max()
    means = {}
    for row, column in np.argwhere((faces >= 0).all(axis=2))[::EVERY]:
        at = shape.flat[faces[row, column]]
        places = np.einsum("nk,nkx->nx", weights[row, column].astype(float), at)
        if shape.around and np.ptp(places[:, 0]) > shape.around / 2.0:
            continue  # on the seam
        middle = places.mean(axis=0)
        away = np.linalg.norm(starts - middle, axis=1)
        wide = np.linalg.norm(places - middle, axis=1).max()
        near = away < away.min() + 2.0 * (wide + reach)
        distance = geometry.distance_to_pieces(places, starts[near], ends[near]) / SPACING
        height = 1.0 - np.clip(1.0 - 2.0 * distance, 0.0, 1.0) ** 2
        means[row, column] = np.clip(distance, 0.0, 1.0).mean(), height.mean()
    return means


@pytest.mark.parametrize("make", [disc, pipe])
def test_pixels_of_a_stretched_map_are_the_mean_over_their_area(make) -> None:
    shape = make()
    options = core.default_options("even")
    options.radius, options.iteration_limit = SPACING / 2, 120
    with core.Flow(core.Surface(shape.vertices, shape.faces), options) as flow:
        flow.run()
        cut = core.cut_surface(flow, SPACING / 8, middle_lines=True)
    tile = Tile(Mapped.of(cut, shape.uv, SPACING), (0, 0), Style(SIZE, 0))
    at = np.einsum("nk,nkx->nx", cut.vertex_weights, shape.flat[cut.vertex_faces])
    pieces = at[cut.line_edges()]
    if shape.around:  # an edge along the seam may be known from its other side
        turns = np.rint(np.diff(pieces[:, :, 0], axis=1)[:, 0] / shape.around)
        pieces[:, 1, 0] -= turns * shape.around
        pieces = np.vstack([pieces + [k * shape.around, 0.0] for k in (-1, 0, 1)])
    means = means_at(shape, pieces, SIZE)
    assert len(means) > 500
    pixels = tuple(np.array(list(means)).T)
    for kind, true in zip(("distance", "height"), np.array(list(means.values())).T, strict=True):
        off = np.abs(tile.values(kind)[pixels] - true)
        assert np.percentile(off, 99) < 0.01, kind
