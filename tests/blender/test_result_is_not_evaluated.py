# SPDX-License-Identifier: GPL-3.0-or-later
"""A run leaves its curve for Blender to evaluate, once: that takes seconds of a large one."""

from __future__ import annotations

import bpy
import pytest
from meander.run import session
from meander.run.plan import plan_run
from scenes import activate, sphere


@pytest.fixture
def evaluated():
    """The names of objects whose shape has been evaluated."""
    names: list[str] = []

    def note(_scene, depsgraph):
        names.extend(
            update.id.name
            for update in depsgraph.updates
            if isinstance(update.id, bpy.types.Object) and update.is_updated_geometry
        )

    bpy.app.handlers.depsgraph_update_post.append(note)
    yield names
    bpy.app.handlers.depsgraph_update_post.remove(note)


@pytest.mark.parametrize("painted", [False, True])
def test_a_run_evaluates_no_curve(evaluated, painted):
    surface = sphere()
    activate(surface)
    if painted:
        group = surface.vertex_groups.new(name="Density")
        group.add(range(len(surface.data.vertices) // 2), 1.0, "REPLACE")
        surface.meander.density_group = "Density"
    surface.meander.spacing = 0.3
    bpy.context.view_layer.update()
    assert surface.name in evaluated, "this is how one is seen"
    evaluated.clear()
    running = session.Session(plan_run(bpy.context))
    running.run()
    result, _figures = running.keep(bpy.context)
    running.end()
    assert result.type == "CURVE" and result.meander.figures.asked
    assert result.name not in evaluated
    bpy.context.view_layer.update()
    assert result.name in evaluated
