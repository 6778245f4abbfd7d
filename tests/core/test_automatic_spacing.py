# SPDX-License-Identifier: GPL-3.0-or-later
"""The spacing where nobody chose one has room in what it is for."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from meander import core
from meander.model.last_run import GAP_THAT_MATTERS

# Cells of a letter's stems, which are two cells wide.
E = [(x, y) for x in range(10) for y in range(16) if x < 2 or y < 2 or y >= 14 or y in (7, 8)]
L = [(x, y) for x in range(9) for y in range(16) if x < 2 or y < 2]
T = [(x, y) for x in range(12) for y in range(16) if x in (5, 6) or y >= 14]


def word(letters: list[list[tuple[int, int]]]) -> geometry.Mesh:
    """Letters beside each other, of squares."""
    numbers: dict[tuple[int, int], int] = {}
    faces = []
    for k, cells in enumerate(letters):
        for x, y in cells:
            corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
            a, b, c, d = (numbers.setdefault((20 * k + i, j), len(numbers)) for i, j in corners)
            faces += [(a, b, c), (a, c, d)]
    return geometry.mesh([(0.1 * i, 0.1 * j, 0.0) for i, j in numbers], faces)


def gaps_of(mesh: geometry.Mesh, start: core.Start = core.Start.GROW) -> int:
    """As Last Run counts them."""
    options = core.default_options("even")
    options.start = start
    with core.Surface(mesh.vertices, mesh.faces) as surface:
        with core.Flow(surface, options) as flow:
            flow.run()
            return int(np.sum(flow.gaps().sizes > GAP_THAT_MATTERS))


@pytest.mark.parametrize("letters", [[L, E, T], [T, E, L, L, E, T, E]], ids=len)
def test_a_word_is_filled_without_gaps(letters: list) -> None:
    assert gaps_of(word(letters)) <= len(letters) // 2


@pytest.mark.parametrize("letter", [E, L, T], ids="ELT")
def test_turns_along_the_boundary_of_a_wide_letter_are_no_gaps(letter: list) -> None:
    """Five to nine of its places in which strands turn are farther than 1.5 r from the line."""
    assert gaps_of(word([letter]), core.Start.FULL) == 0


def test_what_is_no_stem_and_what_only_has_seams_has_a_thirtieth_of_the_root_of_its_area() -> None:
    coarse = geometry.icosphere(0)
    apart = geometry.mesh(
        coarse.vertices[coarse.faces].reshape(-1, 3), np.arange(60).reshape(-1, 3)
    )
    for mesh in (geometry.grid(12), geometry.icosphere(3), apart):
        area = core.area_of(mesh.vertices, mesh.faces)
        spacing = core.automatic_spacing(mesh.vertices, mesh.faces)
        assert spacing == pytest.approx(np.sqrt(area) / 30.0, rel=0.05)


def test_an_area_is_that_of_all_faces_at_once():
    """To the last bit, whatever is measured at a time."""
    vertices, faces = geometry.icosphere(6)
    vertices = vertices * (1.0 + 0.1 * np.sin(7.0 * vertices[:, :1]))
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    doubled = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    assert len(faces) > 50_000
    assert core.area_of(vertices, faces) == doubled.sum() / 2.0
