# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that goes on in a window piece by piece, and ends in files."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from .. import core
from ..model.files.whole import FileError
from ..run.lasting import Activity
from ..scene.errors import DataError
from .refusing import refuse, sentence_of
from .watched import over_view

# Over a 3D view; elsewhere keys do what they always do.
KEYS = "Esc: Cancel"


class Ticked:
    """An operator that does a piece of its work at each tick of a window's timer.

    going_on   what goes on, with the window that it has borrowed
    """

    going_on: ClassVar[Activity]

    def _tick(self, context: bpy.types.Context, going: Any) -> Any:
        """Does one piece. Returns what is to be written once all are done; None: some are left."""
        raise NotImplementedError

    def _write(self, context: bpy.types.Context, done: Any) -> None:
        """Writes the files, and says so."""
        raise NotImplementedError

    def _watch(self, context: bpy.types.Context, going: Any) -> set[str]:
        self.going_on.begin(going)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        going = self.going_on.current
        if going is None:  # ended by unregister
            return {"CANCELLED"}
        if event.type == "ESC" and event.value == "PRESS" and over_view(context, event):
            self.cancel(context)
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            done = self._tick(context, going)
            if done is None:
                return {"PASS_THROUGH"}
            self.cancel(context)
            self._write(context, done)
            return {"FINISHED"}
        except (DataError, core.MeanderError, FileError) as error:
            self.cancel(context)  # where it did not get as far as the files
            refuse(self, context.active_object, sentence_of(error))
            return {"CANCELLED"}
        except BaseException:
            # A defect of ours must not leave a timer and a run behind.
            self.cancel(context)
            raise

    def cancel(self, _context: bpy.types.Context) -> None:
        """Gives back what was borrowed. Called by Blender too when it closes the window or the file
        under the work."""
        self.going_on.end()
