# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are read whole, and written whole or not at all; no bpy."""

from __future__ import annotations

import os
import secrets
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

# A longer suffix is none that a writer goes by, and the name of a file may only be so long.
_LONGEST_SUFFIX = 8

# Whoever starts this process may say in this variable of its environment how the names of its
# temporary files begin, and so finds those that it leaves when it is killed.
TEMPORARY_NAMES = "MEANDER_TEMPORARY_NAMES"


class FileError(Exception):
    """A file that cannot be read or written; ``str(error)`` is one sentence for people."""


def read_bytes(path: Path) -> bytes:
    """What is in a file. Raises FileError when it cannot be read."""
    try:
        return path.read_bytes()
    except OSError as problem:
        raise FileError(
            f"{path} cannot be read ({problem.strerror or problem}); check the path"
        ) from problem


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A temporary path for a writer, which becomes the file `path` when the block ends well.

    A file that is there keeps its mode, and a symbolic link stays one: what it points to is
    written. What is no file, such as a pipe or a device, is written into at the end. After an
    exception everything is as it was and the temporary file is gone. The temporary path lies beside
    the file and has its suffix, since some writers go by these.

    Raises FileError when the file cannot be written.
    """
    try:
        target = Path(os.path.realpath(path))
        mode = _mode_of(path)
        if mode is None or stat.S_ISREG(mode):
            temporary = _beside(target)
            with _removed(temporary):
                _make(temporary, mode)
                yield temporary
                if mode is not None:
                    temporary.chmod(stat.S_IMODE(mode))
                os.replace(temporary, target)
        else:
            with tempfile.TemporaryDirectory() as folder:
                temporary = _beside(Path(folder) / target.name)
                yield temporary
                with temporary.open("rb") as source, path.open("wb") as sink:
                    shutil.copyfileobj(source, sink)
    except OSError as problem:
        raise FileError(
            f"{path} cannot be written ({problem.strerror or problem}); choose another place"
        ) from problem


def _mode_of(path: Path) -> int | None:
    """The mode of what is there, links followed; None: nothing is."""
    try:
        return path.stat().st_mode
    except FileNotFoundError:
        return None


def _beside(target: Path) -> Path:
    """A new name in the same folder, as short as can be: the file's own may have no room left."""
    suffix = target.suffix if len(target.suffix) <= _LONGEST_SUFFIX else ""
    begin = os.environ.get(TEMPORARY_NAMES, "")
    return target.with_name(f".{begin}{secrets.token_hex(4)}.tmp{suffix}")


def _make(temporary: Path, mode: int | None) -> None:
    """Makes the temporary file before it is written, so that nobody reads what they may not.

    Not for Blender, which would keep what is there as a backup; it writes elsewhere first anyway.
    """
    if mode is not None and temporary.suffix != ".blend":
        os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600))


@contextmanager
def _removed(temporary: Path) -> Iterator[None]:
    try:
        yield
    finally:
        temporary.unlink(missing_ok=True)
