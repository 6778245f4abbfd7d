# SPDX-License-Identifier: GPL-3.0-or-later
"""How often a growing curve is shown: by what drawing takes, on clocks of the test's own."""

import pytest
from meander.run.pace import (
    CARD_SHARE_ON_TWO,
    GROWTH_SHARE,
    LARGEST_SHARE,
    LONGEST_WAIT,
    SHARE_ON_TWO,
    Pace,
)

INTERVAL = 1.0 / 12.0


def played(
    pace: Pace, cost: float, seconds: float, computing: float | None = None, step: float = 0.0
) -> tuple[int, float]:
    """A window that needs `cost` to draw: how many pictures it shows, and how long it draws.

    computing   of `cost`, what the window's thread computes; None: all of it
    step        how coarse its processor clock is
    """
    computing = cost if computing is None else computing
    now, tick, pictures, computed = 0.0, 0.0, 0, 0.0
    while now < seconds:
        if pace.tick(now, computed // step * step if step else computed):
            pace.asked(now)
            pictures += 1
            now += cost
            computed += computing
            pace.drawn(now)
        # A timer's event waits until the drawing is done.
        tick = max(tick + INTERVAL, now)
        now = tick
    return pictures, pictures * cost


@pytest.mark.parametrize("cost", [0.001, 0.005, 0.008])
def test_quick_drawing_shows_a_picture_at_every_tick(cost: float) -> None:
    pictures, _ = played(Pace(INTERVAL, 2, software=False), cost, 10.0)
    assert pictures >= 10 * 10


@pytest.mark.parametrize("software", [False, True])
@pytest.mark.parametrize("cost", [0.05, 0.13, 0.29])
def test_slow_drawing_keeps_to_its_share(cost: float, software: bool) -> None:
    share = SHARE_ON_TWO if software else CARD_SHARE_ON_TWO
    pictures, drawing = played(Pace(INTERVAL, 2, software), cost, 60.0)
    assert drawing <= 1.02 * share * 60.0
    # And makes use of it, but for what is lost until the next tick.
    assert pictures >= 0.9 * 60.0 / (cost / share + INTERVAL)


def test_growth_that_waits_may_take_more_than_what_is_as_before() -> None:
    pace, pictures, now = Pace(INTERVAL, 2, software=True), 0, 0.0
    while now < 30.0:
        if pace.tick(now, now, growth=True):
            pace.asked(now)
            now += 1.0
            pace.drawn(now)
            pictures += 1
        now += INTERVAL
    assert 0.8 * GROWTH_SHARE * 30.0 < pictures <= 1.1 * GROWTH_SHARE * 30.0


def test_waiting_for_a_card_or_for_a_turn_takes_nothing_from_the_solver() -> None:
    # A picture takes 50 ms by the clock, 2 of which are computed: another at every tick.
    pictures, _ = played(Pace(INTERVAL, 2, software=False), 0.05, 10.0, computing=0.002)
    assert pictures >= 10 * 10
    # Where the processors draw, they do so while the window's thread waits.
    pictures, drawing = played(Pace(INTERVAL, 2, software=True), 0.05, 10.0, computing=0.002)
    assert drawing <= 1.05 * SHARE_ON_TWO * 10.0


def test_a_slow_card_leaves_time_for_whoever_uses_the_window() -> None:
    pictures, drawing = played(Pace(INTERVAL, 2, software=False), 0.5, 60.0, computing=0.002)
    assert drawing <= 1.02 * LARGEST_SHARE * 60.0
    assert pictures > 20


def test_a_clock_in_steps_is_as_good_in_the_mean() -> None:
    # Of 15.6 ms, as one system has it: most pictures seem to take nothing, some all of it.
    _, drawing = played(Pace(INTERVAL, 2, software=False), 0.012, 120.0, step=0.015625)
    assert 0.7 * CARD_SHARE_ON_TWO * 120.0 <= drawing <= 1.1 * CARD_SHARE_ON_TWO * 120.0


def test_redraws_that_follow_a_picture_are_counted() -> None:
    """Smoothing draws a picture again and again after it has first been drawn."""
    pace = Pace(INTERVAL, 2, software=False)
    now = computed = 0.0
    pictures = 0
    while now < 60.0:
        if pace.tick(now, computed):
            pace.asked(now)
            pace.drawn(now + 0.002)
            computed += 0.002 + 7 * 0.003
            pictures += 1
        now += INTERVAL
    assert pictures * 0.023 <= 1.02 * CARD_SHARE_ON_TWO * 60.0
    assert pace.slow  # smoothing would better be off


def test_many_processors_may_draw_more_unless_they_are_the_graphics_card() -> None:
    card, none = Pace(INTERVAL, 16, software=False), Pace(INTERVAL, 16, software=True)
    assert played(card, 0.05, 10.0)[0] > 3 * played(none, 0.05, 10.0)[0]
    assert card.share == LARGEST_SHARE
    assert not card.slow


def test_a_picture_comes_however_slow_the_drawing() -> None:
    pace = Pace(INTERVAL, 2, software=True)
    pictures, _ = played(pace, 5.0, 60.0)
    assert pictures >= 60.0 / (5.0 + LONGEST_WAIT + INTERVAL) - 1
    assert pace.slow


def test_a_view_that_is_never_drawn_holds_nothing_up() -> None:
    pace = Pace(INTERVAL, 2, software=True)
    for tick in range(100):
        assert pace.tick(tick * INTERVAL, 0.0)
        pace.asked(tick * INTERVAL)
    assert not pace.slow
