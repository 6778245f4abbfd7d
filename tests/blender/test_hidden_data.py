# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that Blender does not keep evaluated, since nothing shows them, are as they would be if
they were shown: surfaces, seeds, parents and modifiers, at the frame that is asked for."""

from __future__ import annotations

from collections.abc import Callable

import bpy
import numpy as np
import pytest
from meander import core
from meander.model.alignment import Alignment
from meander.run import bake
from meander.scene import alignment, curve_reader, density, evaluated, meshes
from meander.scene.errors import DataError
from scenes import activate, circle_points, counts, fill, poly_curve, sphere, world_splines

FRAME = 10


def depsgraph() -> bpy.types.Depsgraph:
    return bpy.context.evaluated_depsgraph_get()


def at_frame(frame: int = FRAME) -> None:
    bpy.context.scene.frame_set(frame)


def keyed(thing: bpy.types.Object) -> bpy.types.Object:
    """7 to the right at frame 10."""
    for frame, x in ((1, 0.0), (FRAME, 7.0)):
        thing.location.x = x
        thing.keyframe_insert("location", frame=frame)
    return thing


def animated_ring() -> bpy.types.Object:
    """At frame 10 it is 7 to the right and three times as tall."""
    bpy.ops.mesh.primitive_torus_add(major_segments=16, minor_segments=8)
    ring = bpy.context.object
    ring.shape_key_add(name="Basis")
    tall = ring.shape_key_add(name="Tall")
    for point in tall.data:
        point.co.z *= 3.0
    for frame, value in ((1, 0.0), (FRAME, 1.0)):
        tall.value = value
        tall.keyframe_insert("value", frame=frame)
    return keyed(ring)


def in_collection(thing: bpy.types.Object) -> bpy.types.Collection:
    own = bpy.data.collections.new("Own")
    bpy.context.scene.collection.children.link(own)
    for other in list(thing.users_collection):
        other.objects.unlink(thing)
    own.objects.link(thing)
    return own


def layer_of(collection: bpy.types.Collection) -> bpy.types.LayerCollection:
    return bpy.context.view_layer.layer_collection.children[collection.name]


def hide_in_viewports(thing: bpy.types.Object) -> None:
    thing.hide_viewport = True


def hide_by_the_eye(thing: bpy.types.Object) -> None:
    thing.hide_set(True)


def hide_by_a_collection(thing: bpy.types.Object) -> None:
    in_collection(thing).hide_viewport = True


def hide_by_the_eye_of_a_collection(thing: bpy.types.Object) -> None:
    layer_of(in_collection(thing)).hide_viewport = True


def exclude(thing: bpy.types.Object) -> None:
    layer_of(in_collection(thing)).exclude = True


HIDING: list[Callable[[bpy.types.Object], None]] = [
    hide_in_viewports,
    hide_by_the_eye,
    hide_by_a_collection,
    hide_by_the_eye_of_a_collection,
    exclude,
]


@pytest.fixture(params=HIDING, ids=lambda way: way.__name__)
def hide(request: pytest.FixtureRequest) -> Callable[[bpy.types.Object], None]:
    return request.param


def shown_then_hidden(thing, hide, read):
    """What `read` gives of a thing at the frame while it is shown, and after it was hidden at
    frame 1."""
    at_frame()
    shown = read(thing)
    at_frame(1)
    hide(thing)
    at_frame()
    before = counts()
    hidden = read(thing)
    assert counts() == before
    assert len(bpy.data.scenes) == 1
    return shown, hidden


def test_a_surface_that_moves_and_changes_its_shape(hide):
    shown, hidden = shown_then_hidden(
        animated_ring(), hide, lambda thing: meshes.triangles_of(thing, depsgraph())
    )
    assert 5.0 < shown[0][:, 0].min() and shown[0][:, 0].max() < 9.0
    assert np.array_equal(shown[0], hidden[0]) and np.array_equal(shown[1], hidden[1])


def test_the_matrix_of_a_surface(hide):
    shown, hidden = shown_then_hidden(
        animated_ring(), hide, lambda thing: evaluated.matrix_of(thing, depsgraph())
    )
    assert shown[0, 3] == 7.0
    assert np.array_equal(shown, hidden)


def test_a_parent_that_moves_and_is_hidden_too(hide):
    parent = keyed(sphere(0.1))
    child = sphere()
    child.parent = parent
    at_frame()
    shown = meshes.triangles_of(child, depsgraph())[0]
    at_frame(1)
    hide(child)
    parent.hide_viewport = True
    at_frame()
    assert np.array_equal(shown, meshes.triangles_of(child, depsgraph())[0])


def test_what_a_modifier_points_at_moves_and_is_hidden_too(hide):
    target = keyed(sphere(0.5))
    surface = sphere()
    surface.modifiers.new("Mirror", "MIRROR").mirror_object = target
    shown, hidden = shown_then_hidden(
        surface, hide, lambda thing: meshes.triangles_of(thing, depsgraph())[0]
    )
    target.hide_viewport = True
    assert shown[:, 0].max() > 10.0
    assert np.array_equal(shown, hidden)


@pytest.mark.parametrize("kind", ["POLY", "NURBS"])
def test_a_seed(hide, kind):
    curve = keyed(poly_curve("Seed", [circle_points(1.0, 0.0)], True))
    curve.data.splines[0].type = kind
    shown, hidden = shown_then_hidden(
        curve, hide, lambda thing: curve_reader.strands_of_curve(thing, depsgraph()).points
    )
    assert shown[:, 0].min() > 5.0
    assert np.array_equal(shown, hidden)


def test_a_density_that_modifiers_make(hide):
    surface = animated_ring()
    group = surface.vertex_groups.new(name="Group")
    group.add(range(20), 1.0, "REPLACE")
    edit = surface.modifiers.new("Edit", "VERTEX_WEIGHT_EDIT")
    edit.vertex_group, edit.use_add, edit.add_threshold = "Group", True, 0.0
    edit.default_weight = 0.25
    for frame, value in ((1, 0.1), (FRAME, 0.75)):
        edit.default_weight = value
        edit.keyframe_insert("default_weight", frame=frame)
    shown, hidden = shown_then_hidden(
        surface, hide, lambda thing: meshes.vertex_group_weights(thing, depsgraph(), "Group")
    )
    assert shown.min() == pytest.approx(0.75)
    assert np.array_equal(shown, hidden)


def test_directions_of_a_hidden_curve(hide):
    surface = sphere()
    strokes = keyed(poly_curve("Strokes", [circle_points(0.7, -0.7)], True))
    choice = Alignment(source="STROKES", name=strokes.name)

    def directions(_strokes: bpy.types.Object) -> np.ndarray:
        compute = alignment.directions_of(choice, surface, depsgraph(), 0.1)
        with core.Surface(*meshes.triangles_of(surface, depsgraph())) as whole:
            return compute(whole, None)

    shown, hidden = shown_then_hidden(strokes, hide, directions)
    assert np.abs(shown).max() > 0.5
    assert np.array_equal(shown, hidden)


def test_what_is_not_keyed_stays_as_the_user_has_it():
    """An evaluation of the whole frame would put another object back to its keys."""
    posed = keyed(sphere())
    surface = animated_ring()
    hide_in_viewports(surface)
    at_frame()
    posed.location.x = 3.0
    meshes.triangles_of(surface, depsgraph())
    bpy.context.view_layer.update()
    assert posed.location.x == 3.0
    assert posed.evaluated_get(depsgraph()).matrix_world.translation.x == 3.0


def test_what_its_animation_hides_is_named():
    surface = animated_ring()
    for frame, hidden in ((1, False), (FRAME, True)):
        surface.hide_viewport = hidden
        surface.keyframe_insert("hide_viewport", frame=frame)
    at_frame(1)
    assert len(meshes.triangles_of(surface, depsgraph())[0])
    at_frame()
    with pytest.raises(DataError, match="hidden by its animation at frame 10"):
        meshes.triangles_of(surface, depsgraph())
    assert len(bpy.data.scenes) == 1


def test_a_curve_on_a_hidden_surface_lies_on_it_when_it_is_shown():
    surface = animated_ring()
    at_frame()
    fill(surface, 1.0)
    (shown,) = (thing for thing in bpy.data.objects if thing.type == "CURVE")
    wanted = [points for points, _closed in world_splines(shown)]
    bpy.data.objects.remove(shown)
    at_frame(1)
    hide_in_viewports(surface)
    at_frame()
    activate(surface)
    result = fill(surface, 1.0)
    surface.hide_viewport = False
    at_frame()
    found = [points for points, _closed in world_splines(result)]
    assert len(found) == len(wanted)
    for ours, theirs in zip(found, wanted):
        assert np.abs(ours - theirs).max() < 1e-5


def test_frames_of_a_hidden_surface_are_baked_as_those_of_a_shown_one():
    surface = animated_ring()
    at_frame(1)
    result = fill(surface, 1.0)
    result.meander.motion = "STICK"
    places = []
    for hidden in (False, True):
        at_frame(1)
        surface.hide_viewport = hidden
        bake.bake_motion(result, bpy.context, 1, FRAME)
        at_frame()
        baked = result.meander.bake.objects[0]
        places.append(curve_reader.strands_of_curve(baked, depsgraph()).points)
    surface.hide_viewport = False
    assert np.ptp(places[0][:, 2]) > 1.0
    assert np.allclose(places[0], places[1], atol=1e-4)


def test_densities_of_a_hidden_surface_that_names_no_group_are_refused_as_ever():
    surface = animated_ring()
    hide_in_viewports(surface)
    choice = density.Choice(source="GROUP", name="None")
    with pytest.raises(DataError, match="no vertex group"):
        density.density_of(choice, surface, depsgraph(), 0.1)
