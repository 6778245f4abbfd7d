# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces that render otherwise than the views show: the line is seen in both.

What Blender renders is told by an engine of the tests' own, which keeps the triangles it is given.
"""

from __future__ import annotations

import json
from collections.abc import Callable

import bpy
import numpy as np
import pytest
from mathutils.bvhtree import BVHTree
from meander.ui.panels import MEANDER_PT_main
from panel_layout import drawn, texts_of
from scenes import activate, counts, cube, fill, mesh_object, points_of, sphere, world_triangles

SENTENCE = "This mesh renders with more subdivisions than the view shows"


class Keeper(bpy.types.RenderEngine):
    bl_idname = "MEANDER_TEST_KEEPER"
    bl_label = "Keeper"
    meshes: dict[str, tuple[np.ndarray, np.ndarray]] = {}

    def render(self, depsgraph) -> None:
        for instance in depsgraph.object_instances:
            thing = instance.object
            try:
                mesh = thing.to_mesh()
            except RuntimeError:
                continue
            mesh.calc_loop_triangles()
            matrix = np.array(instance.matrix_world)
            places = np.array([v.co[:] for v in mesh.vertices]).reshape(-1, 3)
            faces = np.array([t.vertices[:] for t in mesh.loop_triangles]).reshape(-1, 3)
            if len(faces):
                places = places @ matrix[:3, :3].T + matrix[:3, 3]
                Keeper.meshes[thing.name] = (places, faces)
            thing.to_mesh_clear()


@pytest.fixture
def rendered():
    """Triangles of an object as a render has them."""
    bpy.utils.register_class(Keeper)

    def triangles(thing: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
        scene = bpy.context.scene
        scene.render.engine, before = Keeper.bl_idname, scene.render.engine
        scene.render.resolution_x = scene.render.resolution_y = 8
        scene.render.use_compositing = scene.render.use_sequencer = False
        if scene.camera is None:
            camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
            scene.collection.objects.link(camera)
            scene.camera = camera
        Keeper.meshes = {}
        bpy.ops.render.render()
        scene.render.engine = before
        return Keeper.meshes[thing.name]

    yield triangles
    bpy.utils.unregister_class(Keeper)


def off(points: np.ndarray, triangles: tuple[np.ndarray, np.ndarray]) -> float:
    vertices, faces = triangles
    tree = BVHTree.FromPolygons(vertices.tolist(), faces.tolist())
    return max(tree.find_nearest(point)[3] for point in points.tolist())


def subdivided(view: int = 1, render: int = 2) -> bpy.types.Object:
    surface = cube()
    modifier = surface.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels, modifier.render_levels = view, render
    return surface


def render_toggle() -> bpy.types.Object:
    surface = subdivided(1, 1)
    surface.modifiers[0].show_viewport = False
    return surface


def view_toggle() -> bpy.types.Object:
    surface = subdivided(2, 2)
    surface.modifiers[0].show_render = False
    return surface


def other_modifier() -> bpy.types.Object:
    surface = sphere()
    modifier = surface.modifiers.new("Flat", "SIMPLE_DEFORM")
    modifier.deform_method, modifier.factor, modifier.show_viewport = "STRETCH", -0.4, False
    return surface


def simplified() -> bpy.types.Object:
    surface, render = subdivided(3, 3), bpy.context.scene.render
    render.use_simplify = True
    render.simplify_subdivision, render.simplify_subdivision_render = 1, 2
    return surface


def of_an_operand() -> bpy.types.Object:
    operand = subdivided()
    operand.location.z = 1.2
    operand.hide_render = True
    surface = cube()
    modifier = surface.modifiers.new("Union", "BOOLEAN")
    modifier.object, modifier.operation = operand, "UNION"
    return surface


def metaball() -> bpy.types.Object:
    for x in (0.0, 1.6):
        bpy.ops.object.metaball_add(type="BALL", radius=1.0, location=(x, 0.0, 0.0))
        data = bpy.context.active_object.data
        data.resolution, data.render_resolution = 0.4, 0.2
    return activate(bpy.data.objects["Mball"])


def thick_curve() -> bpy.types.Object:
    bpy.ops.curve.primitive_bezier_circle_add(radius=1.0)
    ring = bpy.context.active_object
    ring.data.bevel_depth = 0.3
    for spline in ring.data.splines:
        spline.resolution_u = 4
    ring.data.render_resolution_u = 12
    return activate(ring)


def text() -> bpy.types.Object:
    bpy.ops.object.text_add()
    thing = bpy.context.active_object
    thing.data.body, thing.data.extrude = "O", 0.1
    thing.data.resolution_u, thing.data.render_resolution_u = 2, 6
    return activate(thing)


def is_viewport() -> bpy.types.Object:
    surface = cube()
    group = bpy.data.node_groups.new("Halved", "GeometryNodeTree")
    if hasattr(group, "interface"):
        for way in ("INPUT", "OUTPUT"):
            group.interface.new_socket(
                name="Geometry", in_out=way, socket_type="NodeSocketGeometry"
            )
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    first, last, ask, switch, half = (
        group.nodes.new(kind)
        for kind in (
            "NodeGroupInput",
            "NodeGroupOutput",
            "GeometryNodeIsViewport",
            "GeometryNodeSwitch",
            "GeometryNodeTransform",
        )
    )
    half.inputs["Scale"].default_value = (0.5, 0.5, 0.5)
    switch.input_type = "GEOMETRY"
    geometry = [socket for socket in switch.inputs if socket.type == "GEOMETRY" and socket.enabled]
    asked = next(s for s in switch.inputs if s.type == "BOOLEAN" and s.enabled)
    link = group.links.new
    link(first.outputs[0], half.inputs["Geometry"])
    link(ask.outputs[0], asked)
    link(half.outputs[0], geometry[0])
    link(first.outputs[0], geometry[1])
    link(next(s for s in switch.outputs if s.enabled), last.inputs[0])
    surface.modifiers.new("Halved", "NODES").node_group = group
    return surface


EVERY = [
    subdivided,
    render_toggle,
    view_toggle,
    other_modifier,
    simplified,
    of_an_operand,
    metaball,
    thick_curve,
    text,
    is_viewport,
]


@pytest.mark.parametrize("build", EVERY)
def test_the_surface_is_filled_as_rendered(build: Callable[[], bpy.types.Object], rendered):
    surface = build()
    triangles = rendered(surface)
    before = counts()
    # A union has slivers, which are mended before it is filled: at this spacing no node is on one.
    spacing = {text: 0.05, of_an_operand: 0.28}.get(build, 0.3)
    result = fill(surface, spacing)
    assert counts() == before | {
        "objects": before["objects"] + 1,
        "curves": before["curves"] + 1,
    }
    assert len(bpy.data.scenes) == 1 and len(bpy.data.metaballs) in (0, 2)
    assert off(points_of(result), triangles) < 1e-5
    if build is not of_an_operand:  # where the difference is small beside the body
        assert off(points_of(result), world_triangles(surface)) > 1e-3


@pytest.mark.parametrize("build", [subdivided, other_modifier, simplified])
def test_the_views_show_the_line_on_what_they_show(build: Callable[[], bpy.types.Object], rendered):
    surface = build()
    result = fill(surface, 0.3, use_bevel=True)
    look = result.modifiers[-1]
    look.show_viewport = look.show_render = False  # only the line
    bpy.context.view_layer.update()
    shown = result.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    line = np.array([vertex.co[:] for vertex in mesh.vertices])
    shown.to_mesh_clear()
    assert len(line) > 100
    assert off(line, world_triangles(surface)) < 1e-5
    # What is asked of the curve is asked of its own points, on the surface that is rendered.
    assert bpy.ops.meander.run(restart=True) == {"FINISHED"}
    assert [each.type for each in result.modifiers] == ["SHRINKWRAP", "NODES"]
    activate(result)
    assert bpy.ops.meander.run() == {"FINISHED"}  # goes on from its splines
    assert off(points_of(result), rendered(surface)) < 1e-5


def test_nothing_of_the_metaballs_is_changed():
    surface = metaball()
    fill(surface, 0.3)
    for ball in bpy.data.metaballs:
        assert (ball.resolution, ball.render_resolution) == pytest.approx((0.4, 0.2))
    assert sorted(t.name for t in bpy.data.objects) == ["Mball", "Mball Meander", "Mball.001"]


def test_nothing_of_the_modifiers_is_changed():
    surface = subdivided()
    render = bpy.context.scene.render
    before = [
        (m.levels, m.render_levels, m.show_viewport, m.show_render) for m in surface.modifiers
    ]
    fill(surface, 0.3)
    after = [(m.levels, m.render_levels, m.show_viewport, m.show_render) for m in surface.modifiers]
    assert after == before and not render.use_simplify


def glowing(name: str, color: tuple) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    glow, out = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    glow.inputs["Color"].default_value = color
    material.node_tree.links.new(glow.outputs[0], out.inputs["Surface"])
    return material


def pixels_of_the_line(surface: bpy.types.Object, curve: bpy.types.Object, tmp_path) -> int:
    scene = bpy.context.scene
    surface.data.materials.append(glowing("Blue", (0.0, 0.0, 1.0, 1.0)))
    red = glowing("Red", (1.0, 0.0, 0.0, 1.0))
    curve.data.materials.clear()
    curve.data.materials.append(red)
    bpy.context.view_layer.update()
    scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(scene.camera)
    scene.camera.location = (0.0, 0.0, 5.0)
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 4, False
    scene.render.resolution_x = scene.render.resolution_y = 160
    scene.render.filepath = str(tmp_path / "line.png")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    values = np.array(image.pixels[:]).reshape(-1, 4)
    return int(np.count_nonzero(values[:, 0] > values[:, 2]))


def test_the_line_is_seen_in_a_render(tmp_path):
    seen = []
    for levels in ((2, 2), (1, 2)):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        surface = subdivided(*levels)
        curve = fill(surface, 0.2, use_bevel=True)
        seen.append(pixels_of_the_line(surface, curve, tmp_path))
    assert seen[0] > 1500
    assert seen[1] > 0.9 * seen[0]


def test_what_costs_more_is_filled_as_shown(rendered):
    surface = subdivided(1, 3)
    result = fill(surface, 0.3)
    assert off(points_of(result), world_triangles(surface)) < 1e-5
    assert not result.modifiers
    assert off(points_of(result), rendered(surface)) > 1e-3
    array = cube()
    modifier = array.modifiers.new("Array", "ARRAY")
    modifier.count, modifier.show_viewport = 5, False
    assert off(points_of(fill(array, 0.3)), world_triangles(array)) < 1e-5


def words() -> str:
    return " ".join(text for text in texts_of(MEANDER_PT_main))


@pytest.mark.parametrize("operator, level", [("show_as_rendered", 2), ("render_as_shown", 1)])
def test_the_panel_says_so_and_one_click_makes_both_the_same(operator, level, rendered):
    surface = subdivided()
    assert SENTENCE in words()
    layout = drawn(MEANDER_PT_main, bpy.context)
    assert not [text.text for text in layout.texts() if text.excess > 0.0]
    assert getattr(bpy.ops.meander, operator)() == {"FINISHED"}
    modifier = surface.modifiers[0]
    assert (modifier.levels, modifier.render_levels) == (level, level)
    assert SENTENCE not in words()
    assert not getattr(bpy.ops.meander, operator).poll()
    result = fill(surface, 0.3)
    for triangles in (rendered(surface), world_triangles(surface)):
        assert off(points_of(result), triangles) < 1e-5


@pytest.mark.parametrize("build", [render_toggle, view_toggle, simplified, thick_curve, text])
@pytest.mark.parametrize("operator", ["show_as_rendered", "render_as_shown"])
def test_every_difference_of_values_goes_by_one_click(build, operator, rendered):
    surface = build()
    assert "renders" in words()
    assert getattr(bpy.ops.meander, operator)() == {"FINISHED"}
    assert "renders" not in words()
    assert len(rendered(surface)[1]) == len(world_triangles(surface)[1])


def test_a_click_takes_the_line_along_when_filled_again():
    surface = subdivided()
    result = fill(surface, 0.3)
    assert [each.type for each in result.modifiers] == ["SHRINKWRAP"]
    bpy.ops.meander.render_as_shown()
    assert fill(surface, 0.3) == result
    assert not result.modifiers
    assert off(points_of(result), world_triangles(surface)) < 1e-5


def test_what_is_made_of_the_curve_is_made_of_the_rendered_surface(rendered):
    surface = subdivided()
    surface.vertex_groups.new(name="Close").add([0, 1, 2, 3], 1.0, "REPLACE")
    result = fill(surface, 0.3, density_source="GROUP", density_group="Close")
    triangles = rendered(surface)
    activate(result)
    before = set(bpy.data.objects)
    assert bpy.ops.meander.two_tone() == {"FINISHED"}
    (made,) = (one for one in set(bpy.data.objects) - before if one.type == "MESH")
    vertices = np.array([made.matrix_world @ vertex.co for vertex in made.data.vertices])
    assert off(vertices, triangles) < 1e-4


def test_selected_faces_are_filled_as_rendered(rendered):
    surface = subdivided()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    surface.data.polygons[0].select = True
    bpy.ops.object.mode_set(mode="EDIT")
    surface.meander.spacing, surface.meander.use_bevel = 0.2, False
    assert bpy.ops.meander.run() == {"FINISHED"}
    result = surface.meander.last_result
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    points = points_of(result)
    assert off(points, rendered(surface)) < 1e-5
    assert (points.max(axis=0) - points.min(axis=0)).min() < 1.0


def test_the_batch_command_fills_as_rendered_whatever_it_costs(run_command, rendered):
    surface = subdivided(1, 3)
    triangles = rendered(surface)
    code, errors, curve, _record = run_command("--iterations", "60")
    assert code == 0, errors
    assert off(curve.points, triangles) < 1e-4
    # And only there.
    assert off(points_of(fill(bpy.data.objects["Cube"], 0.3)), triangles) > 1e-3


def test_a_drawing_from_the_camera_is_of_what_is_rendered(tmp_path):
    from meander.headless import camera as command

    surface = subdivided(0, 3)
    scene = bpy.context.scene
    scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(scene.camera)
    scene.camera.location = (0.0, 0.0, 6.0)
    output, report = tmp_path / "page.svg", tmp_path / "page.json"
    arguments = ["--output", output, "--report", report, "--spacing", "4", "--quiet"]
    assert command.main([str(each) for each in arguments]) == 0
    # A cube of 12 triangles would have been cut at the frame and divided, but not rounded.
    (layer,) = json.loads(report.read_text())["objects"]
    assert layer["faces"] >= 12 * 4**3
    assert surface.modifiers[0].levels == 0


def test_a_curve_that_follows_says_what_keeps_it(rendered):
    surface = subdivided()
    result = fill(surface, 0.3)
    from meander.run import motion

    result.meander.motion, result.meander.follow = "STICK", True
    bpy.context.scene.frame_set(2)
    assert "renders otherwise" in motion.problem_of(result)
    bpy.ops.meander.show_as_rendered()
    bpy.context.scene.frame_set(3)
    assert motion.problem_of(result) is None
    result.meander.follow = False


def test_a_mesh_of_one_kind_has_no_notice():
    mesh_object("Plain", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    assert "renders" not in words()
