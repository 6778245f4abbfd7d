# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of a field turned in the surface, against rotations worked out by hand."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from meander import core


def assert_lines(found: np.ndarray, wanted: np.ndarray, within: float) -> None:
    assert np.linalg.norm(found, axis=1) == pytest.approx(1.0, abs=1e-12)
    wanted = wanted / np.linalg.norm(wanted, axis=1)[:, None]
    assert np.abs((found * wanted).sum(axis=1)).min() > np.cos(within)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_on_a_plane_in_any_position(scale: float) -> None:
    vertices, faces = geometry.grid(7)
    turn, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    turn *= np.linalg.det(turn)  # no mirror
    angles = np.random.default_rng(4).uniform(-7.0, 7.0, len(vertices))
    with core.Surface(scale * (vertices @ turn.T), faces) as surface:
        lines = np.tile(5.0 * turn[:, 0] + 3.0 * turn[:, 2], (len(vertices), 1))  # not in the plane
        found = surface.turned_directions(lines, angles)
    normal = np.sign(np.cross(vertices[faces[0, 1]] - vertices[faces[0, 0]],
                              vertices[faces[0, 2]] - vertices[faces[0, 0]])[2])  # fmt: skip
    wanted = np.column_stack([np.cos(angles), normal * np.sin(angles), 0 * angles]) @ turn.T
    assert_lines(found, wanted, 1e-6)


def test_on_a_ball_about_its_normals_also_where_a_file_has_turned_faces() -> None:
    vertices, faces = geometry.icosphere(3)
    normals = vertices / np.linalg.norm(vertices, axis=1)[:, None]
    lines = np.tile([0.0, 0.0, 1.0], (len(vertices), 1))
    angles = np.linspace(0.0, 3.0, len(vertices))
    tangents = lines - (lines * normals).sum(axis=1)[:, None] * normals
    wanted = (
        np.cos(angles)[:, None] * tangents + np.sin(angles)[:, None] * np.cross(normals, tangents)
    )
    away = np.linalg.norm(tangents, axis=1) > 0.2
    mixed = faces.copy()
    mixed[1::3] = mixed[1::3, ::-1]
    for given in (faces, mixed):
        with core.Surface(vertices, given) as surface:
            found = surface.turned_directions(lines, angles)
        assert_lines(found[away], wanted[away], 0.02)


def test_nothing_stays_nothing_and_half_a_turn_is_none() -> None:
    vertices, faces = geometry.grid(4)
    lines = np.zeros_like(vertices)
    lines[::2, 0] = 1.0
    with core.Surface(vertices, faces) as surface:
        found = surface.turned_directions(lines, np.full(len(vertices), np.pi))
    assert (found[1::2] == 0.0).all()
    assert_lines(found[::2], lines[::2], 1e-6)


@pytest.mark.parametrize(
    ("line", "angle", "words"),
    [
        (1.0, np.nan, "angle of vertex 3 is nan"),
        (1.0, np.inf, "angle of vertex 3 is inf"),
        (np.inf, 1.0, "direction of vertex 3 is not finite"),
    ],
)
def test_what_cannot_be_turned_is_refused(line: float, angle: float, words: str) -> None:
    vertices, faces = geometry.grid(4)
    lines, angles = np.ones_like(vertices), np.ones(len(vertices))
    lines[3, 1], angles[3] = line, angle
    with core.Surface(vertices, faces) as surface:
        with pytest.raises(core.MeanderError, match=words):
            surface.turned_directions(lines, angles)
        with pytest.raises(core.MeanderError, match="24 angles for 25 directions"):
            surface.turned_directions(lines, angles[1:])
        with pytest.raises(core.MeanderError, match="one for each of the 25"):
            surface.turned_directions(lines[:4], np.ones(4))
