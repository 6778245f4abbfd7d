# SPDX-License-Identifier: GPL-3.0-or-later
"""A run in pieces, as a window makes it, without a window."""

from __future__ import annotations

import time
from collections.abc import Callable

import bpy
import pytest
from meander.run import session
from meander.run.plan import plan_run
from scenes import activate


class FakeWindow:
    """In background there is no window to lend a timer and a status bar."""

    def __init__(self, _context) -> None:
        self.texts: list[str | None] = []

    def picture_due(self, _growth: bool) -> bool:
        return True

    def picture_given(self) -> None:
        pass

    def text_due(self, with_picture: bool) -> bool:
        return with_picture

    def show(self, _context, text: str, _progress: float) -> None:
        self.texts.append(text)

    def give_back(self) -> None:
        self.texts.append(None)


def begin(thing: bpy.types.Object, spacing: float) -> session.Session:
    activate(thing)
    if thing.meander.spacing != pytest.approx(spacing):
        thing.meander.spacing = spacing
    running = session.Session(plan_run(bpy.context))
    running.start(bpy.context)
    return running


def tick_until(running: session.Session, condition: Callable[[], bool]) -> None:
    end = time.monotonic() + 20.0
    while running.tick(bpy.context) and not condition():
        assert time.monotonic() < end
        time.sleep(0.02)
