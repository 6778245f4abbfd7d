# SPDX-License-Identifier: GPL-3.0-or-later
"""Strokes, guides and parts without a strand, through core.py and the batch command."""

from __future__ import annotations

import json
from pathlib import Path

import geometry
import numpy as np
import pytest
from conftest import grow, without_blender
from flows import flow_on, options_of
from meander import batch, core
from meander.model import strands
from meander.model.files import obj
from sentences import assert_sentence

BAR = [[0.2, 0.5, 0.0], [0.8, 0.55, 0.0]]


def seed_of(*lines: tuple[list, bool]) -> core.Seed:
    """A seed of lines: points, closed."""
    return core.Seed(
        points=np.array([point for points, _closed in lines for point in points], dtype=float),
        offsets=np.cumsum([0] + [len(points) for points, _closed in lines]).astype(np.uint32),
        closed=np.array([closed for _points, closed in lines], dtype=np.uint8),
    )


def part(name: str, *lines: tuple[list, bool], guide: bool = False) -> strands.Part:
    return strands.Part(name, seed_of(*lines), guide)


def strand(curve: core.Polylines, k: int) -> np.ndarray:
    return curve.positions[curve.offsets[k] : curve.offsets[k + 1]]


# ------------------------------------------------------------------------------------------------
# Putting strands together


def test_parts_are_put_together_in_order() -> None:
    corner = [[0, 1, 0], [1, 1, 0], [1, 2, 0]]
    first = part("First", ([[0, 0, 0], [1, 0, 0]], False), (corner, True))
    first.seed.fixed = np.array([1, 1, 0, 0, 1], dtype=np.uint8)
    second = part("Second", ([[0, 3, 0], [1, 3, 0]], False), guide=True)
    seed = strands.assembled([first, second])
    assert seed.offsets.tolist() == [0, 2, 5, 7] and seed.closed.tolist() == [0, 1, 0]
    assert seed.fixed.tolist() == [1, 1, 0, 0, 1, 0, 0] and seed.guides.tolist() == [0, 0, 1]
    assert np.array_equal(seed.points[5:], second.seed.points)
    assert not seed.loops and strands.assembled([second]).loops
    assert strands.assembled([first], loops=True).loops and strands.assembled([]) is None
    cut = strands.span(seed, 1, 3)
    assert cut.offsets.tolist() == [0, 3, 5] and cut.guides.tolist() == [0, 1]
    assert np.array_equal(cut.points, seed.points[2:])


def test_guides_are_taken_out_of_polylines() -> None:
    curve = core.Polylines(
        np.arange(27.0).reshape(9, 3),
        np.arange(27.0).reshape(9, 3) + 100,
        np.array([0, 2, 5, 9], dtype=np.uint32),
        np.array([0, 1, 1], dtype=np.uint8),
    )
    left = strands.without_guides(curve, np.array([False, True, False]))
    assert left.offsets.tolist() == [0, 2, 6] and left.closed.tolist() == [0, 1]
    assert np.array_equal(left.positions, curve.positions[[0, 1, 5, 6, 7, 8]])
    assert np.array_equal(left.normals, curve.normals[[0, 1, 5, 6, 7, 8]])


# ------------------------------------------------------------------------------------------------
# Flows


def test_one_stroke_keeps_its_ends_across_a_whole_model() -> None:
    mesh = geometry.torus(40, 20)
    begin, end = mesh.vertices[0], mesh.vertices[20 * 20 + 10]  # on the other side of the ring
    result = grow(mesh, 0.1, strands.stroke(begin, end))
    assert result.curve.closed.tolist() == [0]
    assert result.statistics["crossings"] == 0 and result.statistics["empty_components"] == 0
    # A vertex is approached to 2^-30 of a face.
    assert np.abs(result.curve.positions[0] - begin).max() < 1e-8
    assert np.abs(result.curve.positions[-1] - end).max() < 1e-8
    samples = geometry.samples_of(*result.curve[::2], result.curve.closed, 0.02)
    distances = geometry.distance_to_samples(geometry.sample_surface(mesh, 2000), samples)
    assert np.quantile(distances, 0.99) < 1.3 * 0.1


def test_guides_stay_and_are_told_from_what_grows() -> None:
    seed = strands.assembled([part("Bar", (BAR, False), guide=True)])
    mesh = geometry.grid(6)
    with flow_on(mesh, seed=seed, radius=0.04) as flow:
        assert flow.guides().tolist() == [True, False]
        before = strand(flow.polylines(), 0)
        flow.run()
        assert np.array_equal(strand(flow.polylines(), 0), before)
        figures = flow.statistics()
        assert (figures["guides"], figures["strands"], figures["crossings"]) == (1, 2, 0)
        assert flow.nodes().fixed[: len(before)].sum() > 5
    line = np.array(BAR)
    direction = (line[1] - line[0]) / np.linalg.norm(line[1] - line[0])
    away = before - line[0] - np.outer((before - line[0]) @ direction, direction)
    assert np.abs(away).max() < 1e-8


def test_components_on_which_nothing_grows_are_counted_or_filled() -> None:
    mesh = geometry.two_spheres()
    ring = [[np.cos(a), np.sin(a), 0] for a in np.linspace(0, 6, 20)]
    seed = seed_of((ring, True))
    seed.points += mesh.vertices[: len(mesh.vertices) // 2].mean(axis=0)
    assert grow(mesh, 0.2, seed, iteration_limit=3).statistics["empty_components"] == 1
    seed.loops = True
    found = grow(mesh, 0.2, seed, iteration_limit=3)
    assert found.statistics["empty_components"] == 0 and found.statistics["strands"] == 2
    assert grow(mesh, 0.2, iteration_limit=1).statistics["empty_components"] == 0


@pytest.mark.parametrize("threads", [2, 5])
def test_guides_give_the_same_bytes_for_any_number_of_threads(threads: int) -> None:
    seed = strands.assembled([part("Bar", (BAR, False), guide=True)])
    curves = [
        grow(geometry.grid(6), 0.05, seed, iteration_limit=15, threads=count).curve
        for count in (1, threads)
    ]
    for one, other in zip(*curves, strict=True):
        assert np.array_equal(one, other)


# ------------------------------------------------------------------------------------------------
# Refusals


def refusal(seed: core.Seed, mesh: geometry.Mesh | None = None) -> core.MeanderError:
    with pytest.raises(core.MeanderError) as caught:
        grow(mesh or geometry.grid(6), 0.04, seed, iteration_limit=1)
    assert_sentence(str(caught.value))
    return caught.value


def test_guides_alone_are_refused() -> None:
    seed = seed_of((BAR, False))
    seed.guides = np.ones(1, dtype=np.uint8)
    assert "nothing can grow" in str(refusal(seed))


def test_guides_that_leave_no_room_are_refused() -> None:
    lines = [([[0, y, 0], [1, y, 0]], False) for y in np.linspace(0.02, 0.98, 49)]
    seed = strands.assembled([part("Hatching", *lines, guide=True)])
    assert "no room" in str(refusal(seed))


def test_a_guide_across_the_seed_is_refused_naming_both() -> None:
    lines = ([[0.1, 0.1, 0], [0.9, 0.1, 0]], False), ([[0.5, 0.2, 0], [0.5, 0.9, 0]], False)
    parts = [
        part("Drawn", *lines),
        part("Fence", (BAR, False), guide=True),
    ]
    error = refusal(strands.assembled(parts))
    assert error.element_kind == "seed_point" and error.elements == (2, 4)
    assert "touches a guide just after seed points 2 and 4" in str(error)
    told = str(strands.explained(error, parts))
    assert_sentence(told)
    assert "after point 1 of spline 2 of 'Drawn' and point 1 of spline 1 of 'Fence'" in told
    assert "seed point" not in told


def test_points_of_one_spline_are_told_together_and_lengths_as_the_user_reads_them() -> None:
    bow = [[0.2, 0.2, 0], [0.8, 0.8, 0], [0.2, 0.8, 0], [0.8, 0.2, 0]]
    parts = [part("Bow", ([[0.5, 0.1, 0], [0.9, 0.1, 0]], False), (bow, False))]
    told = str(strands.explained(refusal(strands.assembled(parts)), parts))
    assert_sentence(told)
    assert "just after points 1 and 3 of spline 2 of 'Bow'" in told
    parts = [part("High", ([[0.1, 0.1, 0], [0.9, 0.1, 0.7]], False))]
    error = refusal(strands.assembled(parts, max_distance=0.5))
    told = str(strands.explained(error, parts, lambda value: f"{100 * value:.0f} cm"))
    assert_sentence(told)
    assert told.startswith("Point 2 of spline 1 of 'High' is 70 cm away")
    assert "at most 50 cm is allowed" in told


# ------------------------------------------------------------------------------------------------
# Away from the surface


def test_a_seed_above_the_surface_is_laid_on_it_and_the_distance_told() -> None:
    waves = [[x, 0.5, 0.1 + 0.1 * x] for x in np.linspace(0.1, 0.9, 9)]
    drawn = [part("Waves", (waves, False))]
    mesh = geometry.grid(6)
    most = strands.max_distance_of(mesh.vertices)
    assert most == pytest.approx(0.25 * np.sqrt(2))
    assert refusal(strands.assembled(drawn)).elements == (0,)  # without it r is the limit
    options = options_of(radius=0.04)
    with (
        core.Surface(*mesh) as surface,
        core.Flow(surface, options, strands.assembled(drawn, max_distance=most)) as flow,
    ):
        figures, laid = flow.statistics(), flow.polylines().positions
    assert figures["seed_distance"] == pytest.approx(0.19)
    assert figures["seed_point"] == 8 and figures["seed_jumps"] == 0
    assert np.abs(laid[:, 2]).max() == 0
    assert np.abs(laid[:, 1] - 0.5).max() < 1e-6
    assert "up to 0.19 away" in strands.fit_remark(figures, drawn, options.radius)
    assert strands.fit_remark(figures, drawn, 0.2) == ""
    assert strands.fit_warning(figures, drawn) == ""


def test_a_seed_that_jumps_from_sheet_to_sheet_is_told_of() -> None:
    # A sheet folded over itself: its two halves are 0.1 apart, and joined at x = 1 only.
    profile = [(x, 0.0) for x in np.linspace(0, 1, 9)] + [(x, 0.1) for x in np.linspace(1, 0, 9)]
    vertices = [[x, y, z] for x, z in profile for y in np.linspace(0, 1, 9)]
    faces = [
        face
        for i in range(len(profile) - 1)
        for j in range(8)
        for a in [9 * i + j]
        for face in ([a, a + 9, a + 10], [a, a + 10, a + 1])
    ]
    below = [[0.1, 0.5, 0.02], [0.2, 0.5, 0.03], [0.3, 0.5, 0.04]]
    rising = [*below, [0.3, 0.5, 0.06], [0.2, 0.5, 0.07], [0.1, 0.5, 0.08]]
    drawn = [part("Rising", ([[0.1, 0.2, 0], [0.9, 0.2, 0]], False), (rising, False))]
    options = options_of(radius=0.05)
    for scale in (1.0, 1000.0):
        options.radius = 0.05 * scale
        seed = strands.assembled(drawn)
        seed.points *= scale
        mesh = geometry.mesh(scale * np.array(vertices), faces)
        with core.Surface(*mesh) as surface, core.Flow(surface, options, seed) as flow:
            figures = flow.statistics()
        assert figures["seed_jumps"] == 1
        # Between the third point, below the middle of the gap, and the fourth.
        assert (figures["seed_jump_point"], figures["seed_jump_point2"]) == (4, 5)
        way = 2 * (1 - 0.3) + 0.1
        assert figures["seed_jump_length"] == pytest.approx(scale * way, rel=0.01)
    told = strands.fit_warning(figures, drawn)
    assert_sentence(told)
    assert "between points 3 and 4 of spline 2 of 'Rising'" in told
    # From one point to another the user may go round as far as he likes.
    stroke = strands.Part("Stroke", strands.stroke([0.1, 0.5, 0], [0.1, 0.5, 0.1]))
    with core.Surface(*geometry.mesh(vertices, faces)) as surface:
        options.radius = 0.05
        with core.Flow(surface, options, strands.assembled([stroke])) as flow:
            assert flow.statistics()["seed_jumps"] == 0


@pytest.mark.parametrize("cells", [1, 6, 40])
def test_a_stroke_is_led_round_guides(cells: int) -> None:
    begin, end = [0.5, 0.2, 0.0], [0.5, 0.9, 0.0]
    hook = [[0.9, 0.45, 0.0], [0.3, 0.45, 0.0], [0.3, 0.7, 0.0], [0.7, 0.75, 0.0]]
    fence = part("Fence", (BAR, False), (hook, False), guide=True)
    drawn = strands.Part("Drawn", strands.stroke(begin, end), False)
    result = grow(geometry.grid(cells), 0.03, strands.assembled([drawn, fence]))
    figures = result.statistics
    assert (figures["guides"], figures["strands"], figures["crossings"]) == (2, 3, 0)
    stroke = strand(result.curve, 0)
    assert np.abs(stroke[[0, -1]] - [begin, end]).max() < 1e-8
    # It had to leave the hook at its open side, and fills what it comes to.
    assert figures["length"] > 0.8 * 1 / 0.06
    samples = geometry.samples_of(*result.curve[::2], result.curve.closed, 0.01)
    distances = geometry.distance_to_samples(
        geometry.sample_surface(geometry.grid(6), 2000), samples
    )
    assert np.quantile(distances, 0.99) < 1.5 * 0.03


@pytest.mark.parametrize(
    "walls",
    [
        ([[0.3, 0.7, 0], [0.7, 0.7, 0], [0.7, 0.98, 0], [0.3, 0.98, 0]], True),
        ([[0, 0.5, 0], [1, 0.55, 0]], False),
    ],
    ids=["closed", "from side to side"],
)
def test_a_stroke_that_guides_part_is_refused(walls: tuple) -> None:
    fence = part("Fence", walls, guide=True)
    drawn = strands.Part("Drawn", strands.stroke([0.5, 0.2, 0], [0.5, 0.9, 0]), False)
    error = refusal(strands.assembled([drawn, fence]))
    assert error.elements == (0, 1)
    assert "guides part the two" in str(error)


def test_a_flag_too_few_is_refused() -> None:
    seed = seed_of((BAR, False), ([[0.1, 0.1, 0], [0.9, 0.1, 0]], False))
    seed.guides = np.ones(1, dtype=np.uint8)
    assert "one guide flag for each of its 2 strands" in str(refusal(seed))


# ------------------------------------------------------------------------------------------------
# Batch


@pytest.fixture
def run(tmp_path: Path, capsys: pytest.CaptureFixture):
    """Runs the command on a mesh: exit code, stdout, stderr."""

    def call(mesh: geometry.Mesh, *extra: str) -> tuple[int, str, str]:
        path = geometry.write_obj(tmp_path / "mesh.obj", mesh)
        code = batch.main(
            ["--input", str(path), "--output", str(tmp_path / "out.obj"), "--spacing", "0.1"]
            + ["--report", str(tmp_path / "out.json"), *map(str, extra)]
        )
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return call


def report_of(tmp_path: Path) -> dict:
    return json.loads((tmp_path / "out.json").read_text())


def test_batch_draws_a_stroke_between_points_or_vertices(run, tmp_path: Path) -> None:
    mesh = geometry.grid(6)
    code, _out, err = run(mesh, "--from", -0.01, 0, 0, "--to-vertex", len(mesh.vertices) - 1)
    assert (code, err) == (0, "")
    curve = obj.read_obj_curve(tmp_path / "out.obj")
    assert curve.closed.tolist() == [0]
    assert np.abs(curve.points[0]).max() < 1e-8
    assert np.abs(curve.points[-1] - mesh.vertices[-1]).max() < 1e-8
    options = report_of(tmp_path)["options"]
    assert options["from"] == [-0.01, 0, 0] and options["to"] == mesh.vertices[-1].tolist()


def test_batch_keeps_guides_or_leaves_them_out(run, tmp_path: Path) -> None:
    guides = geometry.write_lines(tmp_path / "guides.obj", BAR)
    code, _out, err = run(geometry.grid(6), "--guides", guides, "--iterations", 20)
    assert (code, err) == (0, "")
    curve = obj.read_obj_curve(tmp_path / "out.obj")
    assert curve.closed.tolist() == [0, 1]
    assert np.abs(curve.points[0] - BAR[0]).max() < 1e-8
    found = report_of(tmp_path)
    assert (found["guides"], found["strands"], found["crossings"]) == (1, 2, 0)
    code, _out, err = run(geometry.grid(6), "--guides", guides, "--leave-out-guides")
    assert (code, err) == (0, "")
    assert obj.read_obj_curve(tmp_path / "out.obj").closed.tolist() == [1]


def test_batch_tells_of_parts_on_which_nothing_grows(run, tmp_path: Path) -> None:
    mesh = geometry.two_spheres()
    ends = ("--from-vertex", 0, "--to-vertex", 20)
    code, out, _err = run(mesh, *ends, "--iterations", 3, "--spacing", 0.4)
    assert code == 0 and "Nothing grows on one separate part of the mesh" in out
    assert report_of(tmp_path)["empty_components"] == 1
    code, out, _err = run(mesh, *ends, "--iterations", 3, "--spacing", 0.4, "--fill-every-part")
    assert code == 0 and "Nothing grows" not in out
    assert report_of(tmp_path)["empty_components"] == 0


def test_batch_joins_parts_by_bridges(run, tmp_path: Path) -> None:
    mesh = geometry.two_spheres()
    settings = ("--iterations", 60, "--spacing", 0.4, "--bridge")
    code, out, _err = run(mesh, *settings)
    assert code == 0 and "joined all strands by 2 bridges" in out
    report = report_of(tmp_path)
    assert report["bridges"]["count"] == 2 and report["options"]["bridge"] is True
    # The spheres are 1 apart.
    assert 2.0 < report["bridges"]["length"] < 2.5
    joined = obj.read_obj_curve(tmp_path / "out.obj")
    assert joined.closed.tolist() == [1]
    code, _out, _err = run(mesh, *settings, "--output", tmp_path / "out.csv")
    table = np.genfromtxt(tmp_path / "out.csv", delimiter=",", names=True)
    assert code == 0 and np.all(table["strand"] == 0) and np.all(table["closed"] == 1)
    places = np.column_stack([table[axis] for axis in "xyz"])
    assert np.allclose(places, joined.points)
    # Every point is in the face that is named for it, those where bridges begin as well.
    corners = mesh.vertices[mesh.faces[table["face"].astype(int)]]
    weights = np.column_stack([table[name] for name in ("w0", "w1", "w2")])
    assert np.abs(np.einsum("nk,nkj->nj", weights, corners) - places).max() < 1e-6
    steps = np.linalg.norm(np.diff(places, axis=0, append=places[:1]), axis=1)
    assert np.allclose(np.cumsum(steps)[:-1], table["arc_length"][1:])
    # What is one line already stays it.
    code, out, _err = run(geometry.grid(4), "--iterations", 5, "--bridge")
    assert code == 0 and "bridges" not in out
    assert report_of(tmp_path)["bridges"] == {"count": 0, "length": 0.0}


BAD = {
    "one end": (("--from", 0, 0, 0), "give --to as well"),
    "both kinds": (("--from", 0, 0, 0, "--from-vertex", 1, "--to-vertex", 2), "choose one"),
    "no such vertex": (("--from-vertex", 0, "--to-vertex", 999), "not a vertex"),
    "far away": (("--from", 0, 0, 3, "--to-vertex", 9), "Point 1 of spline 1 of 'the stroke' is 3"),
    "left out without": (("--leave-out-guides",), "give --guides as well"),
    "no file": (("--guides", "nothing.obj"), "--guides nothing.obj does not exist"),
    "no curve": (("--guides", __file__), "is no .obj file"),
}


@pytest.mark.parametrize("name", BAD)
def test_batch_refuses(run, tmp_path: Path, name: str) -> None:
    extra, words = BAD[name]
    code, out, err = run(geometry.grid(6), *extra)
    assert code == 2 and out == "" and words in err
    assert_sentence(err.rstrip("\n"))
    assert not (tmp_path / "out.obj").exists() and not (tmp_path / "out.json").exists()


@without_blender
def test_objects_need_blender(run) -> None:
    code, out, err = run(geometry.grid(6), "--guides-object", "Guides")
    assert code == 2 and out == "" and "--guides-object needs Blender" in err
    assert_sentence(err.rstrip("\n"))


def test_batch_refuses_a_stroke_between_parts(run) -> None:
    mesh = geometry.two_spheres()
    code, _out, err = run(mesh, "--from-vertex", 0, "--to-vertex", len(mesh.vertices) - 1)
    assert code == 2 and "leaves its part of the surface" in err
    assert_sentence(err.rstrip("\n"))
