# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything together: flows on random meshes with random options, checked by plain numpy.

A number draws a mesh, its preparation, a seed, options, fields and a movement. Whatever is drawn,
the curve stays on the surface, crosses nothing, keeps its strands and what is fixed, and is the
same for any number of threads; what cannot be is refused with a sentence.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import geometry
import numpy as np
import pytest
from meander import core
from sentences import assert_sentence


@dataclass
class Case:
    """What one number has drawn."""

    mesh: geometry.Mesh
    preparation: core.SurfaceOptions
    options: core.FlowOptions
    iterations: int
    seed: core.Seed | None = None
    outline: float = 0.0  # outlines of the boundary at this many spacings come first; 0: none
    density: np.ndarray | None = None
    directions: str | np.ndarray | None = None
    across: str = "along"
    moves: list[np.ndarray] = field(default_factory=list)
    early: bool = False  # the first movement comes before the first step
    tags: set[str] = field(default_factory=set)


# ------------------------------------------------------------------------------------------------
# Meshes


def _joined(*parts: geometry.Mesh) -> geometry.Mesh:
    starts = np.cumsum([0] + [len(part.vertices) for part in parts])
    return geometry.Mesh(
        np.vstack([part.vertices for part in parts]),
        np.vstack([part.faces + np.uint32(k) for part, k in zip(parts, starts, strict=False)]),
    )


def _turned(part: geometry.Mesh, order: tuple[int, int, int], shift: tuple) -> geometry.Mesh:
    return geometry.Mesh(part.vertices[:, order] + np.array(shift), part.faces)


def _welded(mesh: geometry.Mesh) -> geometry.Mesh:
    """The same with one vertex for all at exactly one place."""
    vertices, index = np.unique(mesh.vertices.round(12), axis=0, return_inverse=True)
    return geometry.Mesh(vertices, index.reshape(-1)[mesh.faces].astype(np.uint32))


def _bow_tie() -> geometry.Mesh:
    """Two squares that share a corner only."""
    square = geometry.grid(4)
    return _welded(_joined(square, _turned(square, (0, 1, 2), (1.0, 1.0, 0.0))))


def _fin() -> geometry.Mesh:
    """A square with another upright along its middle line."""
    square = geometry.grid(6)
    return _welded(_joined(square, _turned(square, (0, 2, 1), (0.0, 0.5, 0.0))))


def _soup(mesh: geometry.Mesh) -> geometry.Mesh:
    corners = np.arange(mesh.faces.size, dtype=np.uint32).reshape(-1, 3)
    return geometry.Mesh(mesh.vertices[mesh.faces].reshape(-1, 3), corners)


SOUND = {
    "sphere": lambda: geometry.icosphere(2),
    "torus": lambda: geometry.torus(18, 10),
    "square": lambda: geometry.grid(7),
    "cube": geometry.cube,
    "two spheres": lambda: _joined(
        geometry.icosphere(1), _turned(geometry.icosphere(2), (0, 1, 2), (3.0, 0, 0))
    ),
}
FAULTY = {"bow-tie": _bow_tie, "fin": _fin, "soup": lambda: _soup(geometry.grid(5))}


def _area(mesh: geometry.Mesh) -> float:
    return float(geometry.triangle_areas(*mesh).sum())


def _bent(points: np.ndarray, amount: float) -> np.ndarray:
    x, y, z = points.T
    away = np.stack([0.3 * np.sin(2 * y), 0.3 * np.sin(2 * z + x), 0.4 * np.sin(3 * x)], axis=1)
    return points * (1.0 + 0.3 * amount) + amount * away


# ------------------------------------------------------------------------------------------------
# Drawing


def _draw_seed(random: np.random.Generator, mesh: geometry.Mesh, r: float, tags: set) -> core.Seed:
    """Strokes and loops about random points, some of them guides, some fixed in places."""
    lines, closed, guides, fixed = [], [], [], []
    if random.random() < 0.3:
        tags.add("network")  # long guides from vertex to vertex, which cross or miss each other
        for _ in range(int(random.integers(1, 4))):
            ends = mesh.vertices[random.choice(mesh.faces.ravel(), 3)]
            lines.append(ends if random.random() < 0.5 else ends[:2])
            closed.append(len(lines[-1]) == 3 and bool(random.random() < 0.5))
            guides.append(True)
            fixed.append(np.zeros(len(lines[-1]), dtype=np.uint8))
    places = geometry.sample_surface(mesh, 600, int(random.integers(1 << 30)))
    taken = np.empty((0, 3))
    for k in range(int(random.integers(0 if lines else 1, 5))):
        centre = places[k]
        if len(taken) and np.linalg.norm(taken - centre, axis=1).min() < 8 * r:
            continue
        taken = np.vstack([taken, centre])
        near = places[np.linalg.norm(places - centre, axis=1) < 3 * r]
        is_guide = bool(random.random() < 0.3)
        is_closed = bool(random.random() < 0.5)
        if is_closed and len(near) >= 6:
            flat = near - centre
            axes = np.linalg.svd(flat, full_matrices=False)[2][:2]
            angles = np.linspace(0, 2 * np.pi, 7)[:-1]
            circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
            line = centre + 0.8 * r * circle @ axes
        elif len(near) >= 2:
            is_closed = False
            line = np.stack([centre, near[np.linalg.norm(near - centre, axis=1).argmax()]])
        else:
            continue
        lines.append(line)
        closed.append(is_closed)
        guides.append(is_guide)
        held = np.zeros(len(line), dtype=np.uint8)
        if random.random() < 0.5:
            held[:: int(random.integers(1, 3))] = 1
            tags.add("fixed")
        fixed.append(held)
        tags.add("guide" if is_guide else "closed" if is_closed else "open")
    if not lines:
        return None
    loops = bool(random.random() < 0.5) or all(guides)
    if loops:
        tags.add("loops")
    return core.Seed(
        np.vstack(lines),
        np.cumsum([0] + [len(line) for line in lines]).astype(np.uint32),
        np.array(closed, dtype=np.uint8),
        np.concatenate(fixed),
        np.array(guides, dtype=np.uint8),
        loops,
    )


def _draw_options(random: np.random.Generator, r: float, tags: set) -> core.FlowOptions:
    options = core.default_options(str(random.choice(["even", "even", "paper", "finest"])))
    options.radius = r
    tags.add(options.preset)

    def draw(tag: str, share: float) -> bool:
        drawn = bool(random.random() < share)
        if drawn:
            tags.add(tag)
        return drawn

    if draw("geodesic", 0.4):
        options.medial_axis = core.MedialAxis.GEODESIC
    if draw("weights", 0.3):
        options.length_weight = float(random.choice([0.0, 0.5, 2.0, 10.0]))
        options.bending_weight = float(random.choice([0.0, 0.3, 2.0, 10.0]))
    if draw("length power", 0.3):
        options.length_power = float(random.uniform(1.5, 8))
    if draw("medial power", 0.3):
        options.medial_power = float(random.uniform(2, 8))
    if draw("r_max", 0.3):
        options.max_radius = float(random.choice([1.5, 2.0, 4.0, 20.0])) * r
    if draw("h", 0.3):
        options.segment_length = float(random.choice([0.12, 0.3, 0.5, 1.0])) * r
    if draw("step", 0.2):
        options.step = float(random.choice([0.1, 0.5, 2.0]))
    if draw("start spacing", 0.25):
        options.start_spacing_factor = float(random.choice([1.5, 3.0, 8.0]))
    if draw("border distance", 0.3):
        options.boundary_distance = float(random.choice([0.0, 0.25, 1.0, 2.0]))
        options.boundary_rule = core.BoundaryRule.CENTRE
    if draw("obstacle", 0.08):  # refused with a border distance other than the usual
        options.boundary_rule = core.BoundaryRule.OBSTACLE
    if draw("hairpin removal", 0.3):
        options.hairpin_removal_iterations = 3
        options.tunings["hairpin_removal_gentleness"] = 0.5
    if draw("no polish", 0.15):
        options.polish = False
    return options


def _unmasked(mesh: geometry.Mesh, preparation: core.SurfaceOptions) -> geometry.Mesh:
    """The faces that are in as a whole; all where there are none."""
    whole = np.ones(len(mesh.faces), dtype=bool)
    if preparation.face_mask is not None:
        whole &= preparation.face_mask
    if preparation.vertex_mask is not None:
        whole &= (preparation.vertex_mask >= preparation.mask_threshold)[mesh.faces].all(axis=1)
    return geometry.Mesh(mesh.vertices, mesh.faces[whole]) if whole.any() else mesh


def _middle_and_extent(mesh: geometry.Mesh) -> tuple[np.ndarray, float]:
    middle = (mesh.vertices.min(axis=0) + mesh.vertices.max(axis=0)) / 2
    return middle, float(np.ptp(mesh.vertices, axis=0).max())


def _draw_mesh(
    random: np.random.Generator, preparation: core.SurfaceOptions, tags: set[str]
) -> tuple[geometry.Mesh, float]:
    """A mesh and its scale; says how it is to be repaired."""
    faulty = random.random() < 0.35
    kinds = FAULTY if faulty else SOUND
    name = str(random.choice(sorted(kinds)))
    tags.add(name)
    mesh = kinds[name]()
    if random.random() < 0.4:
        mesh = geometry.Mesh(_bent(mesh.vertices, 0.5), mesh.faces)
    if random.random() < 0.15:
        tags.add("crumpled")
        waves = np.sin(7 * mesh.vertices @ random.normal(size=(3, 3)) + random.normal(size=3))
        mesh = geometry.Mesh(mesh.vertices + 0.1 * waves, mesh.faces)
    if random.random() < 0.15:
        tags.add("needles")
        mesh = geometry.Mesh(mesh.vertices * [1.0, 0.1, 1.0], mesh.faces)
    if faulty:
        preparation.merge_distance = 1e-7 if name == "soup" or random.random() < 0.3 else 0.0
        preparation.drop_degenerate = bool(random.random() < 0.5)
        preparation.split_bow_ties = bool(random.random() < 0.9)
        preparation.cut_non_manifold = bool(random.random() < 0.9)
    scale = float(random.choice([1.0, 1.0, 1e-3, 1e4]))
    mesh = geometry.Mesh(mesh.vertices * scale, mesh.faces)
    preparation.merge_distance *= scale
    return mesh, scale


def _draw_masks(
    random: np.random.Generator,
    mesh: geometry.Mesh,
    preparation: core.SurfaceOptions,
    tags: set[str],
) -> None:
    middle, extent = _middle_and_extent(mesh)
    if random.random() < 0.2:
        tags.add("face mask")
        centres = mesh.vertices[mesh.faces].mean(axis=1)
        preparation.face_mask = centres[:, 0] > middle[0] - 0.3 * extent
    if random.random() < 0.3:
        tags.add("vertex mask")
        away = np.linalg.norm(mesh.vertices - middle - [0.2 * extent, 0, 0], axis=1)
        preparation.vertex_mask = away
        preparation.mask_threshold = float(random.uniform(0.1, 0.5)) * extent


def _draw_density(random: np.random.Generator, case: Case, tags: set[str]) -> None:
    if random.random() >= 0.4:
        return
    middle, extent = _middle_and_extent(case.mesh)
    along = (case.mesh.vertices[:, 0] - middle[0]) / extent
    if random.random() < 0.5:
        tags.add("smooth density")
        case.density = np.exp(2.0 * along)
    else:
        tags.add("density jump")
        case.density = np.where(along > 0.1, float(random.choice([4.0, 16.0])), 1.0)


def draw(number: int) -> Case:
    """The case of a number, always the same."""
    random = np.random.default_rng(number)
    tags: set[str] = set()
    preparation = core.SurfaceOptions()
    mesh, scale = _draw_mesh(random, preparation, tags)
    _draw_masks(random, mesh, preparation, tags)
    r = float(np.sqrt(_area(mesh) / (0.56 * random.uniform(250, 1500))))
    case = Case(mesh, preparation, _draw_options(random, r, tags), int(random.integers(10, 26)))
    case.tags = tags
    case.options.radius = r
    if random.random() < 0.7:
        case.seed = _draw_seed(random, _unmasked(mesh, preparation), r, tags)
    if random.random() < 0.2:
        tags.add("outline")
        case.outline = float(random.choice([0.5, 1.0, 1.5]))
    _draw_density(random, case, tags)
    if random.random() < 0.35:
        tags.add("alignment")
        case.options.alignment_weight = float(random.choice([0.3, 1.0, 5.0]))
        case.across = str(random.choice(core.ALIGNMENTS))
        case.directions = str(random.choice(core.DIRECTIONS))
        if random.random() < 0.3:
            case.directions = random.normal(size=mesh.vertices.shape)
            case.directions[::3] = 0.0
            case.directions[1::7] = np.nan
    if random.random() < 0.35:
        tags.add("deformation")
        unit = mesh.vertices / scale
        case.moves = [scale * _bent(unit, amount) for amount in random.uniform(-0.5, 0.5, 3)]
        case.early = bool(random.random() < 0.3)
    return case


# ------------------------------------------------------------------------------------------------
# Running and checking


def _put_first(outline: core.Seed, seed: core.Seed | None) -> core.Seed | None:
    if len(outline.closed) == 0:
        return seed
    if seed is None:
        return outline
    return core.Seed(
        np.vstack([outline.points, seed.points]),
        np.concatenate([outline.offsets, seed.offsets[1:] + len(outline.points)]),
        np.concatenate([outline.closed, seed.closed]),
        np.concatenate([np.zeros(len(outline.points), dtype=np.uint8), seed.fixed]),
        np.concatenate([outline.guides, seed.guides]),
        seed.loops,
    )


@dataclass
class State:
    """A curve at one moment, and where the vertices were."""

    vertices: np.ndarray
    curve: core.Polylines
    nodes: core.Nodes
    points: core.PointData
    gaps: core.Gaps
    figures: dict
    guides: np.ndarray


def _state(flow: core.Flow, vertices: np.ndarray) -> State:
    parts = flow.polylines(), flow.nodes(), flow.point_data(), flow.gaps()
    return State(vertices, *parts, flow.statistics(), flow.guides())


def run(case: Case, threads: int) -> tuple[core.Seed | None, list[State]]:
    """The states at the start, before every movement, and at the end."""
    mesh = case.mesh
    case.options.threads = threads
    with core.Surface(mesh.vertices, mesh.faces, case.preparation) as surface:
        seed = case.seed
        if case.outline:
            r = case.options.radius
            seed = _put_first(surface.outlines(2 * case.outline * r, 2 * r)[0], seed)
        flow = core.Flow(surface, case.options, seed, case.density)
        with flow:
            if case.directions is not None:
                directions = case.directions
                if isinstance(directions, str):
                    directions = surface.directions(directions)
                flow.set_directions(directions, case.across)
            vertices = case.moves[0] if case.moves and case.early else mesh.vertices
            if vertices is not mesh.vertices:
                flow.set_vertices(vertices)
            states = [_state(flow, vertices)]
            for _ in range(case.iterations):
                flow.step()
            states.append(_state(flow, vertices))
            for vertices in case.moves:
                flow.set_vertices(vertices)
                states.append(_state(flow, vertices))
                for _ in range(3):
                    flow.step()
                states.append(_state(flow, vertices))
    return seed, states


def _fixed_places(case: Case, state: State) -> np.ndarray:
    """Where the fixed nodes are on the mesh as it was at first."""
    held = state.nodes.fixed.astype(bool)
    return geometry.points_at(case.mesh, state.nodes.faces[held], state.nodes.barycentrics[held])


def check_fixed(case: Case, first: State, state: State, near: float) -> None:
    """Fixed nodes stay. Where the surface has stretched, guides have more, on the lines drawn."""
    before, after = _fixed_places(case, first), _fixed_places(case, state)
    if state.vertices is first.vertices or not first.guides.any():
        assert before.shape == after.shape
    added = []
    left = iter(before)
    wanted = next(left, None)
    for place in after:
        if wanted is not None and np.abs(place - wanted).max() <= near:
            wanted = next(left, None)
        else:
            added.append(place)
    assert wanted is None
    if not added:
        return
    line = geometry.points_at(case.mesh, first.points.faces, first.points.barycentrics)
    strand = np.repeat(np.arange(len(first.curve.closed)), np.diff(first.curve.offsets.astype(int)))
    pieces = geometry.pieces_of(first.curve.offsets, first.curve.closed)
    start, end = line[pieces[first.guides[strand[pieces[:, 0]]]]].swapaxes(0, 1)
    assert geometry.distance_to_pieces(np.array(added), start, end).max() <= near


def check(case: Case, seed: core.Seed | None, states: list[State]) -> None:
    first = states[0]
    extent = np.ptp(case.mesh.vertices, axis=0).max()
    if seed is not None:
        count = len(seed.closed)
        assert first.curve.closed[:count].tolist() == seed.closed.tolist()
        assert first.guides[:count].tolist() == seed.guides.astype(bool).tolist()
        assert first.curve.closed[count:].all() and not first.guides[count:].any()
        assert seed.loops or len(first.curve.closed) == count
    for state in states:
        curve = state.curve
        surface = geometry.Mesh(state.vertices, case.mesh.faces)
        for values in (*curve, *state.nodes, *state.points, state.gaps.positions, state.gaps.sizes):
            assert np.isfinite(values).all()
        rebuilt = geometry.points_at(surface, state.points.faces, state.points.barycentrics)
        assert np.abs(rebuilt - curve.positions).max() < 1e-9 * extent
        if len(state.gaps):
            assert geometry.off_surface(surface, state.gaps.positions).max() < 1e-9 * extent
        assert state.figures["crossings"] == 0
        assert geometry.off_surface(surface, curve.positions).max() < 1e-9 * extent
        assert np.abs(state.nodes.barycentrics.sum(axis=1) - 1).max() < 1e-12
        assert state.nodes.barycentrics.min() > -1e-9
        strand = np.repeat(np.arange(len(curve.closed)), np.diff(curve.offsets.astype(int)))
        pieces = geometry.pieces_of(curve.offsets, curve.closed)
        owner = strand[pieces[:, 0]]
        length = np.linalg.norm(np.subtract(*curve.positions[pieces.T]), axis=1)
        for one, other in geometry.crossings(surface, curve.positions, curve.offsets, curve.closed):
            # Of a piece this short, past a vertex, positions do not tell which face it is in; nor
            # whether its two neighbours meet, which could cross nowhere else: they are straight.
            between = length[min(one, other) + 1 : max(one, other)].sum()
            joined = owner[one] == owner[other] and between <= 1e-9 * extent
            if joined or min(length[one], length[other]) <= 1e-9 * extent:
                continue
            # Only guides may cross guides.
            assert state.guides[owner[one]] and state.guides[owner[other]]
        assert curve.closed.tolist() == first.curve.closed.tolist()
        assert state.guides.tolist() == first.guides.tolist()
        if case.preparation.face_mask is not None:
            assert case.preparation.face_mask[state.nodes.faces].all()
        if case.preparation.vertex_mask is not None:
            # The edge of the mask may move to a vertex that it passes within a tenth of an edge.
            corners = case.preparation.vertex_mask[case.mesh.faces]
            level = np.sum(corners[state.nodes.faces] * state.nodes.barycentrics, axis=1)
            slack = 0.1001 * np.ptp(corners, axis=1).max()
            assert level.min() > case.preparation.mask_threshold - slack
        check_fixed(case, first, state, 1e-7 * extent)
        if state.vertices is case.mesh.vertices:
            for k in np.flatnonzero(first.guides):
                old, new = (
                    s.curve.positions[s.curve.offsets[k] : s.curve.offsets[k + 1]]
                    for s in (first, state)
                )
                assert np.array_equal(old, new)


def same(one: list[State], other: list[State]) -> None:
    for a, b in zip(one, other, strict=True):
        for x, y in zip((*a.curve, *a.nodes), (*b.curve, *b.nodes), strict=True):
            assert x.tobytes() == y.tobytes()


def outcome(number: int) -> str:
    """Draws, runs and checks; gives the sentence of a refusal, or nothing."""
    case = draw(number)
    try:
        seed, states = run(case, 1)
    except core.MeanderError as refusal:
        assert refusal.status in (
            core.Status.INVALID_ARGUMENT,
            core.Status.INVALID_MESH,
            core.Status.INVALID_SEED,
        )
        assert_sentence(str(refusal))
        with pytest.raises(core.MeanderError) as again:
            run(case, 3)
        assert str(again.value) == str(refusal)
        return str(refusal)
    check(case, seed, states)
    same(states, run(case, 3)[1])
    return ""


# Chosen to be quick and to have, together, everything that `draw` knows; any other number will do.
NUMBERS = [
    125,
    139,
    144,
    155,
    162,
    176,
    180,
    184,
    1095,
    1108,
    1126,
    1146,
    1148,
    1150,
    1160,
    1163,
    1166,
    1174,
    1179,
    1194,
]
REFUSED = [102, 126, 128, 147, 183]  # the last: parallel to the boundary of what has none


def test_the_numbers_draw_everything() -> None:
    drawn = set().union(*(draw(number).tags for number in NUMBERS))
    assert not {*SOUND, *FAULTY, *core.PRESETS} - drawn
    assert not {"outline", "network", "guide", "loops", "fixed", "open", "closed"} - drawn
    assert not {"vertex mask", "face mask", "crumpled", "needles", "deformation"} - drawn
    assert not {"geodesic", "alignment", "smooth density", "density jump", "r_max", "h"} - drawn
    assert not {"border distance", "start spacing", "length power", "medial power"} - drawn


@pytest.mark.parametrize("number", NUMBERS)
def test_everything_together(number: int) -> None:
    assert not outcome(number)


@pytest.mark.parametrize("number", REFUSED)
def test_what_cannot_be_together_is_refused(number: int) -> None:
    assert outcome(number)
