# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves for other programs, read back by readers that are not ours: USD by Pixar's, glTF by VTK
and trimesh, YAML by PyYAML."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import geometry
import numpy as np
import pytest
from flows import fill
from meander.model import export
from meander.model.toolpaths import toolpath
from meander.model.toolpaths.tube import SIDES

usd_geom = pytest.importorskip("pxr.UsdGeom")
from pxr import Usd  # noqa: E402

SPACING = 0.3


@pytest.fixture(scope="module")
def ball(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return geometry.write_obj(tmp_path_factory.mktemp("ball") / "ball.obj", geometry.icosphere(3))


def run(mesh: Path, name: str, *extra: str) -> Path:
    output = mesh.with_name(name)
    assert fill(mesh, output, "--spacing", SPACING, "--quiet", *extra) == 0
    return output


def table(mesh: Path) -> np.ndarray:
    """Every point of the curve as a .csv has it."""
    return np.genfromtxt(run(mesh, "curve.csv"), delimiter=",", names=True)


def columns(rows: np.ndarray, *names: str) -> np.ndarray:
    return np.column_stack([rows[name] for name in names])


def strands(offset: float = 0.0) -> list[toolpath.Strand]:
    """A ring and a bent line with a sharp turn, of a plane."""
    angle = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False)
    ring = np.column_stack([np.cos(angle), np.sin(angle), 0.0 * angle])
    line = np.array([[2.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 1.0, 0.0], [3.0, 2.0, 0.0]])
    up = [0.0, 0.0, 1.0]
    return [
        toolpath.strand_of(points + offset, np.tile(up, (len(points), 1)), closed)
        for points, closed in ((ring, True), (line, False))
    ]


def written(path: Path, given: list[toolpath.Strand], frames=(), **values) -> Path:
    kind = export.format_of(path)
    drawing = export.prepared(
        given, kind, {**export.DEFAULTS, **values}, 1.0, 1.0, frames=frames, rate=25.0
    )
    export.write(path, kind, drawing, {**export.DEFAULTS, **values}, '1 "odd" \u00e9\n', "1.2.3")
    return path


# ------------------------------------------------------------------------------------------------
# USD


@pytest.mark.parametrize("suffix", [".usda", ".usdc", ".usd"])
def test_usd_has_what_is_known_of_the_points(ball: Path, suffix: str) -> None:
    rows = table(ball)
    stage = Usd.Stage.Open(str(run(ball, f"a{suffix}", "--thickness", "0.5")))
    assert usd_geom.GetStageMetersPerUnit(stage) == 1.0
    assert usd_geom.GetStageUpAxis(stage) == "Z"
    curves = usd_geom.BasisCurves(stage.GetDefaultPrim().GetChild("Closed"))
    assert curves.GetTypeAttr().Get() == "linear" and curves.GetWrapAttr().Get() == "periodic"
    assert list(curves.GetCurveVertexCountsAttr().Get()) == [len(rows)]
    points = np.array(curves.GetPointsAttr().Get())
    assert np.allclose(points, columns(rows, "x", "y", "z"), atol=1e-6)
    assert np.allclose(curves.GetNormalsAttr().Get(), columns(rows, "nx", "ny", "nz"), atol=1e-6)
    assert curves.GetNormalsInterpolation() == "vertex"
    assert curves.GetWidthsAttr().Get()[0] == pytest.approx(0.5 * SPACING)
    assert curves.GetWidthsInterpolation() == "constant"
    extent = np.array(curves.GetExtentAttr().Get())
    assert (extent[0] < points.min(axis=0)).all() and (extent[1] > points.max(axis=0)).all()
    primvars = usd_geom.PrimvarsAPI(curves)
    for name, column in (("arc_length", "arc_length"), ("r_plus", "r_plus"), ("face", "face")):
        assert np.allclose(primvars.GetPrimvar(name).Get(), rows[column], rtol=1e-6, atol=1e-6)
        assert primvars.GetPrimvar(name).GetInterpolation() == "vertex"
    weights = np.array(primvars.GetPrimvar("weights").Get())
    assert np.allclose(weights, columns(rows, "w0", "w1", "w2"), atol=1e-6)


def test_usd_has_open_and_closed_strands_and_any_title(tmp_path: Path) -> None:
    stage = Usd.Stage.Open(str(written(tmp_path / "a.usda", strands(), thickness=0.0)))
    default = stage.GetDefaultPrim()
    wraps = {
        prim.GetName(): usd_geom.BasisCurves(prim).GetWrapAttr().Get()
        for prim in default.GetChildren()
    }
    assert wraps == {"Closed": "periodic", "Open": "nonperiodic"}
    assert not usd_geom.BasisCurves(default.GetChild("Open")).GetWidthsAttr().HasAuthoredValue()


def test_usd_far_from_the_origin_keeps_its_digits(tmp_path: Path) -> None:
    stage = Usd.Stage.Open(str(written(tmp_path / "a.usdc", strands(4e6))))
    curves = usd_geom.BasisCurves(stage.GetDefaultPrim().GetChild("Open"))
    places = usd_geom.Xformable(stage.GetDefaultPrim()).ComputeLocalToWorldTransform(0.0)
    points = [places.Transform(tuple(map(float, point))) for point in curves.GetPointsAttr().Get()]
    assert np.allclose(points, strands(4e6)[1].points, rtol=0.0, atol=1e-6)


def test_usd_moves(tmp_path: Path) -> None:
    ring, line = strands()
    frames = [
        (1.0, [ring, line]),
        (2.0, [replace(ring, points=ring.points + 1.0), line]),
        (4.0, [replace(ring, points=ring.points[:30])]),
    ]
    stage = Usd.Stage.Open(str(written(tmp_path / "a.usdc", [ring, line], frames)))
    assert stage.GetStartTimeCode() == 1.0 and stage.GetEndTimeCode() == 4.0
    assert stage.GetTimeCodesPerSecond() == 25.0
    closed = usd_geom.BasisCurves(stage.GetDefaultPrim().GetChild("Closed"))
    for time, moved in frames:
        points = closed.GetPointsAttr().Get(time)
        assert np.allclose(points, moved[0].points, atol=1e-6)
        assert list(closed.GetCurveVertexCountsAttr().Get(time)) == [len(points)]
    still = usd_geom.BasisCurves(stage.GetDefaultPrim().GetChild("Open"))
    assert still.GetPointsAttr().GetTimeSamples() == [1.0, 4.0]
    assert list(still.GetCurveVertexCountsAttr().Get(4.0)) == []


def test_binary_usd_says_what_it_needs(
    ball: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.setattr("meander.model.toolpaths.usd.is_there", lambda: False)
    assert fill(ball, ball.with_name("b.usdc"), "--spacing", "0.3") == 2
    assert "usd-core" in capsys.readouterr().err and not ball.with_name("b.usdc").exists()


# ------------------------------------------------------------------------------------------------
# glTF


def test_a_tube_is_closed_and_as_thick_as_asked(ball: Path) -> None:
    trimesh = pytest.importorskip("trimesh")
    rows = table(ball)
    tube = trimesh.load(run(ball, "a.glb", "--thickness", "0.2")).to_mesh()
    arc = tube.visual.uv[:, 0] * SPACING
    length = float(arc.max())
    assert arc.min() == 0.0 and np.ptp(tube.visual.uv[:, 1]) == 1.0
    # Up is y: what was z.
    assert tube.bounds[1][1] == pytest.approx(rows["z"].max() + 0.1 * SPACING, abs=0.02)
    tube.merge_vertices(merge_tex=True, merge_norm=True)
    assert tube.is_watertight and tube.is_winding_consistent
    section = SIDES / 2.0 * np.sin(2.0 * np.pi / SIDES) * (0.1 * SPACING) ** 2
    assert tube.volume == pytest.approx(section * length, rel=0.01)


def test_open_strands_have_caps_and_sharp_turns_keep_their_width(tmp_path: Path) -> None:
    trimesh = pytest.importorskip("trimesh")
    _ring, line = strands()
    tube = trimesh.load(written(tmp_path / "a.glb", [line], thickness=0.2)).to_mesh()
    normals = tube.vertex_normals
    tube.merge_vertices(merge_tex=True, merge_norm=True)
    assert tube.is_watertight and tube.is_winding_consistent
    section = SIDES / 2.0 * np.sin(2.0 * np.pi / SIDES) * 0.01
    assert tube.volume == pytest.approx(section * 3.0, rel=1e-5)
    assert np.isfinite(normals).all()


def test_lines_are_as_long_as_the_curve(ball: Path) -> None:
    pyvista = pytest.importorskip("pyvista")
    rows = table(ball)
    read = pyvista.get_reader(str(run(ball, "b.glb", "--thickness", "0"))).read().combine()
    points = columns(rows, "x", "y", "z")
    assert np.allclose(read.points, columns(rows, "x", "z", "y") * [1.0, 1.0, -1.0], atol=1e-6)
    ring = np.vstack([points, points[:1]])
    length = np.linalg.norm(np.diff(ring, axis=0), axis=1).sum()
    assert read.compute_cell_sizes()["Length"].sum() == pytest.approx(length, rel=1e-5)


# ------------------------------------------------------------------------------------------------
# ROS


@pytest.mark.parametrize("message", ["pose_array", "path"])
def test_messages_of_ros_are_the_poses_in_metres(ball: Path, message: str) -> None:
    yaml = pytest.importorskip("yaml")
    given = ("--standoff", "0.1", "--approach", "0.5", "--resample-step", "0.05")
    rows = np.genfromtxt(
        run(ball, "p.csv", "--poses", *given), delimiter=",", names=True, dtype=None, encoding=None
    )
    more = ("--ros-message", message, "--frame-id", "no: base", "--input-unit", "mm")
    text = run(ball, "a.yaml", *given, *more).read_text()
    documents = [each for each in yaml.safe_load_all(text) if each is not None]
    assert len(documents) == len(np.unique(rows["strand"]))
    for number, document in enumerate(documents):
        assert document["header"]["frame_id"] == "no: base"
        poses = document["poses"]
        if message == "path":
            assert {each["header"]["frame_id"] for each in poses} == {"no: base"}
            poses = [each["pose"] for each in poses]
        wanted = rows[rows["strand"] == number]
        places = [[each["position"][axis] for axis in "xyz"] for each in poses]
        turns = [[each["orientation"][axis] for axis in "xyzw"] for each in poses]
        assert np.allclose(places, 0.001 * columns(wanted, "x", "y", "z"), atol=1e-8)
        assert np.allclose(turns, columns(wanted, "qx", "qy", "qz", "qw"), atol=1e-8)
