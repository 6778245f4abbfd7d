# SPDX-License-Identifier: GPL-3.0-or-later
"""The objects that one Fill fills, one after another."""

from __future__ import annotations

from dataclasses import replace

import bpy

from .. import core
from ..model.estimate import Estimate, together
from ..scene.errors import DataError
from ..scene.home_scene import HomeScene
from ..scene.identity import Key
from ..scene.linked_settings import settings_of, settings_to_change
from ..scene.options import options_of
from ..scene.preparation import selected_faces
from ..scene.settings import adopt, is_untouched, surface_of
from . import estimate
from .plan import Plan, plan_of


class Queue:
    """What is still to be filled. It keeps keys, since plans may be minutes away."""

    def __init__(self, context: bpy.types.Context, restart: bool, beside: bool) -> None:
        """Lines up the active object, and what else is selected and can be filled.

        In Edit Mode those being edited; if faces are selected, those that have some.
        """
        self._waiting = [Key(thing) for thing in objects_of(context)]
        self._active = Key(context.active_object)
        # A spacing of 0 is worked out for each; the first run writes down what it came to.
        automatic = settings_of(context.active_object).spacing == 0.0
        self._each_its_own = frozenset({"spacing"} if automatic else ())
        self._home = HomeScene(context.scene, context.view_layer)
        self._restart, self._beside = restart, beside
        self._count = len(self._waiting)
        self.taken = self._active  # the one that was planned last

    @property
    def more(self) -> bool:
        """Whether anything is left to be filled."""
        return bool(self._waiting)

    @property
    def place(self) -> str:
        """Which one it is that was taken last, such as "2 of 5"; empty where there is only one."""
        return f"{self._count - len(self._waiting)} of {self._count}" if self._count > 1 else ""

    def next_plan(self, context: bpy.types.Context) -> Plan | None:
        """Plans the next one, in the scene in which they were lined up; None where it has been
        deleted.

        What nobody has set up takes the choices of the active object. Raises DataError and
        core.MeanderError.
        """
        self.taken = self._waiting.pop(0)
        thing, active = self.taken.find(), self._active.find()
        if thing is None or self._home.find(thing) is None:
            return None
        if active is not None and thing != active:
            adopt(settings_of(active), settings_to_change(thing), self._each_its_own)
        with self._home.entered(context, thing) as home:
            depsgraph = home.evaluated_depsgraph_get()
            return plan_of(thing, home.scene, depsgraph, self._restart, self._beside)

    def estimate_of_rest(self, context: bpy.types.Context, first: Plan) -> Estimate | None:
        """What all of them come to, the first of which is planned; None where that is not known."""
        found = []
        settings = settings_of(self._active.find())
        depsgraph = context.evaluated_depsgraph_get()
        for key in [None, *self._waiting]:
            try:
                plan = first if key is None else plan_of(key.find(), context.scene, depsgraph)
                if key is not None and is_untouched(settings_of(key.find())):
                    # It will take the choices of the active one.
                    spacing = plan.spacing if self._each_its_own else first.spacing
                    options = options_of(settings, spacing)
                    plan = replace(plan, problem=replace(plan.problem, options=options))
                found.append(estimate.of_plan(plan))
            except (DataError, core.MeanderError):  # which its run will report
                continue
        return together(found)


def objects_of(context: bpy.types.Context) -> list[bpy.types.Object]:
    """What one Fill fills: the active object first, then what else is selected."""
    active = context.active_object
    if context.mode == "EDIT_MESH":
        edited = [active, *(thing for thing in context.objects_in_mode if thing != active)]
        with_faces = [thing for thing in edited if selected_faces(thing) is not None]
        return with_faces or edited
    if context.mode != "OBJECT" or surface_of(active) != active or not active.select_get():
        return [active]
    others = sorted(context.selected_objects, key=lambda thing: thing.name_full)
    return [active, *(thing for thing in others if thing != active and surface_of(thing) == thing)]
