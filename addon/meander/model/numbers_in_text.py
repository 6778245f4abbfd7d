# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of a text file: numpy only, no bpy."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

# How much of a word is quoted.
_QUOTED = 40


class NoNumber(Exception):
    """A word that is no number; ``str(error)`` quotes its beginning."""


def numbers_of(words: Sequence[bytes]) -> NDArray[np.float64]:
    """The words as numbers, in 8 bytes each, however long one of them is.

    Raises NoNumber.
    """
    # Not as an array of words, which has room for the longest in the place of every one.
    try:
        return np.fromiter(map(float, words), np.float64, len(words))
    except ValueError:
        wrong = next(word for word in words if not _is_number(word))
    raise NoNumber(repr(wrong[:_QUOTED].decode("latin-1")))


def _is_number(word: bytes) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
