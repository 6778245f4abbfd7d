# SPDX-License-Identifier: GPL-3.0-or-later
"""A result goes where its surface is, whatever scene or view layer the window shows by then."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import pytest
from meander.run import session
from meander.run.plan import plan_run
from meander.run.queue import Queue
from scenes import activate, fill, point_count, sphere
from watched_runs import begin, tick_until

pytestmark = pytest.mark.usefixtures("windowed", "nothing_kept")


@pytest.fixture(autouse=True)
def one_scene_left() -> Iterator[None]:
    first = bpy.context.window.scene
    yield
    bpy.context.window.scene = first
    for scene in list(bpy.data.scenes):
        if scene != first:
            bpy.data.scenes.remove(scene)


def show_other_scene() -> bpy.types.Scene:
    other = bpy.data.scenes.new("Other")
    bpy.context.window.scene = other
    return other


def in_first_scene(surface: bpy.types.Object, result: bpy.types.Object) -> bool:
    (home,) = surface.users_scene
    return result.users_scene[:] == (home,) and result.users_collection == surface.users_collection


@pytest.mark.parametrize("when", ["at once", "growing", "at the end"])
def test_another_scene_is_shown_meanwhile(when):
    surface = sphere()
    home = bpy.context.scene
    running = begin(surface, 0.2)
    if when == "at once":
        show_other_scene()
    tick_until(running, lambda: when == "growing" and running.shown_points > 0)
    if when != "at once":
        other = show_other_scene()
    tick_until(running, lambda: False)
    result, _figures = running.keep(bpy.context)
    running.end()
    other = bpy.data.scenes["Other"]
    assert bpy.context.scene == other, "what the window shows is the user's"
    assert not other.objects
    assert in_first_scene(surface, result)
    assert surface.meander.last_result == result
    assert home.view_layers[0].objects.active == result
    bpy.context.window.scene = home
    assert plan_run(bpy.context).result.find() == result, "filling again updates it"


def test_a_curve_is_continued_while_another_scene_is_shown():
    surface = sphere()
    result = fill(surface, 0.2)
    points = point_count(result)
    running = begin(surface, 0.15)
    show_other_scene()
    tick_until(running, lambda: False)
    kept, _figures = running.keep(bpy.context)
    running.end()
    assert kept == result and in_first_scene(surface, result)
    assert point_count(result) > points


def test_another_view_layer_is_shown_meanwhile():
    surface = sphere()
    own = bpy.data.collections.new("Own")
    bpy.context.scene.collection.children.link(own)
    for collection in surface.users_collection:
        collection.objects.unlink(surface)
    own.objects.link(surface)
    first = bpy.context.view_layer
    other = bpy.context.scene.view_layers.new("Other")
    other.layer_collection.children["Own"].exclude = True
    running = begin(surface, 0.2)
    bpy.context.window.view_layer = other
    try:
        tick_until(running, lambda: False)
        result, _figures = running.keep(bpy.context)
    finally:
        running.end()
        bpy.context.window.view_layer = first
        bpy.context.scene.view_layers.remove(other)
    assert result.users_collection[:] == (own,)
    assert first.objects.active == result


def test_the_scene_goes_and_the_surface_stays_in_another():
    surface = sphere()
    home = bpy.context.scene
    second = bpy.data.scenes.new("Second")
    second.collection.objects.link(surface)
    bpy.context.window.scene = second
    running = begin(surface, 0.2)
    bpy.context.window.scene = home
    bpy.data.scenes.remove(second)
    tick_until(running, lambda: False)
    result, _figures = running.keep(bpy.context)
    running.end()
    assert in_first_scene(surface, result)


def test_several_are_filled_while_another_scene_is_shown():
    first, second = sphere(), sphere()
    second.location.x = 3.0
    for thing in (first, second):
        thing.meander.spacing = 0.3
    activate(first)
    second.select_set(True)
    queue = Queue(bpy.context, restart=False, beside=False)
    filled = [queue.next_plan(bpy.context)]
    show_other_scene()
    filled.append(queue.next_plan(bpy.context))
    assert [plan.surface.find() for plan in filled] == [first, second]
    for plan in filled:
        running = session.Session(plan)
        running.run()
        result, _figures = running.keep(bpy.context)
        running.end()
        assert in_first_scene(plan.surface.find(), result)


def test_a_surface_that_was_taken_out_of_every_scene_is_deleted():
    surface = sphere()
    running = begin(surface, 0.2)
    surface.use_fake_user = True
    for collection in surface.users_collection:
        collection.objects.unlink(surface)
    with pytest.raises(Exception, match="The surface was deleted while the curve was growing"):
        tick_until(running, lambda: False)
        running.keep(bpy.context)
    running.end()
    bpy.data.objects.remove(surface)
