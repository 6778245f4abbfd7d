# SPDX-License-Identifier: GPL-3.0-or-later
"""Paths for tools: resampling against its definition, files against the curve."""

from __future__ import annotations

import csv
import json

import geometry
import numpy as np
import pytest
from flows import flow_on
from meander import core
from meander.model.files import whole as whole_files
from meander.model.toolpaths import toolpath


def _polylines():
    """A wavy closed strand on a cylinder, an open one, and a straight one of two points."""
    angle = np.linspace(0.0, 2.0 * np.pi, 400, endpoint=False)
    ring = np.column_stack([np.cos(angle), np.sin(angle), 0.3 * np.sin(7.0 * angle)])
    rise = np.linspace(0.0, 3.0, 150) ** 1.3
    helix = np.column_stack([np.cos(rise), np.sin(rise), 1.0 + 0.2 * rise])
    line = np.array([[1.0, 0.0, 5.0], [1.0, 0.0, 6.0]])
    points = np.vstack([ring, helix, line])
    normals = points * [1.0, 1.0, 0.0]
    return core.Polylines(
        points,
        normals / np.linalg.norm(normals, axis=1)[:, None],
        np.array([0, 400, 550, 552], dtype=np.uint32),
        np.array([1, 0, 0], dtype=np.uint8),
    )


@pytest.mark.parametrize("step", [0.011, 0.1, 0.37, 100.0])
def test_steps_are_equal_and_on_the_polyline(step):
    strands = toolpath.strands_of(_polylines())
    for whole, strand in zip(strands, toolpath.resampled(strands, step=step), strict=True):
        assert strand.closed == whole.closed
        way = np.vstack([whole.points, whole.points[: whole.closed]])
        assert geometry.farthest(strand.points, way) < 1e-12
        arc_lengths = strand.arc_lengths
        if strand.closed:
            arc_lengths = np.append(arc_lengths, strand.length)
        gaps = np.diff(arc_lengths)
        assert np.allclose(gaps, gaps[0])
        assert gaps[0] <= step * (1.0 + 1e-9)
        least = 3 if strand.closed else 1
        assert len(gaps) == least or gaps[0] > step / 2
        assert np.array_equal(strand.points[0], whole.points[0])
        if not strand.closed:
            assert np.allclose(strand.points[-1], whole.points[-1])
        assert np.allclose(np.linalg.norm(strand.normals, axis=1), 1.0)
        assert np.allclose(np.linalg.norm(strand.tangents, axis=1), 1.0)


@pytest.mark.parametrize("tolerance", [1e-9, 1e-3, 0.02, 0.2, 10.0])
def test_chords_stay_within_the_tolerance(tolerance):
    counts = []
    for whole, strand in zip(
        toolpath.strands_of(_polylines()),
        toolpath.resampled(toolpath.strands_of(_polylines()), tolerance=tolerance),
        strict=True,
    ):
        kept = np.searchsorted(whole.arc_lengths, strand.arc_lengths)
        assert np.array_equal(whole.points[kept], strand.points)
        # Every point left out, against the chord of its own stretch.
        ends = np.append(kept[1:], len(whole.points) if strand.closed else kept[-1])
        ring = np.vstack([whole.points, whole.points[:1]])
        for begin, end in zip(kept, ends):
            if end - begin > 1:
                off = geometry.farthest(ring[begin : end + 1], ring[[begin, end]])
                assert off <= tolerance * (1 + 1e-9)
        assert len(strand.points) >= (3 if strand.closed else 2)
        counts.append(len(strand.points))
    if tolerance >= 0.02:
        assert sum(counts) < 80


def test_all_points_without_resampling():
    curve = _polylines()
    strands = toolpath.resampled(toolpath.strands_of(curve))
    assert np.array_equal(np.vstack([strand.points for strand in strands]), curve.positions)
    closing = np.linalg.norm(curve.positions[399] - curve.positions[0])
    assert strands[0].length == pytest.approx(strands[0].arc_lengths[-1] + closing)
    assert strands[2].length == pytest.approx(1.0)
    assert np.allclose(strands[2].tangents, [0.0, 0.0, 1.0])


def test_files_hold_the_strands(tmp_path):
    strands = toolpath.resampled(toolpath.strands_of(_polylines()), step=0.1)
    toolpath.write(tmp_path / "path.csv", strands, "1")
    toolpath.write(tmp_path / "path.json", strands, "1")
    record = json.loads((tmp_path / "path.json").read_text())
    with (tmp_path / "path.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == sum(len(strand.points) for strand in strands)
    for number, strand in enumerate(strands):
        own = [row for row in rows if int(row["strand"]) == number]
        assert [int(row["point"]) for row in own] == list(range(len(strand.points)))
        assert {row["closed"] for row in own} == {str(int(strand.closed))}
        read = np.array([[float(row[axis]) for axis in "xyz"] for row in own])
        assert np.array_equal(read, strand.points)
        assert np.allclose([float(row["arc_length"]) for row in own], strand.arc_lengths)
        assert np.allclose([float(row["nx"]) for row in own], strand.normals[:, 0])
        assert np.array_equal(record["strands"][number]["points"], strand.points)
        assert record["strands"][number]["closed"] is strand.closed


def test_arrays_hold_the_strands_and_have_the_same_bytes_again(tmp_path):
    strands = toolpath.resampled(toolpath.strands_of(_polylines()), step=0.1)
    for name in ("one.npz", "two.npz"):
        toolpath.write(tmp_path / name, strands, "1")
    assert (tmp_path / "one.npz").read_bytes() == (tmp_path / "two.npz").read_bytes()
    with np.load(tmp_path / "one.npz", allow_pickle=False) as arrays:
        offsets = arrays["offsets"]
        assert len(offsets) == len(strands) + 1 and str(arrays["version"]) == "1"
        assert "faces" not in arrays and "radii" not in arrays  # a step makes points of its own
        for k, strand in enumerate(strands):
            for name in ("points", "normals", "tangents", "arc_lengths"):
                read = arrays[name][offsets[k] : offsets[k + 1]]
                assert np.array_equal(read, getattr(strand, name))
            assert arrays["closed"][k] == strand.closed and arrays["lengths"][k] == strand.length


def test_a_step_beyond_all_counting_is_refused():
    with pytest.raises(whole_files.FileError, match="longer"):
        toolpath.resampled(toolpath.strands_of(_polylines()), step=1e-12)


def _plate(count=6):
    """A wavy plate, and a polyline along it whose pieces each lie in one triangle."""
    vertices, faces = geometry.grid(count)
    vertices = np.column_stack([vertices[:, :2], 0.2 * np.sin(3.0 * vertices[:, 0])])
    return toolpath.Mesh(vertices, faces.astype(np.uint32))


def test_resampling_keeps_to_the_triangles_and_blends_the_room():
    mesh = _plate()
    with flow_on((mesh.vertices, mesh.faces), radius=0.06, iteration_limit=60) as flow:
        flow.run()
        curve, data = flow.polylines(), flow.point_data()
    whole = toolpath.resampled(toolpath.strands_of(curve, data))
    stepped = toolpath.resampled(toolpath.strands_of(curve, data), step=0.013, mesh=mesh)
    few = toolpath.resampled(toolpath.strands_of(curve, data), tolerance=0.02, mesh=mesh)
    for strands in (whole, stepped, few):
        for strand in strands:
            corners = mesh.vertices[mesh.faces[strand.faces]]
            rebuilt = np.einsum("nk,nkj->nj", strand.weights, corners)
            assert np.abs(rebuilt - strand.points).max() < 1e-9
            assert strand.weights.min() >= 0.0
            assert np.allclose(strand.weights.sum(axis=1), 1.0)
            assert strand.radii.shape == (len(strand.points), 2)
    for given, strand in zip(whole, stepped, strict=True):
        # In proportion to the arc length, against numpy's own interpolation.
        places = np.append(given.arc_lengths, given.length)
        for side in range(2):
            values = np.append(given.radii[:, side], given.radii[0, side])
            assert np.allclose(strand.radii[:, side], np.interp(strand.arc_lengths, places, values))
    assert np.array_equal(np.vstack([strand.radii for strand in whole]), data.radii)


def test_files_hold_the_room_and_the_triangles_or_leave_them_empty(tmp_path):
    curve = _polylines()
    count = len(curve.positions)
    numbers = np.arange(count)
    data = core.PointData(
        None,
        None,
        None,
        np.column_stack([numbers + 0.25, numbers + 0.5]),
        numbers.astype(np.uint32),
        np.tile([0.5, 0.25, 0.25], (count, 1)),
    )
    for strands, known in ((toolpath.resampled(toolpath.strands_of(curve, data)), True),
                           (toolpath.resampled(toolpath.strands_of(curve)), False)):  # fmt: skip
        toolpath.write(tmp_path / "path.csv", strands, "1")
        toolpath.write(tmp_path / "path.json", strands, "1")
        with (tmp_path / "path.csv").open() as file:
            rows = list(csv.DictReader(file))
        record = json.loads((tmp_path / "path.json").read_text())["strands"]
        assert len(rows) == count
        if known:
            assert [float(row["r_plus"]) for row in rows] == list(numbers + 0.25)
            assert [float(row["r_minus"]) for row in rows] == list(numbers + 0.5)
            assert [int(row["face"]) for row in rows] == list(numbers)
            assert {(row["w0"], row["w1"], row["w2"]) for row in rows} == {("0.5", "0.25", "0.25")}
            assert [r for strand in record for r in strand["r_minus"]] == list(numbers + 0.5)
            assert [f for strand in record for f in strand["faces"]] == list(numbers)
        else:
            assert {row[name] for row in rows for name in ("r_plus", "face", "w2")} == {""}
            assert {strand["r_plus"] for strand in record} == {None}
