# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds and loads the native library, and what every call into it needs: errors, arrays, handles.

What the library does is for `core` to know; hosts have no use for this module.
"""

from __future__ import annotations

import ctypes
import math
import os
import sys
import threading
import weakref
from collections.abc import Callable
from ctypes import Structure, byref, c_size_t, c_void_p, sizeof
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .abi import ABI_VERSION, PROTOTYPES, STRUCTS, VERSION, ErrorRecord, Status
from .choices import ELEMENT_KINDS
from .interruption import Cancel, heard
from .library_file import (
    again,
    built_for,
    damage,
    host,
    library_file,
    needed,
    platform_tag,
    platforms_in,
    system_version,
    where_to_get,
)

_Record = TypeVar("_Record", bound=Structure)
_Owner = TypeVar("_Owner", bound="Handle")

# Names the library file to load instead of the one in the package.
LIBRARY_VARIABLE = "MEANDER_LIBRARY"

# The status of a MeanderError about the library file itself: it is missing or does not fit.
STATUS_NO_LIBRARY = -1

# The libraries of the package, in a folder for each platform.
_NATIVE = Path(__file__).resolve().parents[1] / "native"


# ------------------------------------------------------------------------------------------------
# Errors


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


def new_error() -> ErrorRecord:
    return prepared(ErrorRecord)


def raise_error(status: int, error: ErrorRecord) -> None:
    """Turns a failed call into a MeanderError."""
    text = error.text.decode("utf-8", "replace")
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


# ------------------------------------------------------------------------------------------------
# Loading

_loaded: ctypes.CDLL | None = None
_load_lock = threading.Lock()


def library_path() -> Path:
    """Where the library is expected: MEANDER_LIBRARY if set, else in the package, in the folder of
    the platform that this Python runs on.
    """
    override = os.environ.get(LIBRARY_VARIABLE)
    if override:
        # A bare name would be looked for where the system has its libraries, and not here.
        return Path(override).absolute()
    return _NATIVE / library_file(platform_tag())


def library_notice() -> str:
    """A sentence that names the library where it is not that of the package; else empty."""
    if not os.environ.get(LIBRARY_VARIABLE):
        return ""
    return f"the native library is {library_path()}, which {LIBRARY_VARIABLE} names"


def _refuse_missing(path: Path) -> None:
    """Raises the sentence about a library that is not there."""
    if os.environ.get(LIBRARY_VARIABLE):
        raise MeanderError(
            f"the native library {path}, which {LIBRARY_VARIABLE} names, is missing; correct that "
            "variable or unset it",
            STATUS_NO_LIBRARY,
        )
    tag, present = platform_tag(), platforms_in(_NATIVE)
    found = f"what is there is for {', '.join(present)}" if present else "there is none"
    raise MeanderError(
        f"the native library for this platform, {tag}, is missing: it should be {path}, and "
        f"{found}; {where_to_get(tag)}",
        STATUS_NO_LIBRARY,
    )


def _refuse_foreign(path: Path) -> None:
    """Raises a sentence about a file that this platform could not load, or that is not whole."""
    tag = platform_tag()
    try:
        found, damaged = built_for(path), damage(path)
    except OSError as problem:
        raise MeanderError(
            f"the native library {path} cannot be read ({problem.strerror}); {again()}",
            STATUS_NO_LIBRARY,
        ) from problem
    if damaged:
        raise MeanderError(f"the native library {path} is {damaged}; {again()}", STATUS_NO_LIBRARY)
    if found is None:
        raise MeanderError(
            f"the file {path} is not a native library for {tag}; {where_to_get(tag)}",
            STATUS_NO_LIBRARY,
        )
    # A system that is not ours may use one of these formats; then loading decides.
    if found != tag and sys.platform in ("linux", "win32", "darwin"):
        raise MeanderError(
            f"the native library {path} is for {found}, but {host()} runs on {tag}; "
            f"{where_to_get(tag)}",
            STATUS_NO_LIBRARY,
        )


def _load(path: Path) -> ctypes.CDLL:
    """Loads the library and compares ABI and version before anything else is called."""
    if not path.is_file():
        _refuse_missing(path)
    _refuse_foreign(path)
    try:
        library = ctypes.CDLL(str(path))
    except OSError as problem:
        tag = platform_tag()
        raise MeanderError(
            f"the native library {path} cannot be loaded on this system, {tag} with "
            f"{system_version()} ({problem}); one of a release needs {needed(tag)}: "
            f"{where_to_get(tag)}",
            STATUS_NO_LIBRARY,
        ) from problem
    try:
        abi_version = _bind(library, "meander_abi_version")()
        if abi_version != ABI_VERSION:
            raise MeanderError(
                f"the native library {path} has ABI {abi_version}, but this package needs "
                f"{ABI_VERSION}; {again()}",
                STATUS_NO_LIBRARY,
            )
        version = _bind(library, "meander_version")().decode("utf-8", "replace")
        if version != VERSION:
            raise MeanderError(
                f"the native library {path} is version {version}, but this package is "
                f"version {VERSION}; {again()}",
                STATUS_NO_LIBRARY,
            )
        for name in PROTOTYPES:
            _bind(library, name)
    except AttributeError as problem:
        raise MeanderError(
            f"the file {path} is not Meander's native library ({problem}); {again()}",
            STATUS_NO_LIBRARY,
        ) from problem
    return library


def _bind(library: ctypes.CDLL, name: str) -> Callable[..., Any]:
    function = getattr(library, name)
    result, arguments = PROTOTYPES[name]
    function.restype = result
    function.argtypes = list(arguments)
    return function


def native() -> ctypes.CDLL:
    """The library, loaded on first use: on Windows a loaded file blocks an update."""
    global _loaded
    if _loaded is None:
        with _load_lock:
            if _loaded is None:
                _loaded = _load(library_path())
    return _loaded


def library_version() -> str:
    """The version of the native library, such as "0.1.0"; loads it.

    Raises MeanderError when the library is missing, damaged, or does not fit this package.
    """
    return native().meander_version().decode("utf-8")


def struct_layouts() -> dict[str, tuple[list[int], list[int]]]:
    """How ctypes and the library lay each struct out, for the test that compares them.

    Per C struct name: (ours, theirs), each the size of the struct followed by the offset of every
    field in the order of declaration. Theirs is empty when the library does not know the name.
    """
    library = native()
    layouts: dict[str, tuple[list[int], list[int]]] = {}
    for name, struct in STRUCTS.items():
        ours = [sizeof(struct)]
        ours += [getattr(struct, field[0]).offset for field in struct._fields_]
        count = library.meander_struct_layout(name.encode(), None, 0)
        theirs = (c_size_t * count)()
        library.meander_struct_layout(name.encode(), theirs, count)
        layouts[name] = (ours, list(theirs))
    return layouts


# ------------------------------------------------------------------------------------------------
# Structs

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


# ------------------------------------------------------------------------------------------------
# Results


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


# ------------------------------------------------------------------------------------------------
# Arrays and handles


def checked_array(name: str, value: ArrayLike, dtype: type, columns: int | None) -> NDArray[Any]:
    """`value` as a C-contiguous array of exactly this dtype, of shape (n,) or (n, columns).

    Numbers that the dtype cannot hold are refused rather than wrapped: a face index of -1
    must not become 4294967295.
    """
    shape = "(n,)" if columns is None else f"(n, {columns})"
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


def created(
    create: Callable[..., int], destroy: Callable[[int], None], *arguments: Any, context: Any
) -> int:
    """The pointer that a function of the library's hands out behind these arguments and before a
    context. Nothing is left of it where that is interrupted."""
    pointer = c_void_p()
    try:
        call(create, *arguments, byref(pointer), context)
    except BaseException:
        if pointer.value is not None:
            destroy(pointer.value)
        raise
    return pointer.value


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
