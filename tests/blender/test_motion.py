# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves on surfaces that move: followed while frames change, and baked into the file."""

from __future__ import annotations

import bpy
import geometry
import numpy as np
import pytest
import scenes
from mathutils.bvhtree import BVHTree
from meander.scene import drawn_line
from meander.ui.motion import MEANDER_PT_motion
from panel_layout import drawn

# Points that nearly coincide are one in what is written: half a hundredth of the spacing, and some.
ON_SURFACE = 0.006


def _tube(frames: int = 8) -> bpy.types.Object:
    """A tube that is stretched to 1.6 of its length and bent, by shape keys, over the frames."""
    vertices, faces = geometry.tube(24, 16, 4.0)
    thing = scenes.mesh_object("Tube", vertices, faces)
    thing.shape_key_add(name="Basis")
    key = thing.shape_key_add(name="Bent", from_mix=False)
    angle = 0.15 * 1.6 * vertices[:, 2]
    moved = np.column_stack(
        [vertices[:, 0] + 1.6 * angle, vertices[:, 1], 1.6 * vertices[:, 2] - 0.1 * vertices[:, 0]]
    )
    key.data.foreach_set("co", moved.astype(np.float32).ravel())
    key.value = 0.0
    key.keyframe_insert("value", frame=1)
    key.value = 1.0
    key.keyframe_insert("value", frame=frames)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, frames
    scene.frame_set(1)
    return thing


@pytest.fixture
def tube() -> bpy.types.Object:
    return _tube()


@pytest.fixture
def result(tube: bpy.types.Object) -> bpy.types.Object:
    return scenes.fill(tube, 0.6)


def test_follow_keeps_the_spacing_and_the_surface(
    tube: bpy.types.Object, result: bpy.types.Object
) -> None:
    before = scenes.length_of(result)
    bpy.context.scene.frame_set(2)
    assert scenes.length_of(result) == pytest.approx(before)  # off by default
    bpy.context.scene.frame_set(1)
    result.meander.follow = True
    result.meander.motion_steps = 8
    strands = len(result.data.splines)
    for frame in range(2, 9):
        bpy.context.scene.frame_set(frame)
        assert scenes.farthest_from(tube, result) < ON_SURFACE
        assert 0.9 < scenes.packing(tube, result) < 1.1
    assert len(result.data.splines) == strands
    assert scenes.length_of(result) > 1.3 * before
    # What a file keeps is the switch; the rest begins again from the curve as it is.
    from meander.run import motion as following

    following.forget()
    bpy.context.scene.frame_set(7)
    assert scenes.farthest_from(tube, result) < ON_SURFACE
    result.meander.follow = False
    now = scenes.length_of(result)
    bpy.context.scene.frame_set(1)
    assert scenes.length_of(result) == pytest.approx(now, rel=1e-5)


def test_a_file_goes_on_following_wherever_it_jumps(
    tube: bpy.types.Object, result: bpy.types.Object, tmp_path
) -> None:
    result.meander.follow = True
    result.meander.motion_steps = 30
    path = scenes.saved(tmp_path / "following.blend")
    bpy.ops.wm.open_mainfile(filepath=str(path))
    tube, result = bpy.data.objects["Tube"], bpy.data.objects["Tube Meander"]
    bpy.context.scene.frame_set(8)
    assert scenes.farthest_from(tube, result) < ON_SURFACE
    assert 0.9 < scenes.packing(tube, result) < 1.1


def test_follow_can_stick(tube: bpy.types.Object, result: bpy.types.Object) -> None:
    result.meander.motion = "STICK"
    result.meander.follow = True
    count = len(scenes.points_of(result))
    bpy.context.scene.frame_set(6)
    assert len(scenes.points_of(result)) == count
    start = scenes.points_of(result)
    vertices, faces = scenes.world_triangles(tube)
    tree = BVHTree.FromPolygons(vertices.tolist(), faces.tolist())
    assert max(tree.find_nearest(point)[3] for point in start.tolist()) < 1e-4
    bpy.context.scene.frame_set(1)
    bpy.context.scene.frame_set(6)
    assert np.allclose(scenes.points_of(result), start, atol=1e-5)
    # Another choice holds from the next frame on.
    result.meander.motion = "EVEN"
    bpy.context.scene.frame_set(7)
    assert len(scenes.points_of(result)) != count


def test_a_mesh_that_changes_is_a_sentence_in_the_panel(
    tube: bpy.types.Object, result: bpy.types.Object
) -> None:
    from meander.run import motion as following

    result.meander.follow = True
    bpy.context.scene.frame_set(2)
    before = scenes.length_of(result)
    finer = tube.modifiers.new("Finer", "SUBSURF")
    finer.levels = finer.render_levels = 1
    bpy.context.scene.frame_set(3)
    problem = following.problem_of(result)
    assert "modifiers" in problem
    assert scenes.length_of(result) == pytest.approx(before)
    tube.modifiers.clear()
    bpy.context.scene.frame_set(2)


@pytest.mark.parametrize("motion", ["EVEN", "STICK"])
def test_other_faces_between_as_many_vertices_are_a_sentence(
    tube: bpy.types.Object, result: bpy.types.Object, motion: str
) -> None:
    from meander.run import motion as following

    result.meander.motion = motion
    result.meander.follow = True
    bpy.context.scene.frame_set(2)
    before = scenes.points_of(result)
    # As many triangles, but between other vertices.
    mesh = tube.data
    corners = scenes.column(mesh.loops, "vertex_index", kind=np.int32)
    order = np.random.default_rng(1).permutation(len(mesh.vertices)).astype(np.int32)
    mesh.loops.foreach_set("vertex_index", order[corners])
    mesh.update(calc_edges=True)
    bpy.context.scene.frame_set(3)
    assert "join other vertices now" in following.problem_of(result)
    assert np.array_equal(scenes.points_of(result), before)


def _shown(collection: bpy.types.Collection) -> list[bpy.types.Object]:
    return [thing for thing in collection.objects if not thing.hide_render]


def test_baked_frames_show_one_curve_each(
    tube: bpy.types.Object, result: bpy.types.Object
) -> None:
    before = scenes.length_of(result)
    result.meander.motion_steps = 8
    assert bpy.ops.meander.bake_motion(frame_start=1, frame_end=5) == {"FINISHED"}
    collection = result.meander.bake
    assert bpy.context.scene.frame_current == 1
    assert result.hide_render
    assert len(collection.objects) == 5
    for frame in (1, 2, 5, 3, 4):
        bpy.context.scene.frame_set(frame)
        shown = _shown(collection)
        assert [thing.name for thing in shown] == [f"{result.name} {frame:04d}"]
        assert not shown[0].hide_viewport
        assert scenes.farthest_from(tube, shown[0]) < ON_SURFACE
        packing = scenes.length_of(shown[0]) * 0.6 / scenes.area_of(tube)
        assert 0.9 < packing < 1.1
    assert scenes.length_of(result) == pytest.approx(before)  # the curve itself is as it was
    scenes.activate(result)
    assert bpy.ops.meander.clear_bake() == {"FINISHED"}
    assert not result.hide_render
    assert result.meander.bake is None
    assert not [item for item in bpy.data.curves if "0003" in item.name]


def test_sticking_bake_is_one_curve_with_shape_keys(
    tube: bpy.types.Object, result: bpy.types.Object
) -> None:
    result.meander.motion = "STICK"
    count = len(scenes.points_of(result))
    assert bpy.ops.meander.bake_motion(frame_start=1, frame_end=6) == {"FINISHED"}
    (shown,) = result.meander.bake.objects
    assert len(shown.data.shape_keys.key_blocks) == 6
    seen = {}
    for frame in (1, 4, 6):
        bpy.context.scene.frame_set(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        evaluated = shown.evaluated_get(depsgraph)
        mesh = evaluated.to_mesh()
        local = np.array([vertex.co[:] for vertex in mesh.vertices])
        evaluated.to_mesh_clear()
        assert len(local) == count
        matrix = scenes.matrix_of(shown)
        seen[frame] = local @ matrix[:3, :3].T + matrix[:3, 3]
        vertices, faces = scenes.world_triangles(tube)
        tree = BVHTree.FromPolygons(vertices.tolist(), faces.tolist())
        assert max(tree.find_nearest(point)[3] for point in seen[frame].tolist()) < ON_SURFACE
    assert np.abs(seen[6] - seen[1]).max() > 0.5


def test_a_sticking_bake_goes_by_way_of_subframes(
    tube: bpy.types.Object, result: bpy.types.Object
) -> None:
    """A shape key that is driven in a curve: between two frames the points are where it leads."""
    key = tube.data.shape_keys.key_blocks["Bent"]
    driver = key.driver_add("value").driver
    driver.type, driver.expression = "SCRIPTED", "((frame - 1) % 1) * 2"
    bpy.context.scene.frame_set(1, subframe=0.0)
    apart = {}
    for subframes in (0, 1, 3):
        settings = result.meander
        settings.motion, settings.motion_subframes = "STICK", subframes
        assert bpy.ops.meander.bake_motion(frame_start=1, frame_end=3) == {"FINISHED"}
        (shown,) = settings.bake.objects
        blocks = shown.data.shape_keys.key_blocks
        assert len(blocks) == 2 * (subframes + 1) + 1
        bpy.context.scene.frame_set(1, subframe=0.5)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        mesh = shown.evaluated_get(depsgraph).to_mesh()
        local = np.array([vertex.co[:] for vertex in mesh.vertices])
        matrix = scenes.matrix_of(shown)
        points = local @ matrix[:3, :3].T + matrix[:3, 3]
        vertices, faces = scenes.world_triangles(tube)
        tree = BVHTree.FromPolygons(vertices.tolist(), faces.tolist())
        apart[subframes] = max(tree.find_nearest(point)[3] for point in points.tolist())
        bpy.context.scene.frame_set(1, subframe=0.0)
        assert bpy.ops.meander.clear_bake() == {"FINISHED"}
        scenes.activate(result)
    assert apart[0] > 0.1 and apart[1] < ON_SURFACE and apart[3] < ON_SURFACE


def test_an_even_bake_goes_by_way_of_subframes_and_writes_whole_frames(
    tube: bpy.types.Object, result: bpy.types.Object
) -> None:
    bpy.context.scene.frame_set(1, subframe=0.25)
    result.meander.motion_steps, result.meander.motion_subframes = 1, 2
    assert bpy.ops.meander.bake_motion(frame_start=1, frame_end=4) == {"FINISHED"}
    assert bpy.context.scene.frame_current_final == 1.25
    names = sorted(thing.name[-4:] for thing in result.meander.bake.objects)
    assert names == ["0001", "0002", "0003", "0004"]


@pytest.mark.parametrize("looks", [False, True])
def test_growth_is_animated_in_one_object(tube: bpy.types.Object, looks: bool) -> None:
    scene = bpy.context.scene
    scene.frame_start = 10
    result = scenes.fill(tube, 0.6, use_bevel=looks, use_outline=True)
    # With a look the line is drawn with round turns.
    seen = drawn_line.drawn_of(result) or result
    expected = [points for points, _cyclic in scenes.world_splines(seen)]
    assert bpy.ops.meander.animate_growth(frames=40) == {"FINISHED"}
    (shown,) = result.meander.bake.objects
    assert result.hide_viewport and shown.parent == tube
    for modifier in list(shown.modifiers)[1:]:
        assert looks
        shown.modifiers.remove(modifier)
    lengths, strands = [], set()
    for frame in (10, 15, 20, 25, 30, 35, 40, 49):
        scene.frame_set(frame)
        evaluated = shown.evaluated_get(bpy.context.evaluated_depsgraph_get())
        mesh = evaluated.to_mesh()
        points = np.array([vertex.co[:] for vertex in mesh.vertices])
        ends = np.array([edge.vertices[:] for edge in mesh.edges])
        lengths.append(np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1).sum())
        strands.add(scenes.pieces_of(mesh))
        evaluated.to_mesh_clear()
    assert strands == {3}  # the curve, and one strand along each end, in every frame
    assert len(points) == sum(len(strand) for strand in expected)
    assert np.allclose(points, np.vstack(expected), atol=1e-5)
    # It grows evenly with the frames; at its end it gets even, which changes little.
    assert lengths[0] < 0.5 * lengths[-1]
    steps = np.diff(lengths[:-1]) / lengths[-1]
    assert steps.min() > 0.0 and steps.max() < 2.5 * np.median(steps)
    scenes.activate(tube)
    assert bpy.ops.meander.clear_bake() == {"FINISHED"}
    assert not result.hide_viewport and result.meander.bake is None


def _spacings_from_the_ends(tube: bpy.types.Object, curve: bpy.types.Object) -> float:
    """How far the strands nearest to the ends of the tube are from them, in the middle."""
    vertices, _faces = scenes.world_triangles(tube)
    ends = np.vstack([vertices[:24], vertices[-24:]])
    points = scenes.points_of(curve)
    nearest = [np.linalg.norm(points - end, axis=1).min() for end in ends]
    return float(np.median(nearest)) / curve.meander.spacing


def test_growth_has_the_outline_of_the_run(tube: bpy.types.Object) -> None:
    result = scenes.fill(tube, 0.6, use_outline=True)
    assert len(result.data.splines) == 3  # the curve, and one strand along each end
    assert bpy.ops.meander.bake_growth(every=20) == {"FINISHED"}
    frames = list(result.meander.bake.objects)
    assert {len(frame.data.splines) for frame in frames} == {3}
    lengths = [scenes.length_of(frame) for frame in frames]
    assert len(lengths) > 3 and lengths[0] < lengths[1] < lengths[2]
    # The same iterations, so the last frame is the curve that the run came to.
    assert np.allclose(scenes.points_of(frames[-1]), scenes.points_of(result), rtol=0.0, atol=1e-5)


def test_growth_leaves_guides_out_as_the_result_does(tube: bpy.types.Object) -> None:
    result = scenes.fill(tube, 0.6, use_outline=True, keep_guides=False)
    assert len(result.data.splines) == 1
    assert _spacings_from_the_ends(tube, result) > 1.1
    assert bpy.ops.meander.bake_growth(every=20) == {"FINISHED"}
    last = list(result.meander.bake.objects)[-1]
    assert np.allclose(scenes.points_of(last), scenes.points_of(result), rtol=0.0, atol=1e-5)


@pytest.mark.parametrize("radius_follows", [False, True])
def test_a_follower_keeps_clear_of_an_outline_that_is_not_shown(
    tube: bpy.types.Object, radius_follows: bool
) -> None:
    result = scenes.fill(
        tube,
        0.6,
        use_outline=True,
        keep_guides=False,
        radius_follows=radius_follows,
    )
    before = _spacings_from_the_ends(tube, result)
    assert before > 1.1
    result.meander.motion_steps = 8
    result.meander.follow = True
    for frame in range(2, 9):
        bpy.context.scene.frame_set(frame)
    assert len(result.data.splines) == 1
    # Without the outline the flow would fill up to half a spacing from the ends.
    assert _spacings_from_the_ends(tube, result) > 1.1
    result.meander.follow = False


def test_bake_refuses_with_one_sentence_and_bakes_nothing(
    tube: bpy.types.Object, result: bpy.types.Object
) -> None:
    bpy.context.scene.frame_set(8)  # the curve belongs to frame 1
    before = scenes.counts()
    with pytest.raises(RuntimeError, match="frame in which it was made"):
        bpy.ops.meander.bake_motion(frame_start=1, frame_end=3)
    assert scenes.counts() == before
    assert not result.hide_render


def test_a_refused_bake_leaves_the_one_before(
    tube: bpy.types.Object, result: bpy.types.Object
) -> None:
    assert bpy.ops.meander.bake_motion(frame_start=1, frame_end=3) == {"FINISHED"}
    bake, before = result.meander.bake, scenes.counts()
    names = sorted(thing.name for thing in bake.objects)
    finer = tube.modifiers.new("Finer", "SUBSURF")
    finer.levels = finer.render_levels = 0
    finer.keyframe_insert("levels", frame=2)
    finer.levels = 1
    finer.keyframe_insert("levels", frame=3)  # other faces from here on
    bpy.context.scene.frame_set(1)
    before = scenes.counts()
    with pytest.raises(RuntimeError, match="only its shape may change"):
        bpy.ops.meander.bake_motion(frame_start=1, frame_end=3)
    assert scenes.counts() == before and result.meander.bake == bake
    assert sorted(thing.name for thing in bake.objects) == names
    assert result.hide_viewport and result.hide_render
    tube.animation_data_clear()
    tube.modifiers.clear()
    # The one that replaces it has its names.
    assert bpy.ops.meander.bake_motion(frame_start=1, frame_end=3) == {"FINISHED"}
    assert sorted(thing.name for thing in result.meander.bake.objects) == names
    assert bpy.data.collections[f"{result.name} Frames"] == result.meander.bake


def test_who_gets_the_name_of_a_deleted_curve_follows_its_own_surface(
    tube: bpy.types.Object, result: bpy.types.Object
) -> None:
    from meander.run import motion as following

    other_tube = _tube()
    other_tube.location.x = 10.0
    other = scenes.fill(other_tube, 0.6)
    for thing in (result, other):
        thing.meander.follow = True
    bpy.context.scene.frame_set(2)
    assert len(following._followers) == 2
    name = result.name
    bpy.data.objects.remove(result)
    other.name = name
    assert other.name == name
    bpy.context.scene.frame_set(3)
    assert len(following._followers) == 1, "the flow of what was deleted stays"
    assert following.problem_of(other) is None
    assert scenes.farthest_from(other_tube, other) < ON_SURFACE


@pytest.mark.parametrize("operator", ["bake_growth", "animate_growth"])
def test_growth_of_a_symmetric_curve_is_symmetric(operator: str) -> None:
    ball = scenes.sphere(subdivisions=4)
    ball.meander.mirror = "X"
    result = scenes.fill(ball, 0.4)
    how = {"every": 10} if operator == "bake_growth" else {"frames": 10}
    assert getattr(bpy.ops.meander, operator)(**how) == {"FINISHED"}
    for shown in result.meander.bake.objects:
        splines = shown.data.splines
        points = np.array([point.co[:3] for spline in splines for point in spline.points])
        images = points * [-1.0, 1.0, 1.0]
        far = np.linalg.norm(points[:, None] - images[None], axis=2).min(axis=1)
        assert far.max() < 0.02


@pytest.mark.parametrize("chosen", ["mesh", "frame", "curve"])
def test_a_bake_can_be_deleted_from_what_is_seen(
    tube: bpy.types.Object, result: bpy.types.Object, chosen: str
) -> None:
    scenes.activate(result)
    bpy.ops.meander.bake_motion(frame_start=1, frame_end=3)
    assert bpy.context.view_layer.objects.active == tube, "the panel is empty for a hidden curve"
    frame = result.meander.bake.objects[0]
    scenes.sphere()
    assert not bpy.ops.meander.clear_bake.poll(), "this mesh has nothing to do with it"
    assert drawn(MEANDER_PT_motion, bpy.context) is None
    scenes.activate({"mesh": tube, "frame": frame, "curve": result}[chosen])
    texts = [text.text for text in drawn(MEANDER_PT_motion, bpy.context).texts()]
    assert "Delete Bake" in texts
    assert bpy.ops.meander.clear_bake() == {"FINISHED"}
    assert result.visible_get() and result.meander.bake is None
    assert bpy.context.view_layer.objects.active == (tube if chosen == "mesh" else result)
