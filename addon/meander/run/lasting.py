# SPDX-License-Identifier: GPL-3.0-or-later
"""What lasts between two events: runs that go on or can, and what is drawn over the views.

Whoever makes one of these keeps it here, in `lasting`, and nowhere else, and takes it away when it
ends, is undone, a file is opened, or the add-on goes. ui.events has what is called at which event.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .camera import Going
    from .gaps import Marks
    from .live import Kept
    from .meaning import Meaning
    from .seeds import Shown
    from .session import Session
    from .suspended import SuspendedRun


class Lasting:
    """All of it, each None where there is none."""

    def __init__(self) -> None:
        # The running session, or the drawing that is made from a camera. There is one of the two at
        # most: it owns the status bar and the Esc key.
        self.session: Session | None = None
        self.drawing: Going | None = None
        # The run that was ended last without a result.
        self.suspended: SuspendedRun | None = None
        # The finished run of a curve with Live on.
        self.finished: Kept | None = None
        self.seed_preview: Shown | None = None
        # Of one result at a time.
        self.gap_marks: Marks | None = None
        # For every window, by its address: the object that was active when Live looked last, and
        # what a run on it would have meant.
        self.looked_at: dict[int, tuple[int, Meaning]] = {}


lasting = Lasting()


def why_busy() -> str | None:
    """Why nothing that owns status bar and Esc key can begin, in a few words; None: it can."""
    if lasting.session is not None:
        return "A curve is growing already"
    if lasting.drawing is not None:
        return "A drawing is being made already"
    return None
