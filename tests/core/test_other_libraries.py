# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of trimesh and PyVista as surfaces, and curves as theirs."""

from __future__ import annotations

import geometry
import numpy as np
import pytest
from flows import flow_on
from meander import core

trimesh = pytest.importorskip("trimesh")
pyvista = pytest.importorskip("pyvista")


@pytest.fixture(scope="module")
def flow() -> core.Flow:
    vertices, faces = geometry.torus(24, 12)
    flow = flow_on((vertices, faces), radius=0.2, iteration_limit=30)
    flow.run()
    return flow


def test_meshes_of_both_are_surfaces() -> None:
    vertices, faces = geometry.icosphere(2)
    with core.Surface(vertices, faces) as surface:
        wanted = surface.statistics()
    ours = trimesh.Trimesh(vertices, faces, process=False)
    theirs = pyvista.PolyData.from_regular_faces(np.asarray(vertices), np.asarray(faces))
    for mesh in (ours, theirs):
        with core.Surface(mesh) as surface:
            assert surface.statistics() == wanted
            again = surface.__reduce__()
        assert len(again[1][0]) == len(vertices)
        assert len(core.find_faults(mesh, None).kinds) == 0
    with core.Surface(trimesh.creation.torus(1.0, 0.3)) as surface:
        assert surface.statistics()["area"] == pytest.approx(4.0 * np.pi**2 * 0.3, rel=0.05)


def test_polygons_of_pyvista_become_triangles() -> None:
    for mesh in (pyvista.Plane(), pyvista.Cylinder(capping=True), pyvista.Disc()):
        with core.Surface(mesh, options=core.SurfaceOptions(merge_distance=1e-6)) as surface:
            assert surface.statistics()["area"] == pytest.approx(mesh.area, rel=1e-5)


def test_what_is_no_mesh_is_refused() -> None:
    for other in (np.zeros((3, 3)), pyvista.UnstructuredGrid(), "spot.obj"):
        with pytest.raises(core.MeanderError, match="trimesh or PyVista"):
            core.Surface(other)


def test_curves_become_paths(flow: core.Flow) -> None:
    curve, data = flow.polylines(), flow.point_data()
    length = geometry.curve_length(curve.positions, curve.offsets, curve.closed)
    path = curve.to_trimesh(data)
    assert path.length == pytest.approx(length)
    assert [line.closed for line in path.entities] == curve.closed.astype(bool).tolist()
    assert np.array_equal(path.vertices, curve.positions)
    assert np.array_equal(path.vertex_attributes["face"], data.faces)


def test_curves_become_poly_data(flow: core.Flow) -> None:
    curve, data = flow.polylines(), flow.point_data()
    length = geometry.curve_length(curve.positions, curve.offsets, curve.closed)
    lines = curve.to_pyvista(data)
    assert lines.n_cells == len(curve.closed) and lines.n_points == len(curve.positions)
    assert lines.compute_cell_sizes()["Length"].sum() == pytest.approx(length)
    assert np.array_equal(lines["arc_length"], data.arc_lengths)
    assert np.array_equal(lines["weights"], data.barycentrics)
    assert lines.tube(radius=0.01, n_sides=8).area == pytest.approx(
        length * 2 * np.pi * 0.01, rel=0.05
    )
    open_one = core.Polylines(
        curve.positions[:9], curve.normals[:9], np.array([0, 4, 9]), np.array([0, 0])
    )
    assert [len(cell.point_ids) for cell in open_one.to_pyvista().cell] == [4, 5]
    with pytest.raises(core.MeanderError, match="the same time"):
        open_one.to_trimesh(data)


def test_what_is_missing_is_named(flow: core.Flow, monkeypatch: pytest.MonkeyPatch) -> None:
    def without(name: str) -> None:
        raise ImportError(f"No module named '{name}'")

    monkeypatch.setattr("importlib.import_module", without)
    with pytest.raises(core.MeanderError, match="pip install pyvista"):
        flow.polylines().to_pyvista()
