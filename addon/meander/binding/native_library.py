# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds and loads the native library, and what every call into it needs: errors, arrays, handles.

What the library does is for `core` to know; hosts have no use for this module.
"""

from __future__ import annotations

import ctypes
import os
import sys
import threading
from collections.abc import Callable
from ctypes import c_size_t, sizeof
from pathlib import Path
from typing import Any

from .abi import ABI_VERSION, PROTOTYPES, STRUCTS, VERSION
from .errors import STATUS_NO_LIBRARY, MeanderError
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

# Names the library file to load instead of the one in the package.
LIBRARY_VARIABLE = "MEANDER_LIBRARY"


# The libraries of the package, in a folder for each platform.
_NATIVE = Path(__file__).resolve().parents[1] / "native"


# ------------------------------------------------------------------------------------------------
# Errors


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
        what = "a folder" if path.is_dir() else "no file" if path.exists() else "missing"
        raise MeanderError(
            f"the native library {path}, which {LIBRARY_VARIABLE} names, is {what}; correct that "
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


# ------------------------------------------------------------------------------------------------
# Results


# ------------------------------------------------------------------------------------------------
# Arrays and handles


