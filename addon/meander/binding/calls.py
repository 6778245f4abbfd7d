# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls of the library: their structs, their errors, and what they fill in."""

from __future__ import annotations

import math
import re
import weakref
from collections.abc import Callable
from ctypes import Structure, byref, sizeof
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from .abi import STRUCTS, ErrorRecord, Status
from .choices import ELEMENT_KINDS
from .errors import MeanderError
from .interruption import Cancel, heard
from .native_library import native

_Record = TypeVar("_Record", bound=Structure)


_C_NAMES = {struct: name for name, struct in STRUCTS.items()}


def prepared(struct: type[_Record], *arguments: int) -> _Record:
    """A struct as its _init function leaves it; `arguments` are what that takes besides."""
    record = struct()
    init = getattr(native(), f"{_C_NAMES[struct]}_init")
    status = init(byref(record), sizeof(record), *arguments)
    if status != Status.OK:
        raise MeanderError(f"the native library does not know this {_C_NAMES[struct]}", status)
    return record


def figures_of(record: Structure) -> dict[str, Any]:
    """The fields of a struct that mean something to a reader, by their C names."""
    hidden = ("struct_size", "reserved", "reserved32", "result")
    names = [field[0] for field in record._fields_ if field[0] not in hidden]
    return {name: getattr(record, name) for name in names}


def new_error() -> ErrorRecord:
    return prepared(ErrorRecord)


def raise_error(status: int, error: ErrorRecord) -> None:
    """Turns a failed call into a MeanderError."""
    text = _in_python(error.text.decode("utf-8", "replace"))
    if not text:
        name = native().meander_status_name(status)
        text = f"the native library failed ({name.decode('utf-8', 'replace')})"
    kind = None
    if 0 <= error.element_kind < len(ELEMENT_KINDS):
        kind = ELEMENT_KINDS[error.element_kind]
    elements: tuple[int, ...] = ()
    if kind == "edge":
        elements = (error.element_index, error.element_index2)
    elif kind == "seed_point":
        elements = tuple(dict.fromkeys((error.element_index, error.element_index2)))
    elif kind is not None:
        elements = (error.element_index,)
    raise MeanderError(text, status, kind, elements)


def _in_python(text: str) -> str:
    """A sentence of the library's that names functions of C, in the words of Python."""
    text = re.sub(r"\bmeander_(?:flow|surface|context)_(\w+)", r"\1()", text)
    return text.replace("or be NULL and have none", "or be None")


def call(function: Callable[..., int], *arguments: Any) -> None:
    """Calls a function of the library's with these and a place for its error, which is raised.

    Where a `Cancel` is among them, an interruption from the keyboard ends the call.
    """
    error = new_error()
    status = status_of(function, *arguments, error=error)
    if status != Status.OK:
        raise_error(status, error)


def status_of(function: Callable[..., int], *arguments: Any, error: ErrorRecord) -> int:
    """As `call`, but returns the status and fills the error."""
    for argument in arguments:
        if isinstance(argument, Cancel):
            return heard(lambda: function(*arguments, byref(error)), argument.now)
    return function(*arguments, byref(error))


class Found:
    """A struct of the library's that a call fills with counts and arrays, such as meander_gaps.

    record    the struct, for the call and for its counts
    array()   one of its arrays, in the memory of the library; this is freed when the last of the
              arrays has gone
    """

    def __init__(self, struct: type[Structure]) -> None:
        self.record = prepared(struct)

    def fill(self, function: Callable[..., int], *arguments: Any, context: Any = ()) -> Any:
        """Calls a function with these, the struct and, where it takes one, a context."""
        try:
            call(function, *arguments, byref(self.record), *context)
        finally:  # also where an interruption came when all was done
            self.own()
        return self.record

    def own(self) -> None:
        """Has the library's memory freed with the last of the arrays, once a call has filled it."""
        end = weakref.finalize(self, native().meander_result_destroy, self.record.result)
        end.atexit = False  # as of a Handle

    def array(self, name: str, *shape: int) -> NDArray[Any]:
        kind = self.record._arrays_[name]
        address = getattr(self.record, name)
        if address is None:
            return np.empty(shape, dtype=kind)
        memory = (kind * math.prod(shape)).from_address(address)
        memory.owner = self  # which the array holds, and every array made of a part of it
        return np.ctypeslib.as_array(memory).reshape(shape)
