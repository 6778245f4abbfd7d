# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments of calls, and objects of the library that Python owns."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import MeanderError

_Owner = TypeVar("_Owner", bound="Handle")


def checked_array(name: str, value: ArrayLike, dtype: type, columns: int | None) -> NDArray[Any]:
    """`value` as a C-contiguous array of exactly this dtype, of shape (n,) or (n, columns).

    Numbers that the dtype cannot hold are refused rather than wrapped: a face index of -1
    must not become 4294967295.
    """
    shape = "(n,)" if columns is None else f"(n, {columns})"
    if np.ma.is_masked(value):  # a copy of it would have what lies behind the mask
        raise MeanderError(f"{name} has masked values; fill them, or leave them out")
    try:
        array = np.asarray(value)
    except ValueError:  # as numpy says it, for people who know numpy
        raise MeanderError(
            f"{name} must be an array of shape {shape}, but its rows have different lengths"
        ) from None
    if array.dtype == object:
        raise MeanderError(
            f"{name} must be an array of numbers of shape {shape}; it holds something that is none"
        )
    if columns is not None and array.shape == (0,):  # of an empty list
        array = array.reshape(0, columns)
    fits = array.ndim == 1 if columns is None else array.ndim == 2 and array.shape[1] == columns
    if not fits:
        raise MeanderError(f"{name} must be an array of shape {shape}, not {array.shape}")
    if array.dtype != dtype:
        if np.issubdtype(dtype, np.integer):
            if array.size and not (
                np.issubdtype(array.dtype, np.integer) or array.dtype == np.bool_
            ):
                raise MeanderError(f"{name} must hold whole numbers, not {array.dtype}")
            limit = np.iinfo(dtype).max
            if array.size and array.dtype != np.bool_ and (array.min() < 0 or array.max() > limit):
                raise MeanderError(f"{name} must hold numbers from 0 to {limit}")
        elif not (np.issubdtype(array.dtype, np.number) or array.dtype == np.bool_) or (
            np.issubdtype(array.dtype, np.complexfloating)
        ):
            raise MeanderError(f"{name} must hold real numbers, not {array.dtype}")
    return np.ascontiguousarray(array, dtype=dtype)


def as_array(value: Any) -> Any:
    """A list as an array; what is none is left as it is, for `checked_array` to refuse."""
    try:
        return value if value is None else np.asarray(value)
    except ValueError:
        return value


def narrow_offsets(offsets: NDArray[np.uint64]) -> NDArray[np.uint32]:
    """Offsets as hosts have them, in 32 bits."""
    if offsets[-1] > np.iinfo(np.uint32).max:
        raise MeanderError(
            f"the curve has {offsets[-1]} points, and more than 2^32 cannot be copied; choose a "
            "larger spacing"
        )
    return offsets.astype(np.uint32)


def address_of(array: NDArray[Any] | None) -> int | None:
    """A pointer to the data; NULL for None. The caller keeps the array alive during the call."""
    return None if array is None else array.ctypes.data


def chosen(what: str, value: str, choices: tuple[str, ...]) -> int:
    """The number of `value` among the names that the library knows by number."""
    if value not in choices:
        raise MeanderError(f"there is no {what} {value!r}; choose one of {', '.join(choices)}")
    return choices.index(value)


class Handle:
    """Owns one opaque pointer: freed by close(), on leaving a `with`, or when collected.

    A pointer means nothing in another process, and two owners would free it twice: handles are not
    copied and not pickled, unless they can be made again from what they were made of.
    """

    _what = "object"

    def __init__(self, pointer: int, destroy: Callable[[int], None]) -> None:
        self._pointer: int | None = pointer
        self._finalizer = weakref.finalize(self, destroy, pointer)
        # At exit a daemon thread may still be inside the library; the process frees all anyway.
        self._finalizer.atexit = False

    def _alive(self) -> int:
        if self._pointer is None:
            raise MeanderError(f"this {self._what} has been closed; make a new one")
        return self._pointer

    def close(self) -> None:
        """Frees the native memory now; closing twice is allowed, using it afterwards is not."""
        self._pointer = None
        self._finalizer()

    def __reduce__(self) -> Any:
        raise MeanderError(
            f"a {self._what} cannot be copied or sent to another process; make a new one there"
        )

    def __enter__(self: _Owner) -> _Owner:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
