# SPDX-License-Identifier: GPL-3.0-or-later
"""How often a growing curve is shown: by what drawing takes, on a clock of the test's own."""

import pytest
from meander.pace import LARGEST_SHARE, LONGEST_WAIT, SHARE_ON_TWO, Pace

INTERVAL = 1.0 / 12.0


def played(pace: Pace, cost: float, seconds: float) -> tuple[int, float]:
    """A window that needs `cost` to draw: how many pictures it shows, and how long it draws."""
    now, tick, pictures = 0.0, 0.0, 0
    while now < seconds:
        if pace.tick(now):
            pace.asked(now)
            pictures += 1
            now += cost
            pace.drawn(now)
        # A timer's event waits until the drawing is done.
        tick = max(tick + INTERVAL, now)
        now = tick
    return pictures, pictures * cost


@pytest.mark.parametrize("cost", [0.001, 0.005, 0.01])
def test_quick_drawing_shows_a_picture_at_every_tick(cost: float) -> None:
    pictures, _ = played(Pace(INTERVAL, 2, software=False), cost, 10.0)
    assert pictures >= 10 * 10


@pytest.mark.parametrize("software", [False, True])
@pytest.mark.parametrize("cost", [0.05, 0.13, 0.4])
def test_slow_drawing_keeps_to_its_share(cost: float, software: bool) -> None:
    pictures, drawing = played(Pace(INTERVAL, 2, software), cost, 60.0)
    assert drawing <= 1.02 * SHARE_ON_TWO * 60.0
    # And makes use of it, but for what is lost until the next tick.
    assert pictures >= 0.9 * 60.0 / (cost / SHARE_ON_TWO + INTERVAL)


def test_many_processors_may_draw_more_unless_they_are_the_graphics_card() -> None:
    card, none = Pace(INTERVAL, 16, software=False), Pace(INTERVAL, 16, software=True)
    assert played(card, 0.05, 10.0)[0] > 3 * played(none, 0.05, 10.0)[0]
    assert card.share == LARGEST_SHARE


def test_a_picture_comes_however_slow_the_drawing() -> None:
    pace = Pace(INTERVAL, 2, software=True)
    pictures, _ = played(pace, 5.0, 60.0)
    assert pictures >= 60.0 / (5.0 + LONGEST_WAIT + INTERVAL) - 1
    assert pace.slow


def test_a_view_that_is_never_drawn_holds_nothing_up() -> None:
    pace = Pace(INTERVAL, 2, software=True)
    for tick in range(100):
        assert pace.tick(tick * INTERVAL)
        pace.asked(tick * INTERVAL)
    assert not pace.slow
