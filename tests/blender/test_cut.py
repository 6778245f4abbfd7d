# SPDX-License-Identifier: GPL-3.0-or-later
"""What a result makes of its surface: the cut mesh, two colours, a relief, a ribbon."""

from __future__ import annotations

from pathlib import Path

import bpy
import geometry
import numpy as np
import pytest
import scenes

SPACING = 0.4


class Made:
    """A mesh object as arrays, in its own space unless it says otherwise."""

    def __init__(self, thing: bpy.types.Object) -> None:
        mesh = thing.data
        self.mesh = mesh
        self.points = scenes.column(mesh.vertices, "co", 3)
        self.faces = scenes.column(mesh.loops, "vertex_index", 1, np.int32).reshape(-1, 3)
        self.edges = scenes.column(mesh.edges, "vertices", 2, np.int32)
        self.seams = scenes.column(mesh.edges, "use_seam", 1, bool)
        self.materials = scenes.column(mesh.polygons, "material_index", 1, np.int32)
        matrix = np.array([row[:] for row in thing.matrix_world])
        self.world = self.points @ matrix[:3, :3].T + matrix[:3, 3]

    def attribute(self, name: str, kind: type = np.float32) -> np.ndarray:
        return scenes.column(self.mesh.attributes[name].data, "value", 1, kind)

    def uv(self, name: str) -> np.ndarray:
        return scenes.column(self.mesh.uv_layers[name].data, "uv", 2).reshape(-1, 3, 2)

    def areas(self) -> np.ndarray:
        return geometry.triangle_areas(self.world, self.faces)

    def faces_of_edges(self) -> dict[tuple[int, int], list[int]]:
        found: dict[tuple[int, int], list[int]] = {}
        for number, face in enumerate(self.faces.tolist()):
            for k in range(3):
                found.setdefault(tuple(sorted((face[k], face[k - 1]))), []).append(number)
        return found


def check_sides(made: Made) -> None:
    """The surface is closed, and its sides meet along closed lines of seams, and nowhere else."""
    side = made.attribute("side", np.int32)
    beside = made.faces_of_edges()
    for (a, b), seam in zip(made.edges.tolist(), made.seams.tolist(), strict=True):
        one, other = beside[min(a, b), max(a, b)]
        assert (side[one] != side[other]) == seam
    ends = np.bincount(made.edges[made.seams].ravel(), minlength=len(made.points))
    assert set(np.unique(ends)) == {0, 2}
    on_line = ends > 0
    assert made.attribute("distance")[on_line].max() < 1e-3 * SPACING


def test_a_sphere_has_two_colours_of_the_same_area() -> None:
    result = scenes.fill(scenes.sphere(), SPACING)
    surface = result.meander.surface
    assert bpy.ops.meander.two_tone() == {"FINISHED"}
    thing = bpy.context.active_object
    assert thing.parent is None and thing.type == "MESH"
    assert result.hide_get() and surface.hide_get() and surface.hide_render
    made = Made(thing)
    check_sides(made)
    assert [material.name for material in thing.data.materials] == [
        "Meander Side 1",
        "Meander Side 2",
    ]
    areas = made.areas()
    halves = [areas[made.materials == k].sum() for k in (0, 1)]
    assert halves[0] == pytest.approx(halves[1], rel=0.1)
    assert sum(halves) == pytest.approx(scenes.area_of(surface), rel=1e-4)
    # Each side as an object of its own, which together are the same.
    scenes.activate(result)
    assert bpy.ops.meander.two_tone(parts="TWO", hide=False) == {"FINISHED"}
    assert [len(part.data.materials) for part in bpy.context.selected_objects] == [1, 1]
    parts = [Made(part) for part in bpy.context.selected_objects]
    assert len(parts) == 2
    assert sorted(part.areas().sum() for part in parts) == pytest.approx(sorted(halves), rel=1e-4)


def test_a_relief_rises_between_the_turns() -> None:
    result = scenes.fill(scenes.sphere(), SPACING)
    assert bpy.ops.meander.relief() == {"FINISHED"}
    thing = bpy.context.active_object
    flat = Made(thing)
    distance = flat.attribute("distance")
    depsgraph = bpy.context.evaluated_depsgraph_get()
    evaluated = thing.evaluated_get(depsgraph)
    risen = scenes.column(evaluated.data.vertices, "co", 3)
    height = np.linalg.norm(risen, axis=1) - np.linalg.norm(flat.points, axis=1)
    assert np.abs(height[distance == 0.0]).max() < 1e-5
    ridge = distance > 0.5 * SPACING
    assert ridge.any()
    assert np.allclose(height[ridge], 0.3 * SPACING, rtol=0.02)
    assert result.name in thing.name


def test_a_ribbon_has_a_map_along_the_line() -> None:
    scenes.fill(scenes.sphere(), SPACING)
    assert bpy.ops.meander.ribbon(detail=1.0) == {"FINISHED"}
    materials = bpy.context.active_object.data.materials
    assert [material.name for material in materials] == ["Meander Running Lights"]
    made = Made(bpy.context.active_object)
    check_sides(made)
    uv = made.uv("Ribbon")
    assert uv[:, :, 1].min() >= 0.0 and uv[:, :, 1].max() <= 1.0
    # Along the line U grows as the line does, and V is in the middle.
    keys = {tuple(sorted(edge)) for edge in made.edges[made.seams].tolist()}
    checked = as_long = in_the_middle = 0
    for number, face in enumerate(made.faces.tolist()):
        for k in range(3):
            if tuple(sorted((face[k], face[k - 1]))) not in keys:
                continue
            length = np.linalg.norm(made.points[face[k]] - made.points[face[k - 1]])
            grown = abs(uv[number, k, 0] - uv[number, k - 1, 0]) * SPACING
            assert grown == pytest.approx(length, rel=0.1, abs=1e-3)
            as_long += grown == pytest.approx(length, rel=0.02, abs=1e-3)
            across = np.abs(uv[number, [k, k - 1], 1] - 0.5).max()
            assert across < 0.02
            in_the_middle += across < 1e-3
            checked += 1
    assert checked == 2 * made.seams.sum()
    # Faces too thin to shade are taken out, and a few points of the line move with them.
    assert as_long > 0.99 * checked and in_the_middle > 0.99 * checked
    # No face spans turns, so that what is drawn along the line is not smeared.
    spans = np.ptp(uv[:, :, 0], axis=1)
    assert np.percentile(spans, 99) < 1.5
    along = made.attribute("along").reshape(-1, 3)
    assert -0.05 < along.min() and along.max() < 1.05 and np.ptp(along) > 0.95


def test_a_scaled_and_mirrored_surface_keeps_its_skin() -> None:
    thing = scenes.sphere()
    thing.scale = (-2.0, 2.0, 2.0)
    paint = bpy.data.materials.new("Paint")
    thing.data.materials.append(paint)
    for polygon in thing.data.polygons:
        polygon.use_smooth = True
    given = np.empty(2 * len(thing.data.loops), dtype=np.float32)
    layer = thing.data.uv_layers[0] if thing.data.uv_layers else thing.data.uv_layers.new()
    for loop, place in zip(thing.data.loops, layer.data, strict=True):  # a map that tells X and Z
        place.uv = thing.data.vertices[loop.vertex_index].co.xz
    name = layer.name
    layer.data.foreach_get("uv", given)
    scenes.fill(thing, 2.0 * SPACING)
    assert bpy.ops.meander.cut_along_curve(detail=0.5, middle_lines=True) == {"FINISHED"}
    made_thing = bpy.context.active_object
    made = Made(made_thing)
    assert list(made_thing.data.materials) == [paint]
    uv = made.uv(name)
    assert np.allclose(uv, made.points[made.faces][:, :, [0, 2]], atol=1e-4)
    # Faces look outward where the mirror is taken into account, as those of the surface do.
    a, b, c = (made.points[made.faces[:, k]] for k in range(3))
    outward = (np.cross(b - a, c - a) * (a + b + c)).sum(axis=1)
    assert (outward > 0.0).mean() > 0.999
    # Lengths are in the object's own space.
    assert 0.4 * SPACING < np.percentile(made.attribute("distance"), 99) < 0.8 * SPACING


def test_an_open_line_has_sides_that_meet_between_its_turns() -> None:
    surface = scenes.grid(size=2.0)
    surface.meander.seed = scenes.poly_curve("Stroke", [[(-0.8, 0.1, 0), (0.8, 0.1, 0)]], False)
    result = scenes.fill(surface, 0.3)
    assert bpy.ops.meander.two_tone() == {"FINISHED"}
    made = Made(bpy.context.active_object)
    side = made.attribute("side", np.int32)
    beside = made.faces_of_edges()
    for (a, b), seam in zip(made.edges.tolist(), made.seams.tolist(), strict=True):
        faces = beside[min(a, b), max(a, b)]
        assert not seam or side[faces[0]] != side[faces[1]]
    areas = made.areas()
    assert areas[side > 0].sum() == pytest.approx(areas[side < 0].sum(), rel=0.3)
    assert result.name in bpy.context.active_object.name


def test_what_cannot_be_cut_is_said() -> None:
    sphere = scenes.sphere()
    assert not bpy.ops.meander.two_tone.poll()
    result = scenes.fill(sphere, SPACING)
    before = len(bpy.data.meshes)
    for vertex in sphere.data.vertices:
        vertex.co *= 3.0
    sphere.data.update()
    with pytest.raises(RuntimeError, match="fill the surface again"):
        bpy.ops.meander.relief()
    assert len(bpy.data.meshes) == before
    assert not result.hide_get()


def test_what_stands_in_the_place_of_its_surface_is_where_that_was() -> None:
    surface = scenes.sphere()
    above = scenes.cube()
    above.location, above.rotation_euler, above.scale = (1, 2, 3), (0.1, 0.2, 0.3), (1, 2, 1)
    surface.parent, surface.location, surface.rotation_euler = above, (0.5, 0, 0), (0.4, 0, 0)
    surface.delta_scale = (1.0, 1.5, 1.0)
    bpy.context.view_layer.update()
    surface.matrix_parent_inverse = above.matrix_world.inverted()
    result = scenes.fill(surface, SPACING)
    assert bpy.ops.meander.two_tone() == {"FINISHED"}
    thing = bpy.context.active_object
    bpy.context.view_layer.update()
    assert thing.parent == above and thing.visible_get() and thing.select_get()
    assert np.allclose(thing.matrix_world, surface.matrix_world, atol=1e-6)
    # Beside a surface that is seen it is a child, and so it is where that one moves by itself.
    for hide, moves in ((False, False), (True, True)):
        scenes.activate(result)
        result.hide_set(False)
        scenes.activate(result)
        if moves:
            surface.keyframe_insert("location", frame=1)
        assert bpy.ops.meander.two_tone(hide=hide) == {"FINISHED"}
        assert bpy.context.active_object.parent == surface


def test_a_ribbon_has_colours_of_its_own_along_the_line() -> None:
    scenes.fill(scenes.sphere(), SPACING)
    assert bpy.ops.meander.ribbon(detail=1.0) == {"FINISHED"}
    made = Made(bpy.context.active_object)
    layer = made.mesh.color_attributes.active_color
    colours = scenes.column(layer.data, "color", 4)
    uv = made.uv("Ribbon").reshape(-1, 2)
    off = np.abs(uv[:, 1] - 0.5)
    assert colours[off < 0.01, 0].min() > 0.25 and colours[off > 0.49, 0].max() < 0.1
    # Brightest at the head of a light, every 24 spacings.
    on_line = off < 0.01
    heads = (uv[on_line, 0] / 24.0) % 1.0
    assert np.corrcoef(heads, colours[on_line, 0])[0, 1] > 0.95


def test_the_batch_command_writes_a_scene(tmp_path: Path, run_batch) -> None:
    surface = scenes.sphere()
    surface.name = "Ball"
    path, cut = tmp_path / "scene.blend", tmp_path / "cut.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    done = run_batch(
        *("--input", path, "--object", "Ball", "--spacing", SPACING, "--iterations", 30),
        *("--output", tmp_path / "curve.obj", "--cut", cut),
    )
    assert done.returncode == 0, done.stderr
    assert f"wrote {cut}" in done.stdout
    bpy.ops.wm.open_mainfile(filepath=str(cut))
    made = Made(bpy.data.objects["Ball Cut"])
    check_sides(made)
    assert bpy.data.objects["Ball Cut"].parent == bpy.data.objects["Ball"]
