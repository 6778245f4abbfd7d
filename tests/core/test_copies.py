# SPDX-License-Identifier: GPL-3.0-or-later
"""Copies that are filled each by itself, and those that are alike once."""

from __future__ import annotations

from dataclasses import replace

import geometry
import numpy as np
import pytest
from flows import options_of
from meander import core
from meander.model.copies import Copies, copying
from meander.model.opening import open_flow
from meander.model.problem import Problem
from meander.model.steps import at_once
from meander.model.whole import Whole, whole_of

SPACING = 0.35


def rotation(rng: np.random.Generator) -> np.ndarray:
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    return turn * np.sign(np.linalg.det(turn))


def potato() -> geometry.Mesh:
    """Without any symmetry."""
    ball = geometry.icosphere(2)
    x, y, z = ball.vertices.T
    return geometry.mesh(
        ball.vertices * (1.0 + 0.2 * np.sin(2.0 * x + 1.0) + 0.1 * np.cos(3.0 * y + z))[:, None],
        ball.faces,
    )


def problem_of(bodies: list[geometry.Mesh], spacing: float = SPACING, **more) -> Problem:
    firsts = np.cumsum([0] + [len(body.vertices) for body in bodies])
    options = options_of(radius=spacing / 2.0, iteration_limit=more.pop("iterations", 300))
    return Problem(
        np.vstack([body.vertices for body in bodies]),
        np.vstack([body.faces + first for body, first in zip(bodies, firsts)]).astype(np.uint32),
        options,
        copies=np.array([len(body.vertices) for body in bodies]),
        **more,
    )


def moved(body: geometry.Mesh, turn: np.ndarray, to, size: float = 1.0) -> geometry.Mesh:
    return geometry.mesh(size * body.vertices @ turn.T + np.asarray(to, float), body.faces)


def run(problem: Problem) -> tuple[Copies, core.Polylines, Whole]:
    opened = open_flow(problem)
    with opened.flow as grown:
        grown.run()
        whole = whole_of(opened.part, grown, problem.options)
        with whole.flow as flow:
            curve, data = flow.polylines(), flow.point_data()
            gaps = flow.gaps()
    held = np.einsum("nk,nkj->nj", data.barycentrics, problem.vertices[problem.faces[data.faces]])
    assert np.abs(held - curve.positions).max() < 1e-9 * np.ptp(problem.vertices)
    if len(gaps):
        held_by = geometry.mesh(problem.vertices, problem.faces[gaps.faces])
        off = np.diag(geometry.off_faces(held_by, gaps.positions))
        assert off.max() < 1e-9 * np.ptp(problem.vertices)
    return opened.part, curve, whole


def lines_of(curve: core.Polylines, problem: Problem) -> list[list[np.ndarray]]:
    """The closed lines on each copy, by the faces that hold them."""
    ends = np.cumsum(problem.copies)
    surface = geometry.mesh(problem.vertices, problem.faces)
    found: list[list[np.ndarray]] = [[] for _ in ends]
    offsets = np.asarray(curve.offsets, dtype=int)
    for begin, end in zip(offsets[:-1], offsets[1:]):
        points = curve.positions[begin:end]
        away = [geometry.off_surface(
            geometry.mesh(surface.vertices[e - n : e],
                          surface.faces[(surface.faces[:, 0] >= e - n) & (surface.faces[:, 0] < e)]
                          - (e - n)),
            points[::7]).max() for e, n in zip(ends, problem.copies)]  # fmt: skip
        assert min(away) < 1e-9
        found[int(np.argmin(away))].append(points)
    return found


def length(points: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(np.vstack([points, points[:1]]), axis=0), axis=1).sum())


def test_copies_that_are_alike_have_the_same_line() -> None:
    rng = np.random.default_rng(2)
    turns = [np.eye(3), *(rotation(rng) for _ in range(4))]
    places = [(0, 0, 0), (9, 1, 0), (0, 8, 2), (-7, 3, 3), (40, 50, 60)]
    sizes = [1.0, 1.0, 1.6, 1.0, 1.6]
    bodies = [moved(potato(), *each) for each in zip(turns, places, sizes)]
    problem = problem_of(bodies)
    part, curve, whole = run(problem)
    assert part.once and len(part.problem.vertices) == 2 * len(potato().vertices)
    assert part.alike.sources.tolist() == [0, 0, 2, 0, 2]
    lines = lines_of(curve, problem)
    assert [len(each) for each in lines] == [1] * 5
    # Turned back, those of one size coincide, and the larger ones have another line.
    back = [(each[0] - place) @ turn for each, place, turn in zip(lines, places, turns)]
    for one, other in ((0, 1), (0, 3), (2, 4)):
        assert geometry.farthest(back[one], np.vstack([back[other], back[other][:1]])) < 1e-6
    assert 2.1 < length(back[2]) / length(back[0]) < 3.0, "the spacing is the world's"
    assert whole.figures["length"] == pytest.approx(sum(length(each[0]) for each in lines), 1e-6)
    assert whole.figures["iterations"] > 10
    # What is shown meanwhile is where the copies are, as many lines.
    opened = open_flow(replace(problem, options=replace(problem.options, iteration_limit=3)))
    with opened.flow as grown:
        grown.run()
        assert lines_of(opened.part.shown(grown.polylines()), problem)[3]


def test_what_is_laid_on_all_is_what_has_grown() -> None:
    problem = problem_of([potato(), moved(potato(), np.eye(3), (4, 0, 0))])
    opened = open_flow(problem)
    with opened.flow as grown:
        grown.run()
        shown = opened.part.shown(grown.polylines())
        with whole_of(opened.part, grown, problem.options).flow as flow:
            curve = flow.polylines()
    samples = geometry.samples_of(curve.positions, curve.offsets, curve.closed, SPACING / 200.0)
    assert geometry.distance_to_samples(shown.positions, samples).max() < 0.02 * SPACING


def test_copies_that_touch_are_filled_each_by_itself() -> None:
    """Cubes face to face, of which a mesh of one piece would make one body."""
    cube = geometry.cube()
    side = float(np.ptp(cube.vertices[:, 0]))
    bodies = [moved(cube, np.eye(3), (side * i, side * j, 0.0)) for i in range(3) for j in range(2)]
    problem = problem_of(bodies, side / 5.0)
    part, curve, whole = run(problem)
    assert part.once and len(curve.closed) == 6 and curve.closed.all()
    middles = [curve.positions[begin:end].mean(axis=0)
               for begin, end in zip(curve.offsets[:-1], curve.offsets[1:])]  # fmt: skip
    wanted = np.array([body.vertices.mean(axis=0) for body in bodies])
    assert np.abs(np.array(middles) - wanted).max() < 0.2 * side
    assert whole.figures["length"] == pytest.approx(6 * 6 * side**2 / (side / 5.0), rel=0.15)


def test_mirrored_and_other_copies_have_lines_of_their_own() -> None:
    rng = np.random.default_rng(3)
    mirrored = geometry.mesh(potato().vertices * [-1.0, 1.0, 1.0], potato().faces[:, ::-1])
    bodies = [
        potato(), moved(mirrored, rotation(rng), (5, 0, 0)), moved(potato(), np.eye(3), (0, 5, 0)),
        geometry.mesh(geometry.icosphere(2).vertices + [0, 0, 6], geometry.icosphere(2).faces),
    ]  # fmt: skip
    problem = problem_of(bodies)
    part, curve, _whole = run(problem)
    assert part.alike.sources.tolist() == [0, 1, 0, 3]
    assert [len(each) for each in lines_of(curve, problem)] == [1] * 4


def test_with_a_density_each_is_filled_by_its_own() -> None:
    bodies = [potato(), moved(potato(), np.eye(3), (2.0, 0, 0))]
    problem = problem_of(bodies)
    problem.density = np.where(np.arange(len(problem.vertices)) < len(potato().vertices), 1.0, 4.0)
    part, curve, _whole = run(problem)
    assert not part.once
    first, other = (each[0] for each in lines_of(curve, problem))
    assert 1.7 < length(other) / length(first) < 2.4
    assert part.density_of(problem.density)[1] is problem.density


def test_a_line_goes_on_where_copies_touch() -> None:
    cube = geometry.cube()
    side = float(np.ptp(cube.vertices[:, 0]))
    bodies = [moved(cube, np.eye(3), (side * i, 0.0, 0.0)) for i in range(3)]
    problem = problem_of(bodies, side / 5.0)
    _part, curve, _whole = run(problem)
    seed = core.Seed(curve.positions, curve.offsets, curve.closed, max_distance=side / 10.0)
    part, again, _whole = run(replace(problem, seed=seed))
    assert not part.once and len(again.closed) == 3
    middles = [again.positions[begin:end].mean(axis=0)[0]
               for begin, end in zip(again.offsets[:-1], again.offsets[1:])]  # fmt: skip
    assert np.abs(np.diff(middles) - side).max() < 0.4 * side


def test_what_has_strands_elsewhere_or_shared_faces_is_taken_as_it_is() -> None:
    bodies = [potato(), moved(potato(), np.eye(3), (5, 0, 0))]
    problem = problem_of(bodies)
    points = np.array([[0.0, 0, 1], [4.1, 0, 1], [0.1, 0.1, 1]])
    seed = core.Seed(points, np.array([0, 3], np.uint32), np.array([1], np.uint8), max_distance=9.0)
    assert at_once(copying(replace(problem, seed=seed))) is None
    assert at_once(copying(replace(problem, copies=problem.copies[:1]))) is None
    assert at_once(copying(replace(problem, copies=problem.copies + [1, -1]))) is None
    assert at_once(copying(replace(problem, copies=None))) is None
    with pytest.raises(core.MeanderError, match="fill the mesh again"):
        at_once(copying(problem)).density_of(np.ones(len(problem.vertices)))


def test_many_copies_are_as_many_threads_have_them() -> None:
    rng = np.random.default_rng(5)
    bodies = [moved(potato(), rotation(rng), (4.0 * (k % 5), 4.0 * (k // 5), k)) for k in range(30)]
    curves = []
    for threads in (1, 2):
        problem = problem_of(bodies)
        problem.options.threads = threads
        curves.append(run(problem)[1])
    assert np.array_equal(curves[0].positions, curves[1].positions)
    assert len(curves[0].closed) == 30
