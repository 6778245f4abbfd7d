# SPDX-License-Identifier: GPL-3.0-or-later
"""Images by maps that stretch, shear and close on themselves, against 64 places a pixel."""

from __future__ import annotations

from typing import NamedTuple

import geometry
import numpy as np
import pytest
from flows import flow_on
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
    vertices, faces = geometry.disc(24, 2.0)
    uv = geometry.grid(24).vertices[faces][:, :, :2]
    return Developable(vertices, faces, vertices[faces][:, :, :2], uv, 0.0)


def pipe() -> Developable:
    """Of radius .5 and length 2, which fills the map: pixels are 1.6 times as wide as high."""
    count, rings = 48, 16
    solid = geometry.tube(count, rings, 2.0, 0.5)
    around = count * np.sin(np.pi / count)
    # Laid flat it has its seam twice; faces are in the same order.
    flat = geometry.rectangle((0.0, 0.0), (around, 2.0), count, rings)
    at = flat.vertices[flat.faces][:, :, :2]
    return Developable(solid.vertices, solid.faces, at, at / [around, 2.0], around)


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
    with flow_on((shape.vertices, shape.faces), radius=SPACING / 2, iteration_limit=120) as flow:
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
