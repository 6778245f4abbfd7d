# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of numbers as the lines of a text file, a block after the other, so that a file of millions
of lines is never in memory as a whole; no bpy."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ... import core

# Rows in a block: a few megabytes of text, made in some hundredths of a second.
_BLOCK = 1 << 15
# So many blocks are made at a time: more would wait for the disk.
_WRITERS = 2


def rows(pattern: str, *columns: NDArray) -> Iterator[str]:
    """The text of rows, in blocks, a few of which are made ahead, side by side.

    pattern   a row, with its end, see core.text_rows(); %% is a %
    columns   arrays of as many entries, each (n,) or (n, k); whole numbers up to 2^53
    """

    def made(begin: int) -> str:
        block = [column[begin : begin + _BLOCK] for column in columns]
        return core.text_rows(pattern, np.column_stack(block)).decode("ascii")

    begins = range(0, len(columns[0]), _BLOCK)
    if len(begins) < 2:
        yield from map(made, begins)
        return
    with ThreadPoolExecutor(_WRITERS) as pool:  # the library makes the text without Python's lock
        ahead: deque[Future[str]] = deque()
        for begin in begins:
            ahead.append(pool.submit(made, begin))
            if len(ahead) > _WRITERS:
                yield ahead.popleft().result()
        while ahead:
            yield ahead.popleft().result()


def write_pieces(path: Path, pieces: Iterable[str | bytes]) -> None:
    """Writes what comes in pieces, text as UTF-8. Raises OSError."""
    with path.open("wb") as file:
        for piece in pieces:
            file.write(piece if isinstance(piece, bytes) else piece.encode("utf-8"))
