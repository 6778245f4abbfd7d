# SPDX-License-Identifier: GPL-3.0-or-later
"""What a call of the library fails with."""

from __future__ import annotations

from .abi import Status

# The status of a MeanderError about the library file itself: it is missing or does not fit.
STATUS_NO_LIBRARY = -1


class MeanderError(Exception):
    """Something that a person can put right; ``str(error)`` is one sentence that says how.

    status        a `Status`, or STATUS_NO_LIBRARY when the library could not be loaded
    element_kind  what `elements` counts: 'vertex', 'face', 'edge', 'seed_point', or None
    elements      the first element at fault; an edge has the indices of its two end vertices, and
                  where two strands of a seed meet there is a point of each
    """

    def __init__(
        self,
        text: str,
        status: int = Status.INVALID_ARGUMENT,
        element_kind: str | None = None,
        elements: tuple[int, ...] = (),
    ) -> None:
        super().__init__(text)
        self.status = int(status)
        self.element_kind = element_kind
        self.elements = elements
