# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts whose borders nearly meet: the sentence about them names the distance that joins them."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import options_of
from meander import batch, core
from meander.model.joining import joining_of
from meander.model.preparation import Repair
from meander.model.problem import Problem

SPACING = 0.15

CASES: list[Callable[[], geometry.Mesh]] = []  # all of them one surface but for what is too small


def case(make: Callable[[], geometry.Mesh]) -> Callable[[], geometry.Mesh]:
    CASES.append(make)
    return make


def plate(low: tuple, high: tuple, across: int, up: int) -> geometry.Mesh:
    mesh = geometry.grid(across, up)
    places = mesh.vertices - mesh.vertices.min(axis=0)
    size = np.array([high[0] - low[0], high[1] - low[1], 1.0])
    flat = np.array([*low, 0.0]) + places / np.maximum(np.ptp(places, axis=0), 1e-9) * size
    return geometry.mesh(flat * [1, 1, 0], mesh.faces)


def soup(mesh: geometry.Mesh, gap: float, seed: int = 0) -> geometry.Mesh:
    """Every face on corners of its own, which are at most a gap from where they belong."""
    generator = np.random.default_rng(seed)
    places = np.asarray(mesh.vertices)[np.asarray(mesh.faces).ravel().astype(int)]
    off = generator.uniform(-1.0, 1.0, places.shape) * gap / (2.0 * np.sqrt(3.0))
    return geometry.mesh(places + off, np.arange(len(places)).reshape(-1, 3))


def beside(*meshes: geometry.Mesh) -> geometry.Mesh:
    count, faces = 0, []
    for mesh in meshes:
        faces.append(np.asarray(mesh.faces, dtype=np.int64) + count)
        count += len(mesh.vertices)
    return geometry.mesh(np.vstack([mesh.vertices for mesh in meshes]), np.vstack(faces))


@case
def a_plate() -> geometry.Mesh:
    return soup(plate((0, 0), (1, 1), 8, 8), 0.001)


@case
def a_plate_less_far_off() -> geometry.Mesh:
    return soup(plate((0, 0), (1, 1), 8, 8), 0.0004)


@case
def a_long_plate() -> geometry.Mesh:
    return soup(plate((0, 0), (3, 0.6), 20, 4), 0.0014)


@case
def a_ball() -> geometry.Mesh:
    return soup(geometry.icosphere(2), 0.001)


@case
def a_finer_ball() -> geometry.Mesh:
    return soup(geometry.icosphere(3), 0.0014, 3)


@case
def a_cube() -> geometry.Mesh:
    return soup(geometry.cube(), 0.0012)


@case
def tiles() -> geometry.Mesh:
    """Whole plates with gaps between them."""
    gap = 0.0008
    return beside(
        *(
            plate((x, y), (x + 0.5 - gap, y + 0.5 - gap), 3, 3)
            for x in (0.0, 0.5, 1.0)
            for y in (0.0, 0.5)
        )
    )


@case
def two_halves() -> geometry.Mesh:
    return beside(plate((0, 0), (1, 1), 5, 5), plate((1.001, 0), (2, 1), 5, 5))


@case
def strips() -> geometry.Mesh:
    return beside(*(plate((0.2 * k, 0), (0.2 * k + 0.1991, 1), 1, 4) for k in range(7)))


@case
def a_hill() -> geometry.Mesh:
    flat = plate((0, 0), (1, 1), 10, 10)
    x, y, _ = flat.vertices.T
    hill = np.stack([x, y, 0.2 * np.sin(4 * x) * np.cos(3 * y)], axis=1)
    return soup(geometry.mesh(hill, flat.faces), 0.001, 7)


def problem_of(mesh: geometry.Mesh, scale: float = 1.0, merge: float = 0.0) -> Problem:
    vertices = np.asarray(mesh.vertices, dtype=np.float64) * scale
    options = options_of(radius=0.5 * SPACING * scale)
    prepared = Repair(merge_distance=merge).options(vertices, options.radius)
    return Problem(
        vertices, np.asarray(mesh.faces, dtype=np.uint32), options, surface_options=prepared
    )


def figures_of(problem: Problem) -> dict:
    with core.Surface(problem.vertices, problem.faces, problem.surface_options) as surface:
        return surface.statistics()


@pytest.mark.parametrize("make", CASES, ids=lambda make: make.__name__)
@pytest.mark.parametrize("scale", [1.0, 1e3], ids=["as it is", "a thousand times as large"])
def test_the_distance_joins_what_it_says(
    make: Callable[[], geometry.Mesh], scale: float
) -> None:
    mesh = make()
    problem = problem_of(mesh, scale)
    figures = figures_of(problem)
    assert figures["components"] > 1
    found = joining_of(problem, figures)
    assert found is not None and found.parts == 1
    assert found.distance <= 0.0102 * SPACING * scale
    joined = figures_of(problem_of(mesh, scale, found.distance))
    assert joined["components"] == 1
    assert joined["area"] == pytest.approx(figures["area"], rel=0.01)
    # A quarter of it does not.
    assert figures_of(problem_of(mesh, scale, 0.25 * found.distance))["components"] > 1


@pytest.mark.parametrize(
    "mesh",
    [
        beside(plate((0, 0), (1, 1), 5, 5), plate((1.01, 0), (2, 1), 5, 5)),
        beside(geometry.icosphere(2), geometry.mesh(1.001 * geometry.icosphere(2).vertices,
                                                    geometry.icosphere(2).faces)),
        plate((0, 0), (1, 1), 5, 5),
    ],
    ids=["a gap that is seen", "closed shells", "one part"],
)  # fmt: skip
def test_parts_that_are_meant_are_left_alone(mesh: geometry.Mesh) -> None:
    problem = problem_of(mesh)
    assert joining_of(problem, figures_of(problem)) is None


def test_the_command_says_it(tmp_path: Path, capsys) -> None:
    mesh, report = a_plate(), tmp_path / "report.json"
    text = "".join("v {!r} {!r} {!r}\n".format(*place) for place in mesh.vertices.tolist())
    text += "".join("f {} {} {}\n".format(*(face + 1)) for face in np.asarray(mesh.faces))
    (tmp_path / "mesh.obj").write_text(text)
    given = ["--input", tmp_path / "mesh.obj", "--output", tmp_path / "out.obj"]
    given += ["--spacing", SPACING, "--report", report, "--iterations", 2]
    assert batch.main([str(word) for word in given]) == 0
    why = json.loads(report.read_text())["lines"]["why"]
    assert why in capsys.readouterr().out
    named = re.fullmatch(r"the mesh has .*, which --merge-distance (\S+) would make one", why)
    given += ["--merge-distance", named[1]]
    assert batch.main([str(word) for word in given]) == 0
    assert json.loads(report.read_text())["lines"] | {"closed": 0} == {
        "parts": 1, "small_parts": 0, "count": 1, "closed": 0, "why": None,
    }  # fmt: skip


@pytest.mark.parametrize(("lift", "on"), [(0.0, True), (0.0005, True), (0.1, False)])
def test_a_decal_is_said_to_lie_on_its_wall(tmp_path: Path, lift: float, on: bool) -> None:
    """With faces of its own, in the plane of the wall, just above it, and well above it."""
    wall, faces = geometry.grid(6)
    other, others = geometry.grid(4, 0.5)
    vertices = np.vstack([wall, np.asarray(other) + [0.25, 0.25, lift]])
    mesh = geometry.mesh(vertices, np.vstack([faces, np.asarray(others) + len(wall)]))
    given = ["--input", geometry.write_obj(tmp_path / "decal.obj", mesh), "--spacing", "0.1"]
    files = ["--output", tmp_path / "o.obj", "--report", tmp_path / "r.json", "--quiet"]
    assert batch.main([str(each) for each in (*given, *files)]) == 0
    why = json.loads((tmp_path / "r.json").read_text())["lines"]["why"]
    assert why.startswith("the mesh has 2 parts") and ("1 of them on another" in why) == on
