# SPDX-License-Identifier: GPL-3.0-or-later
"""Copies that Geometry Nodes or a collection show: each is filled by itself, as one surface."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes
from meander.scene import instances
from meander.scene.blender_versions import add_geometry_socket
from meander.scene.errors import DataError
from meander.scene.meshes import surface_now, triangles_of
from panel_layout import drawn, panels
from sentences import assert_sentence
from test_batch_scene import run_alone

# Where copies stand, how large they are, and by how much they are turned about z.
PLACES = [(0.0, 0.0, 0.0), (4.0, 0.0, 1.0), (0.0, 6.0, 0.0), (-5.0, 0.0, 0.0)]
SIZES = [1.0, 0.5, 2.0, 1.0]
TURNS = [0.0, 0.7, 0.0, 2.1]


def _nodes(thing: bpy.types.Object) -> tuple:
    """A modifier of Geometry Nodes on an object: its tree, the input and the output."""
    tree = bpy.data.node_groups.new("Copies", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        add_geometry_socket(tree, way)
    thing.modifiers.new("Copies", "NODES").node_group = tree
    return tree, tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")


def copies(of: bpy.types.Object | None = None, places=PLACES) -> bpy.types.Object:
    """An object that shows copies of another at vertices: by attributes as large and as turned."""
    thing = scenes.mesh_object("Copies", places, [])
    for name, kind, key, values in (
        ("size", "FLOAT", "value", np.resize(SIZES, len(places))),
        ("turn", "FLOAT_VECTOR", "vector",
         np.column_stack([np.zeros((len(places), 2)), np.resize(TURNS, len(places))])),
    ):  # fmt: skip
        data = thing.data.attributes.new(name, kind, "POINT").data
        data.foreach_set(key, values.astype(np.float32).ravel())
    tree, given, taken = _nodes(thing)
    make = tree.nodes.new("GeometryNodeInstanceOnPoints")
    tree.links.new(given.outputs[0], make.inputs["Points"])
    if of is None:
        shape = tree.nodes.new("GeometryNodeMeshIcoSphere")
        shape.inputs["Subdivisions"].default_value = 3
        tree.links.new(shape.outputs["Mesh"], make.inputs["Instance"])
    else:
        info = tree.nodes.new("GeometryNodeObjectInfo")
        info.inputs["Object"].default_value = of
        info.inputs["As Instance"].default_value = True
        tree.links.new(info.outputs["Geometry"], make.inputs["Instance"])
    for name, kind, socket in (("size", "FLOAT", "Scale"), ("turn", "FLOAT_VECTOR", "Rotation")):
        read = tree.nodes.new("GeometryNodeInputNamedAttribute")
        read.data_type = kind
        read.inputs["Name"].default_value = name
        value = next(output for output in read.outputs if output.name == "Attribute"
                     and output.enabled)  # fmt: skip
        tree.links.new(value, make.inputs[socket])
    tree.links.new(make.outputs[0], taken.inputs[0])
    return scenes.activate(thing)


def shown(thing: bpy.types.Object) -> list[np.ndarray]:
    """The vertices of every instance of a mesh that Blender shows of an object, in the world."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    found = []
    for instance in depsgraph.object_instances:
        if instance.is_instance and instance.parent.original == thing:
            matrix = np.array(instance.matrix_world, dtype=float)
            places = np.array([v.co[:] for v in instance.object.data.vertices], dtype=float)
            found.append(places @ matrix[:3, :3].T + matrix[:3, 3])
    return found


def blocks() -> dict[str, int]:
    kinds = ("meshes", "objects", "node_groups", "scenes", "collections")
    return {kind: len(getattr(bpy.data, kind)) for kind in kinds}


def assert_each_filled(result: bpy.types.Object, bodies: list[np.ndarray], spacing: float) -> None:
    """One closed line on every body, and none that goes from one to another; as long as its
    surface asks for at that spacing."""
    lines = scenes.world_splines(result)
    assert len(lines) == len(bodies)
    for body in bodies:
        middle = body.mean(axis=0)
        radius = np.linalg.norm(body - middle, axis=1).max()
        mine = [(points, cyclic) for points, cyclic in lines
                if np.linalg.norm(points - middle, axis=1).max() < 1.01 * radius]  # fmt: skip
        assert len(mine) == 1 and mine[0][1]
        points = np.vstack([mine[0][0], mine[0][0][:1]])
        assert np.linalg.norm(points - middle, axis=1).min() > 0.9 * radius
        length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
        area = 4.0 * np.pi * radius**2
        assert 0.8 < length * spacing / area < 1.1


def test_each_instance_is_filled_by_itself() -> None:
    thing = copies()
    thing.location, thing.rotation_euler = (1.0, 2.0, 3.0), (0.3, 0.0, 0.0)
    bpy.context.view_layer.update()
    bodies, before = shown(thing), blocks()
    result = scenes.fill(thing, 0.3)
    assert len(bodies) == 4
    assert_each_filled(result, bodies, 0.3)
    assert "filled 4 instances, each by itself" in result.meander.figures.preparation
    after = blocks()
    assert after["objects"] == before["objects"] + 1
    assert all(after[kind] == before[kind] for kind in after if kind != "objects")
    # Filled again and gone on with, it is the same curve object.
    scenes.activate(result)
    assert bpy.ops.meander.run() == {"FINISHED"}
    assert_each_filled(result, bodies, 0.3)


def test_triangles_are_those_of_the_instances() -> None:
    thing = copies()
    bodies = np.vstack(shown(thing))
    depsgraph = bpy.context.evaluated_depsgraph_get()
    vertices, faces = triangles_of(thing, depsgraph)
    order, wanted = np.lexsort(np.round(vertices, 3).T), np.lexsort(np.round(bodies, 3).T)
    assert np.allclose(vertices[order], bodies[wanted], atol=1e-4)
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    volume = (corners[:, 0] * normals).sum() / 6.0
    wanted_volume = 4.0 / 3.0 * np.pi * sum(size**3 for size in SIZES)
    assert 0.9 < volume / wanted_volume < 1.0, "faces look outward"
    # Hidden, it is the same.
    thing.hide_viewport = True
    again, _faces = triangles_of(thing, bpy.context.evaluated_depsgraph_get())
    assert np.allclose(again, vertices, atol=1e-6)


def test_instances_of_an_object_keep_what_it_has_painted() -> None:
    ball = scenes.sphere()
    dense = ball.data.attributes.new("Dense", "FLOAT", "POINT")
    dense.data.foreach_set("value", [float(v.co.z > 0.0) for v in ball.data.vertices])
    thing = copies(of=ball, places=PLACES[:2])
    ball.hide_viewport = True
    plain = scenes.fill(thing, 0.4)
    plain_length = plain.meander.figures.length
    painted = scenes.fill(thing, 0.4, density_source="ATTRIBUTE", density_attribute="Dense")
    assert painted.meander.figures.length > 1.3 * plain_length


def test_a_collection_that_an_empty_shows_is_filled() -> None:
    ball, other = scenes.sphere(), scenes.sphere(0.5)
    other.location = (3.0, 0.0, 0.0)
    stones = bpy.data.collections.new("Stones")
    for each in (ball, other):
        bpy.context.scene.collection.objects.unlink(each)
        stones.objects.link(each)
    bpy.context.scene.collection.children.link(stones)
    bpy.context.view_layer.update()
    scenes.fill(ball, 0.5)  # whose line lies in the collection then, and is no surface
    stones.instance_offset = (1.0, 0.0, 0.0)
    empty = bpy.data.objects.new("Shown", None)
    empty.instance_type, empty.instance_collection = "COLLECTION", stones
    bpy.context.scene.collection.objects.link(empty)
    empty.location, empty.scale = (0.0, 0.0, 9.0), (2.0, 2.0, 2.0)
    scenes.activate(empty)
    before = blocks()
    result = scenes.fill(empty, 0.4)
    bodies = [
        size * 2.0 * np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]) + middle
        for size, middle in ((1.0, (-2.0, 0.0, 9.0)), (0.5, (4.0, 0.0, 9.0)))
    ]
    assert_each_filled(result, bodies, 0.4)
    assert result.parent == empty and blocks()["meshes"] == before["meshes"]
    for active in (empty, result):
        scenes.activate(active)
        for source in ("GROUP", "IMAGE", "COLOR", "NONE"):
            empty.meander.density_source = source
            for panel in panels():
                drawn(panel, bpy.context)


def test_copies_of_one_size_have_one_line_and_those_that_touch_their_own() -> None:
    blocks = scenes.cube()
    blocks.location = (50.0, 0.0, 0.0)
    places = [(2.0 * i, 2.0 * j, 0.0) for i in range(3) for j in range(2)]
    thing = copies(of=blocks, places=places)
    for size in thing.data.attributes["size"].data:
        size.value = 1.0
    for turn in thing.data.attributes["turn"].data:
        turn.vector = (0.0, 0.0, 0.0)
    result = scenes.fill(thing, 0.4)
    lines = [points - points.mean(axis=0) for points, cyclic in scenes.world_splines(result)]
    assert len(lines) == 6 and len({len(points) for points in lines}) == 1
    assert all(np.abs(points - lines[0]).max() < 1e-4 for points in lines)
    assert "6 parts" in result.meander.figures.lines_why
    scenes.activate(result)
    assert bpy.ops.meander.run() == {"FINISHED"}  # goes on with all of them
    assert len(result.data.splines) == 6
    scenes.activate(result)
    with pytest.raises(RuntimeError, match="Instances that touch are one mesh for a cut"):
        bpy.ops.meander.two_tone()


def test_what_has_faces_of_its_own_is_filled_without_its_instances() -> None:
    thing = copies()
    tree = thing.modifiers[0].node_group
    join = tree.nodes.new("GeometryNodeJoinGeometry")
    cube = tree.nodes.new("GeometryNodeMeshCube")
    end = next(node for node in tree.nodes if node.bl_idname == "NodeGroupOutput")
    tree.links.new(end.inputs[0].links[0].from_socket, join.inputs[0])
    tree.links.new(cube.outputs[0], join.inputs[0])
    tree.links.new(join.outputs[0], end.inputs[0])
    result = scenes.fill(thing, 0.2)
    assert len(result.data.splines) == 1
    assert "left out instances, which a Realize" in result.meander.figures.preparation


def _points_only() -> bpy.types.Object:
    thing = scenes.mesh_object("Points", PLACES, [])
    tree, given, taken = _nodes(thing)
    make = tree.nodes.new("GeometryNodeMeshToPoints")
    tree.links.new(given.outputs[0], make.inputs[0])
    tree.links.new(make.outputs[0], taken.inputs[0])
    return thing


def test_points_without_a_mesh_say_what_to_do() -> None:
    said = scenes.refused(_points_only())
    assert_sentence(said)
    assert "shows points only" in said and "Instance on Points node with a mesh" in said
    cloud = bpy.data.objects.new("Cloud", bpy.data.pointclouds.new("Cloud"))
    bpy.context.scene.collection.objects.link(cloud)
    said = scenes.refused(cloud)
    assert_sentence(said)
    assert "has points only" in said
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT"))
    bpy.context.scene.collection.objects.link(lamp)
    said = scenes.refused(copies(of=lamp))
    assert_sentence(said)
    assert "none of them of a mesh" in said or "has no faces" in said


def test_more_than_can_be_filled_is_a_sentence(monkeypatch) -> None:
    thing = copies()
    monkeypatch.setattr(instances, "MOST_COPIES", 3)
    said = scenes.refused(thing)
    assert_sentence(said)
    assert "shows 4 instances with 1,280 faces, and at most 3 with" in said


def test_frames_are_baked_and_nothing_follows_in_the_view() -> None:
    thing = copies(places=PLACES[:2])
    thing.keyframe_insert("location", frame=1)
    thing.location = (0.0, 0.0, 5.0)
    thing.keyframe_insert("location", frame=3)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 3
    scene.frame_set(1)
    result = scenes.fill(thing, 0.4, motion="STICK")
    with pytest.raises(DataError, match="bake the frames") as refusal:
        surface_now(thing, bpy.context.evaluated_depsgraph_get())
    assert_sentence(str(refusal.value))
    scenes.activate(result)
    assert bpy.ops.meander.bake_motion() == {"FINISHED"}


def test_the_batch_command_fills_instances(tmp_path: Path) -> None:
    thing = copies()
    bodies = shown(thing)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "in.blend"))
    output = tmp_path / "out.blend"
    given = ("--input", tmp_path / "in.blend", "--object", thing.name, "--spacing", "0.3")
    done = run_alone(*given, "--output", output)
    assert done.returncode == 0, done.stderr
    assert "filled 4 instances, each by itself" in done.stdout
    bpy.ops.wm.open_mainfile(filepath=str(output))
    assert_each_filled(bpy.data.objects["Copies Meander"], bodies, 0.3)
