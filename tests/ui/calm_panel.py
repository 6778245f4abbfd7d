# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panel and the view say of a run."""

from __future__ import annotations

import time
from collections.abc import Generator, Iterator

import bpy
import numpy as np
from meander.model.estimate import PHASE_TEXTS
from meander.run import gaps, session
from stage import (
    FINEST_THAT_ENDS,
    RESULT,
    assert_nothing_left_over,
    changed_share,
    choose_spacing,
    ended,
    picture,
    pixels_of,
    press_run,
    redrawn,
    seen,
    state,
    status_texts,
    step,
    suzanne_in_view,
    until,
    window_override,
)

# The share of the time that the progress may be off, in the mean of a run. The library's is within
# 0.08 of processor time; the rest is for a machine that does other things meanwhile.
MOST_OFF = 0.25


def orange_share(name: str) -> float:
    """How much of the view has the colours of the outline of what is selected."""
    red, green, blue = np.moveaxis(pixels_of(name), 2, 0)
    return float(((red > 0.8) & (green > 0.35) & (green < 0.8) & (blue < 0.4)).mean())


def window_opens() -> Iterator[float]:
    yield from suzanne_in_view()
    yield from seen("9_mesh")


def progress_of_a_run() -> Iterator[float]:
    step("the progress of a run is that of its time, and its texts say what it is about")
    bpy.context.active_object.meander.threads = 1
    # A run long enough to be looked at: of some seconds, and many copies of its curve.
    choose_spacing(FINEST_THAT_ENDS)
    samples: list[tuple[float, float]] = []
    begin = time.monotonic()
    first_text = len(status_texts)
    press_run()
    pictured, copy = False, None
    while not ended():
        running = session.current()
        # On a busy machine copies of the curve are rare; until the next one what is shown is old.
        if running.latest is not copy:
            copy = running.latest
            samples.append((time.monotonic() - begin, running.progress()))
        if not pictured and running.left_text() and running.progress() > 0.3:
            yield from redrawn()
            if not ended():
                picture("9_growing")
                pictured = True
        yield 0.05
    end = time.monotonic() - begin
    texts = [text for text in status_texts[first_text:] if text]
    told = [text.partition("    ")[0].partition(",")[0] for text in texts]
    phases = [text for k, text in enumerate(told) if k == 0 or text != told[k - 1]]
    assert phases == [text for text in PHASE_TEXTS.values() if text in phases], phases
    assert len(phases) > 1, phases  # the first may be over before the window has drawn it
    # What is left is known after half a second; on a quick machine that may be drawn no more.
    assert end < 3.0 or any(" s left" in text for text in texts), texts
    assert len(samples) >= 3, samples
    times, shown = np.array(samples).T
    assert np.all(np.diff(shown) >= 0.0)
    off = float(np.abs(shown - times / end).mean())
    print(f"progress: {off:.2f} off in the mean over {end:.1f} s, {len(samples)} samples")
    assert off < MOST_OFF, samples
    assert_nothing_left_over()


def result_is_seen() -> Iterator[float]:
    step("the result is seen, and not its outline")
    result = bpy.data.objects[RESULT]
    assert bpy.context.view_layer.objects.active == result and not result.select_get()
    yield from seen("9_result")
    unselected = orange_share("9_result")
    result.select_set(True)
    yield from seen("9_selected")
    selected = orange_share("9_selected")
    assert selected > 0.003 and unselected < 0.05 * selected, (selected, unselected)
    result.select_set(False)


def gaps_are_marked() -> Generator[float, None, None]:
    step("Show Gaps marks places, and nothing else changes")
    result = bpy.data.objects[RESULT]
    result.meander.iteration_limit = 25
    press_run(restart=True)
    yield from until(ended, "the end at the limit")
    assert result.meander.figures.wide_gaps > 0
    yield from seen("9_limit")
    before = state()
    with bpy.context.temp_override(**window_override()):
        assert bpy.ops.meander.show_gaps() == {"FINISHED"}
    assert gaps.shown_of(result) and state() == before and bpy.context.mode == "OBJECT"
    yield from seen("9_gaps")
    assert changed_share("9_limit", "9_gaps") > 0.002
    with bpy.context.temp_override(**window_override()):
        bpy.ops.meander.show_gaps()
    yield from seen("9_hidden")
    # All but single pixels, at edges that are smoothed.
    assert changed_share("9_limit", "9_hidden") < 1e-4
    assert state() == before


def story() -> Iterator[float]:
    yield from window_opens()
    yield from progress_of_a_run()
    yield from result_is_seen()
    yield from gaps_are_marked()
