# SPDX-License-Identifier: GPL-3.0-or-later
"""Every sentence of the native library comes up, or has a reason why none can make it here.

Most are said of one argument: every function of the header is called with all arguments right and
one of them wrong, each in turn, by the prototypes that are made from the header. The others have
tries of their own, by arrays and structs.
"""

from __future__ import annotations

import contextlib
import ctypes
from ctypes import byref, c_size_t, c_void_p
from dataclasses import replace
from pathlib import Path
from typing import Any

import geometry
import numpy as np
import pytest
from flows import options_of
from meander import core
from meander.binding import abi, files
from meander.binding.calls import prepared
from meander.binding.native_library import native
from said_sentences import native_sentences
from sentences import assert_sentence

ROOM = 20_000
VERTICES, FACES = geometry.grid(6)

# A part of the sentence, and why it does not come up here.
ELSEWHERE = {
    "please report": "a defect, which no input is known to make",
    "was cancelled": "tests/native/test_cancel.cpp",
    "gives no thread for the run": "needs a system without threads: test_out_of_memory.cpp",
    "has no threads of its own": "a build without threads: cmake/web.cmake",
    "too many edges to be refined": "needs 2^32 half-edges",
    "would have to be refined too far": "the same",
    "would have more than 200 million vertices": "needs as many",
    " has no area; dissolve degenerate faces.": "a face that the exact check lets through, and "
    "whose corners rounding puts on a line",
    "more than 2^30 points; thin": "an array of 24 GB",
    "grown so large that the curve": "needs more than 500 million nodes: test_deformation.cpp",
}


def pools(surface: int, flow: int, running: int) -> dict[str, list[Any]]:
    """What each argument may be, by its name: right first, then wrong."""
    corners = FACES.astype(np.uint32)
    strokes = np.array([(0.1, 0.1, 0.0), (0.9, 0.2, 0.0), (0.5, 0.7, 0.0)])
    nowhere = strokes.copy()
    nowhere[1, 1] = np.nan
    ends = [np.array(rows, dtype=np.uint64) for rows in ([0, 3], [1, 3], [0, 4], [3, 1], [2, 3])]
    count = len(VERTICES)
    turns = np.ones(count)
    wild = turns.copy()
    wild[3] = np.nan
    wrong_mesh = corners.copy()
    wrong_mesh[2] = 4
    return {
        "surface": [surface, None],
        "flow": [flow, None, running],
        "context": [None],
        "vertices": [VERTICES, None, np.full_like(VERTICES, np.nan)],
        "vertex_count": [count, count - 1, 2**31],
        "faces": [corners, None],
        "face_count": [len(FACES), 2**31],
        "points": [strokes, None, nowhere],
        "point_count": [3, 2, 2**31], "threads": [1, 257],
        "offsets": [ends[0], None, *ends[1:]],
        "stroke_count": [1, 0],
        "corners": [corners, None],
        "corner_count": [corners.size, 3],
        "ends": [np.arange(3, corners.size + 1, 3, dtype=np.uint64), None,
                 np.zeros(len(FACES), dtype=np.uint64)],
        "polygon_count": [len(FACES), 2**31],
        "directions": [np.ones((count, 3)), None, np.full((count, 3), np.inf),
                       np.zeros((count, 3))],
        "angles": [turns, None, wild],
        "density": [None, turns, wild],
        "density_count": [0, count],
        "kind": [0, 77], "curvature": [0, 77], "alignment": [0, 77],
        "smoothing": [0.0, -1.0, np.nan], "weld_distance": [0.0, -1.0],
        "tolerance": [0.02, -1.0, np.nan],
        "distance": [0.1, -1.0], "spacing": [0.2, -1.0, np.nan], "detail": [0.0, -1.0],
        "radius": [0.1, -1.0, 99.0], "least_size": [0.0], "middle_lines": [0], "index": [0],
        "text": [b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", None],
        "pattern": [b"%d %.3r\n", b"%s %d", b"none", None],
        "row_count": [2, 2**63], "column_count": [2, 1],
        "size": [32], "side": [4, 0, 40000], "margin": [1],
        "nearest": [np.full(16, -1, dtype=np.int32), None],
        "parts": [1, 99],
        "name": [b"polish_length_gain", b"nothing", None], "value": [1.0, -1.0, np.nan],
        "length_step": [0.1, -1.0, np.nan], "point_limit": [100],
        "record_size": [ctypes.sizeof(abi.IterationRecord), 1],
        "seed": [None, prepared(abi.SeedRecord)],
    }  # fmt: skip


def choices_of(function: str, pool: dict[str, list[Any]]) -> list[tuple[str, list[Any]]]:
    """The arguments of a function of the header but for the error, each with what it may be."""
    kinds = abi.PROTOTYPES[function][1][:-1]
    choices = []
    for name, kind in zip(NAMES[function], kinds, strict=True):
        if kind is ctypes.POINTER(c_size_t) or kind is ctypes.POINTER(c_void_p):
            choices.append((name, ["out", None]))
        elif "capacity" in name:
            choices.append((name, [ROOM]))
        elif isinstance(getattr(kind, "_type_", None), type) and name != "text":
            record = kind._type_
            made = prepared(record, 0) if record is abi.FlowOptionsRecord else None
            if record is not abi.IterationRecord and made is None:
                made = prepared(record)
            if made is None:
                choices.append((name, [(record * ROOM)(), None]))
                continue
            if record is abi.FlowOptionsRecord:
                made.radius = 0.1
            short, unknown = record.from_buffer_copy(made), record.from_buffer_copy(made)
            short.struct_size = 3
            if hasattr(unknown, "reserved"):
                unknown.reserved[len(unknown.reserved) - 1] = 5
            right = None if record is abi.SeedRecord else made
            choices.append((name, [right, None, made, short, unknown]))
        elif name in pool and not (kind is c_void_p and name in IS_OUTPUT.get(function, ())):
            choices.append((name, pool[name]))
        else:
            choices.append((name, ["room", None]))
    return choices


def names_of_header() -> dict[str, list[str]]:
    """The names of the arguments of every function, which the prototypes have as comments."""
    lines = Path(abi.__file__).read_text(encoding="utf-8").splitlines()
    found: dict[str, list[str]] = {}
    current = ""
    for line in lines[lines.index(next(x for x in lines if x.startswith("PROTOTYPES"))) :]:
        text = line.strip()
        if text.startswith('"meander_'):
            current = text.split('"')[1]
            found[current] = []
        elif "  # " in text and current:
            found[current].append(text.split("  # ")[1])
    return {name: each[:-1] for name, each in found.items() if each[-1:] == ["error"]}


NAMES = names_of_header()
IS_OUTPUT = {
    "meander_flow_options_get_tuning": ("value",),
    "meander_map_find_pixels": ("nearest",),
    "meander_surface_compute_directions": ("directions",),
    "meander_surface_compute_stroke_directions": ("directions",),
    "meander_text_write_rows": ("text",),
}


def called(function: str, values: list[Any], kept: list[Any]) -> str:
    """What a function says; `kept` holds what must live as long as what it made."""
    error = prepared(abi.ErrorRecord)
    given: list[Any] = []
    for value, kind in zip(values, abi.PROTOTYPES[function][1], strict=False):
        if isinstance(value, str) and value == "out":
            made = kind._type_()
            kept.append(made)
            given.append(byref(made))
        elif isinstance(value, str) and value == "room":
            room = np.zeros(ROOM * 9 + 64)
            kept.append(room)
            given.append(room.ctypes.data)
        elif isinstance(value, np.ndarray):
            copy = np.ascontiguousarray(value).copy()
            kept.append(copy)
            given.append(copy.ctypes.data)
        elif isinstance(value, ctypes.Structure):
            copy = type(value).from_buffer_copy(value)
            kept.append(copy)
            given.append(byref(copy))
        else:
            given.append(value)
    status = getattr(native(), function)(*given, byref(error))
    return error.text.decode("utf-8") if status else ""


@pytest.fixture(scope="module")
def said() -> list[str]:
    found: list[str] = []
    with contextlib.ExitStack() as stack:
        found += swept(stack)
        found += tried()
    return [text for text in found if text]


def swept(stack: contextlib.ExitStack) -> list[str]:
    options = options_of(radius=0.1)
    surface = stack.enter_context(core.Surface(VERTICES, FACES))
    fresh = stack.enter_context(core.Flow(surface, options))
    done = stack.enter_context(core.Flow(surface, options))
    done.run()
    running = stack.enter_context(core.Flow(surface, options))
    running.start()
    stack.callback(running.wait)
    found = []
    for function in NAMES:
        flow = fresh if function.endswith("set_directions") else done
        if function in ("meander_flow_wait", "meander_flow_start", "meander_flow_run"):
            flow = fresh if function == "meander_flow_wait" else done
        pool = pools(surface._alive(), flow._alive(), running._alive())
        choices = choices_of(function, pool)
        right = [values[0] for _name, values in choices]
        kept: list[Any] = []
        for position, (_name, values) in enumerate(choices):
            for value in values[1:]:
                wrong = [*right[:position], value, *right[position + 1 :]]
                if "start" in function or "wait" in function and value is not None:
                    continue
                found.append(called(function, wrong, kept))
    found.append(called("meander_flow_wait", [fresh._alive()], []))
    return found + structs(surface._alive()) + openings(surface._alive())


def openings(surface: int) -> list[str]:
    """What is said where nothing is going on in the background, and where something is."""
    opening, extent = c_void_p(), prepared(abi.ExtentRecord)
    assert called("meander_opening_create", [byref(opening)], []) == ""
    start = [opening, surface, None, 0, byref(extent), None]
    found = [called("meander_opening_wait", [opening], [])]
    assert called("meander_opening_start_extent", start, []) == ""
    found.append(called("meander_opening_start_extent", start, []))
    native().meander_opening_destroy(opening)
    return found


def structs(surface: int) -> list[str]:
    """What is said of single fields of structs, which Python's own checks keep from the library."""
    options = prepared(abi.FlowOptionsRecord, 0)
    options.radius = 0.1
    kept: list[Any] = []

    def changed(record: ctypes.Structure, **fields: Any) -> ctypes.Structure:
        copy = type(record).from_buffer_copy(record)
        for name, value in fields.items():
            setattr(copy, name, value)
        return copy

    points = np.array([(0.1, 0.5, 0.0), (0.9, 0.5, 0.0)])
    arrays = (points, np.array([0, 2], dtype=np.uint64), np.zeros(1, dtype=np.uint8))
    pointers = dict(zip(("points", "offsets", "closed"), (a.ctypes.data for a in arrays)))
    seed = changed(prepared(abi.SeedRecord), point_count=2, strand_count=1, **pointers)
    extent, cost = prepared(abi.ExtentRecord), prepared(abi.CostRecord)
    mask = np.ones(3, dtype=np.uint8)
    masked = changed(
        prepared(abi.SurfaceOptionsRecord), face_mask=mask.ctypes.data, face_mask_count=3
    )
    corners = FACES.astype(np.uint32)
    mesh = [VERTICES, len(VERTICES), corners, len(corners)]
    falling = np.array([0, 3, 2], dtype=np.uint64)
    strokes = np.zeros((2, 3))
    found = [
        called("meander_flow_create", [surface, changed(seed, **wrong), None, 0, options, "out",
                                       None], kept)
        for wrong in ({"strand_count": 0}, {"points": None}, {"fill_regions": 9},
                      {"max_distance": -1.0})
    ]  # fmt: skip
    found += [
        called("meander_flow_create", [surface, None, None, 0, changed(options, **wrong), "out",
                                       None], kept)
        for wrong in ({"preset": 77}, {"boundary_rule": 1, "boundary_distance": 1.0})
    ]  # fmt: skip
    found.append(called("meander_extent_estimate_cost",
                        [changed(extent, node_area=-1.0), options, cost], kept))  # fmt: skip
    found.append(called("meander_surface_create", [*mesh, masked, "out", None], kept))
    found.append(called("meander_surface_compute_stroke_directions",
                        [surface, strokes, 2, falling, 2, "room", len(VERTICES), None],
                        kept))  # fmt: skip
    return found


def tried() -> list[str]:
    """By arrays, through the Python package."""
    found: list[str] = []

    def refused(call) -> None:
        try:
            call()
        except core.MeanderError as refusal:
            found.append(str(refusal))

    def surface_of(vertices=VERTICES, faces=FACES, **options) -> None:
        given = core.SurfaceOptions(**options)
        refused(lambda: core.Surface(vertices, faces, given).close())

    def flow_of(seed=None, density=None, on=(VERTICES, FACES), **changes) -> None:
        options = options_of(**{"radius": 0.1} | changes)

        def open_it() -> None:
            with core.Surface(*on) as surface, core.Flow(surface, options, seed, density) as flow:
                flow.step()

        refused(open_it)

    square = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], dtype=float)
    pair = np.array([(0, 1, 2), (0, 2, 3)], dtype=np.uint32)
    strict = {"weld_distance": 0.0}
    nan = square.copy()
    nan[1, 2] = np.nan
    surface_of(nan, pair)
    surface_of(square, [(0, 1, 1)])
    surface_of(square, [(0, 1, 9)])
    surface_of(square, np.zeros((0, 3), dtype=np.uint32))
    surface_of(np.zeros((3, 3)), [(0, 1, 2)])
    surface_of(1e300 * square, pair)
    line = np.array([(0, 0, 0), (1, 0, 0), (2, 0, 0)], dtype=float)
    surface_of(line, [(0, 1, 2)])
    surface_of(line, [(0, 1, 2)], make_manifold=True, drop_degenerate=True)
    surface_of(line, [(0, 1, 2)], drop_degenerate=True)
    surface_of(line, [(0, 1, 2)], vertex_mask=np.ones(3))
    fin = np.vstack([square, [(0.5, 0.5, 1.0)]])
    surface_of(fin, [(0, 1, 2), (0, 2, 3), (0, 2, 4)], **strict)
    surface_of(*geometry.moebius(), **strict)
    bow = np.array([(0, 0, 0), (1, 1, 0), (1, -1, 0), (-1, 1, 0), (-1, -1, 0)], dtype=float)
    surface_of(bow, [(0, 1, 2), (0, 3, 4)], **strict)
    count = len(VERTICES)
    surface_of(face_mask=np.ones(3, dtype=bool))
    surface_of(face_mask=np.zeros(len(FACES), dtype=bool))
    surface_of(vertex_mask=np.zeros(count), mask_threshold=0.5)
    surface_of(vertex_mask=np.full(count, np.nan))
    surface_of(vertex_mask=np.ones(count), mask_threshold=np.nan)
    surface_of(merge_distance=-1.0)
    surface_of(merge_distance=9.0)
    for scale in (1e160, 1e200, 1e300):
        surface_of(scale * VERTICES, FACES, make_manifold=True, drop_degenerate=True)
    surface_of(line, [(0, 1, 2)], make_manifold=True, drop_degenerate=True)
    surface_of(weld_distance=-1.0)
    surface_of(smallest_part=-1.0)
    surface_of(smallest_part=99.0)

    for name, value in (
        ("radius", -1.0), ("radius", 9.0), ("stop_rule", 9), ("boundary_rule", 9),
        ("medial_axis", 9), ("start", 9), ("iteration_limit", 0), ("threads", 999),
        ("polish", 7), ("step", -1.0), ("radius", 1e-6),
    ):  # fmt: skip
        flow_of(**{name: value})
    flow_of(radius=0.6)
    flow_of(boundary_distance=1.0, boundary_rule=core.BoundaryRule.OBSTACLE)
    flow_of(density=np.full(count, 1e-9))
    flow_of(density=np.ones(3))
    flow_of(density=np.zeros(count))
    flow_of(density=np.geomspace(1.0, 1e6, count))
    flow_of(density=np.full(count, 1e12))

    def seed(points, offsets, closed, **more) -> core.Seed:
        return core.Seed(np.array(points, dtype=float), offsets, closed, **more)

    across = [(0.1, 0.5, 0.0), (0.9, 0.5, 0.0)]
    flow_of(seed([(0.1, 0.5, 9.0), (0.9, 0.5, 9.0)], [0, 2], [0]))
    flow_of(seed([(0.1, np.nan, 0.0), (0.9, 0.5, 0.0)], [0, 2], [0]))
    flow_of(seed(across[:1] * 2, [0, 2], [0]))
    flow_of(seed(across, [0, 2], [0], guides=[1]))
    apart = np.vstack([VERTICES, VERTICES + (5.0, 0, 0)])
    two = np.vstack([FACES, FACES + count])
    flow_of(seed([(0.1, 0.5, 0.0), (5.9, 0.5, 0.0)], [0, 2], [0]), on=(apart, two))
    ring = [(0.5 + 0.2 * np.cos(t), 0.5 + 0.2 * np.sin(t), 0) for t in np.linspace(0, 6, 24)]
    flow_of(seed([*ring, (0.5, 0.5, 0), (0.9, 0.9, 0)], [0, 24, 26], [1, 0], guides=[1, 0]))
    dense = [(x, y, 0.0) for x in np.linspace(0.02, 0.98, 40) for y in (0.02, 0.98)]
    flow_of(seed([*ring, (0.5, 0.52, 0), (0.52, 0.95, 0)], [0, 24, 26], [1, 0], guides=[1, 0],
                 fixed=[0] * 24 + [1, 1]))  # fmt: skip
    flow_of(seed(dense, list(range(0, 82, 2)), [0] * 40, guides=[1] * 40, loops=True))

    options = options_of(radius=0.1)
    with core.Surface(VERTICES, FACES) as surface, core.Flow(surface, options) as flow:
        flow.step()
        refused(lambda: flow.set_directions(np.ones((count, 3))))
        refused(lambda: flow.set_vertices(1e-3 * VERTICES))
        refused(lambda: flow.set_vertices(VERTICES[:3]))
        folded = VERTICES.copy()
        folded[:] = folded[0]
        folded[::2] += (1.0, 0.0, 0.0)
        refused(lambda: flow.set_vertices(folded))
    with core.Surface(VERTICES, FACES) as surface, core.Flow(surface, options) as flow:
        refused(lambda: flow.set_directions(np.tile((0.0, 0.0, 1.0), (count, 1))))
    with core.Surface(VERTICES, FACES) as surface, core.Flow(surface, options) as flow:
        flow.step()
        cut = core.cut_surface(flow)
    place, weights = np.zeros(1, dtype=np.int32), np.ones((1, 3), dtype=np.float32) / 3
    for wrong in (
        {"faces": cut.faces + len(cut.positions)},
        {"offsets": cut.offsets + len(cut.line_vertices)},
        {"line_strands": cut.line_strands + 2**31},
    ):
        bad = replace(cut, **wrong)
        refused(lambda bad=bad: core.cut_places(bad, 0.2, place, weights))
    refused(lambda: core.cut_places(cut, 0.2, place + len(cut.faces), weights))
    refused(lambda: core.cut_places(cut, 0.2, place, weights * np.float32(np.nan)))
    for text in (b"v 0 0\n", b"v 0 0 0\nf 1 2 x\n"):
        refused(lambda text=text: files.read_polygons(text, abi.Text.OBJ_FACES))
    refused(lambda: files.read_polygons(b"vertex 0 0 0\nvertex 1 0 0\n", abi.Text.STL))
    return found


def test_every_sentence_comes_up(said: list[str]) -> None:
    table = native_sentences()
    missing = [
        f"{sentence.place}: {sentence.text!r}"
        for sentence in table
        if not any(sentence.pattern.search(line) for line in said)
        and not any(part in sentence.text for part in ELSEWHERE)
    ]
    assert missing == [], "\n".join(missing)
    assert len(table) > 100


def test_each_is_one_sentence(said: list[str]) -> None:
    for line in set(said):
        assert_sentence(line)


def test_every_reason_is_of_a_sentence() -> None:
    texts = [sentence.text for sentence in native_sentences()]
    assert [part for part in ELSEWHERE if not any(part in text for text in texts)] == []
