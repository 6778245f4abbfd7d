# SPDX-License-Identifier: GPL-3.0-or-later
"""Mazes of closed lines, against floods of pixels that know nothing of cut meshes."""

from __future__ import annotations

from collections import Counter, deque

import geometry
import numpy as np
import pytest
from flows import options_of
from meander import core
from meander.model.maze import Doors, Maze, NoMaze
from meander.model.walls import bar_pieces, wall, wall_pieces

SPACING, WIDTH, DOOR = 0.1, 0.02, 0.1
DISC_SPACING = 0.12
SIZE = 160


def cut_of(
    mesh: geometry.Mesh,
    spacing: float,
    seed: core.Seed | None = None,
    variation: int = 0,
    detail: float = 0.2,
    iterations: int = 150,
) -> core.CutSurface:
    options = options_of(variation=variation, radius=spacing / 2, iteration_limit=iterations)
    with core.Flow(core.Surface(*mesh), options, seed) as flow:
        flow.run()
        return core.cut_surface(flow, detail * spacing, middle_lines=True)


@pytest.fixture(scope="module")
def sheet() -> core.CutSurface:
    """A square of side 1 with one closed line."""
    mesh = geometry.grid(12, 12)
    low = mesh.vertices.min(axis=0)
    vertices = (mesh.vertices - low) / np.ptp(mesh.vertices[:, 0])
    cut = cut_of(mesh._replace(vertices=vertices), SPACING)
    assert len(cut.lengths) == 1 and cut.closed[0]
    return cut


def line_of(cut: core.CutSurface) -> np.ndarray:
    return cut.positions[cut.line_vertices]


def pieces_of(cut: core.CutSurface, doors: Doors | None) -> list[tuple[np.ndarray, bool]]:
    gaps, bars = ((), ()) if doors is None else (doors.gaps, doors.bars)
    line = line_of(cut)
    up = np.tile([0.0, 0.0, 1.0], (len(line), 1))
    pieces = wall_pieces(line, up, [(float(cut.arc_lengths[place]), DOOR) for place in gaps])
    for first, last, opened in bars:
        pieces += bar_pieces(line[[first, last]], up[:2], DOOR if opened else 0.0)
    return [(points, closed) for points, _, closed in pieces]


def free(pieces: list[tuple[np.ndarray, bool]]) -> np.ndarray:
    """The pixels that no wall covers, with one row more around, all of them free."""
    ends = [
        np.stack([p, np.roll(p, -1, axis=0)], axis=1)[: None if closed else -1, :, :2]
        for p, closed in pieces
    ]
    steps = np.arange(-1, SIZE + 1) / SIZE + 0.5 / SIZE
    places = np.stack(np.meshgrid(steps, steps), axis=2).reshape(-1, 2)
    away = geometry.distance_to_pieces(places, *np.vstack(ends).swapaxes(0, 1))
    return (away > WIDTH / 2).reshape(SIZE + 2, SIZE + 2)


def flood(open_pixels: np.ndarray, begin: tuple[int, int]) -> np.ndarray:
    """Which pixels one comes to, by sides."""
    reached = np.zeros_like(open_pixels)
    reached[begin] = True
    queue = deque([begin])
    while queue:
        i, j = queue.popleft()
        for a, b in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
            if 0 <= a < len(reached) and 0 <= b < len(reached):
                if open_pixels[a, b] and not reached[a, b]:
                    reached[a, b] = True
                    queue.append((a, b))
    return reached


def inside_pixel(cut: core.CutSurface, maze: Maze) -> tuple[int, int]:
    """In the middle of a corridor of the maze."""
    of_maze = cut.faces[cut.regions == maze.region]
    vertex = of_maze.ravel()[np.argmax(cut.distances[of_maze.ravel()])]
    x, y = cut.positions[vertex][:2]
    return int(y * SIZE) + 1, int(x * SIZE) + 1


def test_only_doors_lead_into_the_maze(sheet: core.CutSurface) -> None:
    maze = Maze(sheet, SPACING)
    within = inside_pixel(sheet, maze)
    closed = flood(free(pieces_of(sheet, None)), (0, 0))
    assert not closed[within]
    doors = maze.farthest_doors()
    opened = free(pieces_of(sheet, doors))
    reached = flood(opened, (0, 0))
    assert reached[within]
    # Each door alone leads in as well, and the way is one: with a wall across either end of it, one
    # comes in by the other only, and not out.
    for vertex in doors.ends:
        x, y = sheet.positions[vertex][:2]
        rows, columns = np.mgrid[0 : SIZE + 2, 0 : SIZE + 2]
        near = np.hypot((columns - 0.5) / SIZE - x, (rows - 0.5) / SIZE - y) < 0.6 * DOOR
        assert flood(opened & ~near, (0, 0))[within]


def test_the_maze_has_no_loops(sheet: core.CutSurface) -> None:
    """What is not maze is in one piece: no wall stands by itself in a corridor."""
    maze = Maze(sheet, SPACING)
    corridors = flood(free(pieces_of(sheet, None)), inside_pixel(sheet, maze))
    around = flood(~corridors, (0, 0))
    assert (around | corridors).all()
    assert corridors.mean() > 0.2


def test_doors_are_far_apart_and_at_the_border(sheet: core.CutSurface) -> None:
    maze = Maze(sheet, SPACING)
    doors = maze.farthest_doors()

    def in_the_middle(of: Doors) -> float:
        way = sheet.positions[maze.way(of)]
        away = np.minimum(way[1:, :2], 1.0 - way[1:, :2]).min(axis=1)
        return float(np.linalg.norm(np.diff(way, axis=0), axis=1)[away > 2.5 * SPACING].sum())

    def apart(ends: tuple[int, int]) -> float:
        return float(np.linalg.norm(np.subtract(*sheet.positions[list(ends)])))

    line = line_of(sheet)
    to_border = np.minimum(line[:, :2], 1.0 - line[:, :2]).min(axis=1)
    for vertex in doors.ends:
        x, y = sheet.positions[vertex][:2]
        assert min(x, y, 1.0 - x, 1.0 - y) < 1.2 * SPACING
    assert apart(doors.ends) > 0.9, "the sheet is 1 wide"
    rng = np.random.default_rng(5)
    outer = sheet.line_vertices[to_border < 0.6 * SPACING]
    pairs = [tuple(rng.choice(outer, 2, replace=False)) for _ in range(600)]
    others = [Doors(0, pair, ()) for pair in pairs if apart(pair) > 1.1]
    assert len(others) > 10
    assert in_the_middle(doors) > 0.9 * max(in_the_middle(each) for each in others)


def disc(rings: int) -> geometry.Mesh:
    """Of radius 1, of faces alike."""
    points, faces = [(0.0, 0.0, 0.0)], []

    def at(ring: int, place: int) -> int:
        return 1 + 3 * ring * (ring - 1) + place % (6 * ring) if ring else 0

    for ring in range(1, rings + 1):
        turns = 2.0 * np.pi * np.arange(6 * ring) / (6 * ring)
        points += [(ring / rings * np.cos(t), ring / rings * np.sin(t), 0.0) for t in turns]
        for sixth in range(6):
            for k in range(ring):
                out, inside = sixth * ring + k, sixth * (ring - 1) + k
                faces.append((at(ring, out), at(ring, out + 1), at(ring - 1, inside)))
                if k < ring - 1:
                    inner = at(ring - 1, inside), at(ring - 1, inside + 1)
                    faces.append((at(ring, out + 1), inner[1], inner[0]))
    return geometry.mesh(points, faces)


@pytest.fixture(scope="module", params=range(8))
def on_disc(request: pytest.FixtureRequest) -> core.CutSurface:
    return cut_of(disc(12), DISC_SPACING, variation=request.param)


def test_the_way_through_a_disc_leads_through_its_middle(on_disc: core.CutSurface) -> None:
    maze = Maze(on_disc, DISC_SPACING)
    doors = maze.farthest_doors()
    way = on_disc.positions[maze.way(doors)]
    away = np.linalg.norm(way, axis=1)
    assert away[[0, -1]].min() > 1.0 - 1.2 * DISC_SPACING, "both doors are at the rim"
    angle = np.arccos(way[0] @ way[-1] / (away[0] * away[-1]))
    assert angle > np.radians(100.0)
    steps = np.linalg.norm(np.diff(way, axis=0), axis=1)
    at_rim = steps[away[1:] > 1.0 - 2.5 * DISC_SPACING].sum()
    assert away.min() < 1.0 / 3.0 and at_rim < 0.5 * steps.sum()
    assert steps.sum() > 1.2 * np.linalg.norm(way[0] - way[-1])
    assert doors.through


def test_the_walls_of_a_disc_are_two_pieces(on_disc: core.CutSurface) -> None:
    """So all corridors are one tree, with two ways out: a third piece would stand in a loop or
    beside a third door, and one piece leaves a door shut."""
    doors = Maze(on_disc, DISC_SPACING).farthest_doors()
    assert doors.bars
    # On a plan of side 1 the disc is half as large.
    walls = ~free([(points / 2.0 + 0.5, closed) for points, closed in pieces_of(on_disc, doors)])
    count = 0
    while walls.any():
        walls &= ~flood(walls, tuple(np.argwhere(walls)[0]))
        count += 1
    assert count == 2


def test_the_way_keeps_off_the_walls(sheet: core.CutSurface) -> None:
    maze = Maze(sheet, SPACING)
    doors = maze.farthest_doors()
    way = maze.way(doors)
    assert (way[0], way[-1]) == doors.ends
    gaps = sheet.line_vertices[list(doors.gaps)]
    assert (sheet.distances[way[1:-1]] > 0.0).sum() >= len(way) - 2 - len(gaps)
    edges = {tuple(sorted(pair)) for face in sheet.faces.tolist() for pair in
             ((face[0], face[1]), (face[1], face[2]), (face[2], face[0]))}  # fmt: skip
    assert all(tuple(sorted(pair)) in edges for pair in zip(way[:-1].tolist(), way[1:].tolist()))
    assert np.median(sheet.distances[way]) > 0.35 * SPACING, "in the middle of corridors"
    assert not np.isin(way[1:-1], np.setdiff1d(sheet.line_vertices, gaps)).any()


def sharp_share(points: np.ndarray, spacing: float) -> float:
    """Of a flat line, where it turns by more than 45 degrees within .3 spacings."""
    steps = np.diff(points[:, :2], axis=0)
    steps = steps[np.linalg.norm(steps, axis=1) > 1e-9]
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(steps, axis=1))])
    before, after = steps[:-1].T, steps[1:].T
    cross = before[0] * after[1] - before[1] * after[0]
    turned = np.cumsum(np.append(0.0, np.arctan2(cross, (before * after).sum(axis=0))))
    places = np.arange(0.0, at[-1], 0.02 * spacing)
    low, high = (np.searchsorted(at[1:-1], places + side * spacing) for side in (-0.15, 0.15))
    return float((np.abs(turned[high] - turned[low]) > np.pi / 4.0).mean())


def test_the_way_is_round_and_clear_of_walls(
    sheet: core.CutSurface, on_disc: core.CutSurface
) -> None:
    """Its vertices lie on edges of the cut, and turn sharply over .058 to .096 of its length."""
    for cut, spacing in ((sheet, SPACING), (on_disc, DISC_SPACING)):
        maze = Maze(cut, spacing)
        doors = maze.farthest_doors()
        vertices = maze.way(doors)
        way = maze.places(vertices, doors)
        assert sharp_share(way, spacing) < 0.025
        lines = [
            np.stack([p, np.roll(p, -1, axis=0)], axis=1)[: None if closed else -1, :, :2]
            for p, closed in pieces_of(cut, doors)
        ]
        walls = np.vstack(lines).swapaxes(0, 1)
        assert geometry.distance_to_pieces(way[:, :2], *walls).min() > 0.2 * spacing
        middle = cut.positions[vertices]
        aside = geometry.distance_to_pieces(middle[:, :2], way[:-1, :2], way[1:, :2])
        assert aside.max() < 0.25 * spacing and np.abs(way[:, 2]).max() < 1e-9


@pytest.mark.parametrize("spacing", [0.085, 0.1])
def test_a_way_ends_in_the_middle_of_a_mouth(spacing: float) -> None:
    """Not at one of the walls beside it, with as few vertices across a corridor as buttons have."""
    mesh = geometry.grid(16, 16)
    low = mesh.vertices.min(axis=0)
    mesh = mesh._replace(vertices=(mesh.vertices - low) / np.ptp(mesh.vertices[:, 0]))
    mouths = 0
    for variation in range(2):
        cut = cut_of(mesh, spacing, variation=variation, detail=0.25, iterations=1000)
        maze = Maze(cut, spacing)
        doors = maze.farthest_doors()
        ends = np.setdiff1d(doors.ends, cut.line_vertices)  # those in a wall are of its line
        assert np.all(cut.distances[ends] > 0.25 * spacing)
        mouths += len(ends)
        places = maze.places(maze.way(doors), doors)[[0, -1]]
        assert np.minimum(places[:, :2], 1.0 - places[:, :2]).min(axis=1).max() < spacing
    assert mouths > 0


def test_doors_where_one_wants_them(sheet: core.CutSurface) -> None:
    doors = Maze(sheet, SPACING).doors_at(0.75, 0.25)
    whole = sheet.lengths[0]
    first, second = doors.gaps
    assert sheet.arc_lengths[first] == pytest.approx(0.25 * whole, abs=0.01)
    assert sheet.arc_lengths[second] == pytest.approx(0.75 * whole, abs=0.01)
    assert not doors.bars


def test_a_line_with_one_side_makes_no_maze() -> None:
    mesh = geometry.grid(8, 8)
    low = mesh.vertices.min(axis=0)
    mesh = mesh._replace(vertices=(mesh.vertices - low) / np.ptp(mesh.vertices[:, 0]))
    stroke = core.Seed(np.array([[0.2, 0.5, 0.0], [0.8, 0.5, 0.0]]), [0, 2], [0])
    with pytest.raises(NoMaze, match="only one side"):
        Maze(cut_of(mesh, 0.2, stroke), 0.2)


def circle(count: int = 100) -> tuple[np.ndarray, np.ndarray]:
    turn = 2.0 * np.pi * np.arange(count) / count
    points = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(count)])
    return points, np.tile([0.0, 0.0, 2.0], (count, 1))


def volume_of(vertices: np.ndarray, faces: np.ndarray) -> float:
    """Positive where faces look outward; fails where the mesh is not watertight."""
    count = Counter()
    for face in faces.tolist():
        for a, b in zip(face, face[1:] + face[:1]):
            count[a, b] += 1
    assert all(number == 1 and count[b, a] == 1 for (a, b), number in list(count.items()))
    triangles = np.vstack([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])
    return float(np.linalg.det(vertices[triangles]).sum() / 6.0)


@pytest.mark.parametrize("closed", [True, False])
def test_walls_are_watertight(closed: bool) -> None:
    points, normals = circle()
    vertices, faces = wall(points, normals, closed, 0.2, 0.3, 0.1)
    length = np.linalg.norm(np.diff(np.vstack([points, points[:closed]]), axis=0), axis=1).sum()
    assert volume_of(vertices, faces) == pytest.approx(length * 0.2 * 0.4, rel=0.01)
    assert vertices[:, 2].min() == pytest.approx(-0.1)
    assert vertices[:, 2].max() == pytest.approx(0.3)
    radii = np.linalg.norm(vertices[:, :2], axis=1)
    assert radii.min() == pytest.approx(0.9, abs=0.002)
    assert radii.max() == pytest.approx(1.1, abs=0.002)


@pytest.mark.parametrize("middles", [(1.0, 4.0), (0.1, 3.0), (6.2, 2.0)])
def test_gaps_are_cut_where_they_are_asked_for(middles: tuple[float, float]) -> None:
    points, normals = circle(400)
    whole = 2.0 * 400 * np.sin(np.pi / 400)
    pieces = wall_pieces(points, normals, [(middle, 0.5) for middle in middles])
    assert [closed for _, _, closed in pieces] == [False, False]
    lengths = [np.linalg.norm(np.diff(piece, axis=0), axis=1).sum() for piece, _, _ in pieces]
    assert sum(lengths) == pytest.approx(whole - 1.0, rel=1e-3)
    for middle in middles:
        place = np.array([np.cos(middle), np.sin(middle), 0.0])
        away = min(np.linalg.norm(piece - place, axis=1).min() for piece, _, _ in pieces)
        assert away == pytest.approx(0.25, abs=0.01)
    assert all(len(piece) == len(across) for piece, across, _ in pieces)


def test_gaps_that_meet_leave_one_wall() -> None:
    points, normals = circle(400)
    pieces = wall_pieces(points, normals, [(1.0, 0.5), (1.3, 0.5)])
    assert len(pieces) == 1
    length = np.linalg.norm(np.diff(pieces[0][0], axis=0), axis=1).sum()
    assert length == pytest.approx(2.0 * np.pi - 0.8, rel=2e-3)
