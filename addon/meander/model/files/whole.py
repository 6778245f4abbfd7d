# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are read whole, and written whole or not at all; no bpy."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
import stat
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

# What file systems without a way to flush say to it.
_NO_FLUSH = (errno.EINVAL, errno.ENOSYS, errno.ENOTSUP)

# A longer suffix is none that a writer goes by, and the name of a file may only be so long.
_LONGEST_SUFFIX = 8

# Whoever starts this process may say in this variable of its environment how the names of its
# temporary files begin, and so finds those that it leaves when it is killed.
TEMPORARY_NAMES = "MEANDER_TEMPORARY_NAMES"


# Where systems keep the names of what is open.
_OPEN = (("/", "dev"), ("/", "proc"))


class FileError(Exception):
    """A file that cannot be read or written; ``str(error)`` is one sentence for people."""


def path_of(name: Any) -> Path:
    """The path of what a program gives for one. Raises FileError for what is none."""
    try:
        return Path(os.fsdecode(name))
    except TypeError:
        raise FileError(f"a {type(name).__name__} is no path; give a str or a Path") from None


def why_no_file(path: Path) -> str:
    """Why a path names nothing that can be read, as the end of a sentence; empty: it does.

    Raises OSError for a name that no file can have.
    """
    if path.is_file():
        return ""
    if path.is_dir():
        return "is a folder; name a file in it"
    if path.exists():
        return "is a pipe or a device, and no file; write what comes out of it to a file first"
    return "does not exist; check the path"


def are_one(path: Path, other: Path) -> bool:
    """Whether two paths name the same file: through links, or in capitals where a file system
    does not tell them from small letters."""
    if os.path.realpath(path) == os.path.realpath(other):
        return True
    try:
        return path.samefile(other)
    except OSError:  # one of them is not there
        return False


class NotWritten(FileError):
    """One that cannot be written.

    reason   why, as the system puts it
    """

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(path, reason)  # what it is made of again where it is unpickled
        self.reason = reason

    def __str__(self) -> str:
        path, reason = self.args
        return f"{path} cannot be written ({reason}); choose another place"


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

    A file that is there keeps its mode, and its owner where this process may give it away; one
    that may not be written is not replaced either. A symbolic link stays one: what it points to is
    written. What is no file, such as a pipe or a device, is written into at the end. After an
    exception everything is as it was and the temporary file is gone; a process that is killed
    leaves that one behind, and nothing else. The temporary path lies beside the file and has its
    suffix, since some writers go by these. Its contents are on the disk before they take the name.

    Raises FileError when the file cannot be written.
    """
    with whole_files([path]) as (temporary,), naming(path):
        yield temporary


class Whole(list[Path]):
    """Temporary paths of files that become files together, as whole_files() gives them."""

    def __init__(self, stack: ExitStack) -> None:
        super().__init__()
        self.begun: list[_Begun] = []
        self._stack = stack

    def begin(self, path: Path) -> Path:
        """The temporary path of one more, which takes its name before those that are there."""
        with naming(path):
            self.begun.insert(0, self._stack.enter_context(_begun(path)))
        return self.begun[0].temporary


@contextmanager
def whole_files(paths: Sequence[Path]) -> Iterator[Whole]:
    """The same for several: none becomes a file before all of them are on their disks.

    They take their names in the order of `paths`, one after the other: who finds the last one finds
    all of them. An OSError of the block is for the writer to put into words: see `naming`.
    """
    with ExitStack() as stack:
        whole = Whole(stack)
        whole += [whole.begin(path) for path in paths]
        whole.begun.reverse()
        yield whole
        for each in whole.begun:
            with naming(each.path):
                each.complete()
        for each in whole.begun:
            with naming(each.path):
                each.move()


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Says which file it is that an OSError of the block is about: it becomes a FileError.

    One that names a temporary file of ours, from a writer that was given its path, names `path`.
    """
    try:
        yield
    except (OSError, NotWritten) as problem:
        reason = problem.reason if isinstance(problem, NotWritten) else problem.strerror or problem
        raise NotWritten(path, str(reason)) from problem


@dataclass(frozen=True)
class _Begun:
    """A file that is being written under another name.

    path       as it was asked for
    target     where that leads
    there      the status of what is there; None: nothing is
    temporary  what is written meanwhile
    """

    path: Path
    target: Path
    there: os.stat_result | None
    temporary: Path

    @property
    def is_moved(self) -> bool:
        """Whether the temporary file becomes the file; what is no file is written into."""
        return _is_replaced(self.path, self.there)

    def complete(self) -> None:
        """Everything that can fail before a name is taken."""
        if self.is_moved:
            _flush(self.temporary)  # while this process may open it
            if self.there is not None:
                _give_rights(self.temporary, self.there)

    def move(self) -> None:
        if self.is_moved:
            os.replace(self.temporary, self.target)
            _flush_folder(self.target.parent)
        else:
            with self.temporary.open("rb") as source, self.path.open("ab") as sink:
                shutil.copyfileobj(source, sink)


@contextmanager
def _begun(path: Path) -> Iterator[_Begun]:
    target, there = Path(os.path.realpath(path)), _status_of(path)
    with ExitStack() as stack:
        if _is_replaced(path, there):
            if there is not None and not os.access(target, os.W_OK):
                raise PermissionError(errno.EACCES, "it is protected against writing")
            temporary = _beside(target)
            stack.callback(temporary.unlink, missing_ok=True)
            _make(temporary, there)
        else:
            folder = stack.enter_context(tempfile.TemporaryDirectory())
            temporary = _beside(Path(folder) / target.name)
        yield _Begun(path, target, there, temporary)


def _is_replaced(path: Path, there: os.stat_result | None) -> bool:
    """Whether a file takes the place of what is there. A file that somebody has open by the name of
    a device, such as /dev/stderr, is not replaced: its lines would go to one without a name."""
    if there is None:
        return True
    return stat.S_ISREG(there.st_mode) and Path(os.path.abspath(path)).parts[:2] not in _OPEN


def _flush(path: Path) -> None:
    """Waits until what was written into a file is on the disk: some say only then that it is full.

    Raises OSError.
    """
    with path.open("r+b") as file:
        try:
            os.fsync(file.fileno())
        except OSError as problem:
            if problem.errno not in _NO_FLUSH:
                raise


def _flush_folder(folder: Path) -> None:
    """Has a new name reach the disk, where a folder can be opened for that. The file is in its
    place already, so that a failure is none of the file's."""
    if os.name == "nt":
        return
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _status_of(path: Path) -> os.stat_result | None:
    """The status of what is there, links followed; None: nothing is."""
    try:
        return path.stat()
    except FileNotFoundError:
        return None


def _give_rights(temporary: Path, there: os.stat_result) -> None:
    """The owner, as far as this process may, and the mode of the file that is there."""
    if hasattr(os, "chown"):
        made = temporary.stat()
        if (made.st_uid, made.st_gid) != (there.st_uid, there.st_gid):
            with suppress(PermissionError):
                os.chown(temporary, there.st_uid, there.st_gid)
    temporary.chmod(stat.S_IMODE(there.st_mode))


def _beside(target: Path) -> Path:
    """A new name in the same folder, as short as can be: the file's own may have no room left."""
    suffix = target.suffix if len(target.suffix) <= _LONGEST_SUFFIX else ""
    begin = os.environ.get(TEMPORARY_NAMES, "")
    return target.with_name(f".{begin}{secrets.token_hex(4)}.tmp{suffix}")


def _make(temporary: Path, there: os.stat_result | None) -> None:
    """Makes the temporary file before it is written, so that nobody reads what they may not.

    Not for Blender, which would keep what is there as a backup; it writes elsewhere first anyway.
    """
    if there is not None and temporary.suffix != ".blend":
        os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600))
