# SPDX-License-Identifier: GPL-3.0-or-later
"""How often a growing curve is shown, so that drawing leaves the processors to the solver; no bpy.

Where there is a graphics card a redraw costs the processor some milliseconds, and every tick of the
timer may show a picture. Where the processors draw, one redraw can take longer than an iteration;
pictures then come so rarely that drawing has a small share of the time, whatever the machine.
"""

from __future__ import annotations

# The largest share of the time that drawing may have on two processors. While the processors draw,
# the solver gets about half of them, so that it keeps nine tenths of its speed.
SHARE_ON_TWO = 0.15
# The same of one thread that computes for a graphics card: the solver has to wait for the thread
# of its own that it displaced, so it can lose as much.
CARD_SHARE_ON_TWO = 0.1
# With more processors and a graphics card, drawing keeps only one of them from solving.
LARGEST_SHARE = 0.6
# While there is growth to be shown that is over already, drawing may have this much, for as many
# pictures as a curve takes to grow.
GROWTH_SHARE = 0.5
# However slow the drawing, a picture is tried this often, in seconds.
LONGEST_WAIT = 3.0
# A redraw by the processors that takes longer than this, in seconds, is worth drawing plainer.
SLOW = 0.1
# What a new picture counts in the mean of what pictures compute: clocks of threads are coarse.
NEWEST = 0.3


class Pace:
    """Says at which ticks of a timer a picture is due, from what the last ones took.

    asked() when a picture has been handed over, drawn() whenever a view has been drawn, tick() at
    every tick. Times are seconds of any clock that does not go back. `computed` are the processor
    seconds of the window's thread so far. With a graphics card they count, not the clock: the
    thread may have waited for the card, or for its turn, and the solver had the processor then.
    Where the processors draw, they do it on other threads than the window's, so the clock counts.

    interval     between ticks
    processors   how many there are
    software     whether they draw as well, because there is no graphics card
    """

    def __init__(self, interval: float, processors: int, software: bool) -> None:
        self._interval = interval
        self._software = software
        many = CARD_SHARE_ON_TWO * max(processors, 2) / 2
        self.share = SHARE_ON_TWO if software else min(many, LARGEST_SHARE)
        self.cost = 0.0  # what the last picture took, by the clock
        self.computing = 0.0  # what pictures take of the window's thread: a mean
        self._begin: float | None = None  # of the present tick, in processor seconds
        self._pictures = 0
        self._asked: float | None = None
        self._drawn: float | None = None
        self._due = 0.0

    def asked(self, now: float) -> None:
        """A picture has been handed over at this moment; its drawing begins."""
        self._asked, self._drawn = now, None

    def drawn(self, now: float) -> None:
        """A view has been drawn; of several the last one counts."""
        if self._asked is not None:
            self._drawn = now

    def tick(self, now: float, computed: float, growth: bool = False) -> bool:
        """Whether a picture is due. The first thing at a tick, before the curve is looked at.

        growth   whether pictures of how the curve grew are waiting
        """
        share = max(self.share, GROWTH_SHARE) if growth else self.share
        if self._asked is not None:
            late = now - self._asked
            if late > 1.5 * self._interval:
                # The tick itself had to wait: for the drawing, and for what follows it.
                self.cost = late
            else:
                self.cost = self._drawn - self._asked if self._drawn is not None else 0.0
            self._note_computing(computed - self._begin)
            if self._software:
                wait = self.cost / share
            else:
                wait = max(self.computing / share, self.cost / LARGEST_SHARE)
            self._due = self._asked + min(wait, LONGEST_WAIT)
            self._asked = None
        self._begin = computed
        return now >= self._due

    def _note_computing(self, seconds: float) -> None:
        """From the tick that handed a picture over to the next, redraws that follow included."""
        self._pictures += 1
        newest = max(NEWEST, 1.0 / self._pictures)
        self.computing += newest * (seconds - self.computing)

    @property
    def waiting(self) -> bool:
        """Whether a picture has been handed over since the last tick."""
        return self._asked is not None

    @property
    def slow(self) -> bool:
        """Whether drawing takes so long that a plainer picture would be welcome."""
        if self._software:
            return self.cost > SLOW
        return self.computing > self.share * self._interval  # not at every tick
