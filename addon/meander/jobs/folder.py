# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of a job: which items are done, and which another process is at.

For every item `state` holds NAME.json, what became of it, and NAME.lock, which whoever runs it
holds locked. The system frees a lock when its holder ends, however it ends. The item's own process
holds it too, so an item is never taken twice, not even after its runner was killed.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import json
import os
import platform
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path

from .. import core
from ..cli.arguments import files_read
from ..model.files.whole import whole_file
from .child import end_group
from .items import Item
from .job_file import JobError
from .objects import digest_of

try:
    import fcntl
except ModuleNotFoundError:  # on Windows
    fcntl = None
    import msvcrt


@dataclass(frozen=True)
class Record:
    """What became of an item.

    key       of what it was made from; see Folder.key_of
    state     "done" or "failed"
    sentence  what went wrong; empty: nothing
    seconds   that it took
    host      on which it ran
    ended     when, as ISO 8601 in UTC
    sizes     of what it wrote, in bytes by path in the folder
    """

    key: str
    state: str
    sentence: str = ""
    seconds: float = 0.0
    host: str = ""
    ended: str = ""
    sizes: dict[str, int] = field(default_factory=dict)


class Folder:
    """The results of a job and the state of its items."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.state = path / "state"
        self._digests: dict[tuple[str, int, int], str] = {}

    def make(self, items: list[Item]) -> None:
        """Makes all folders that the items write into. Raises JobError."""
        places = {path.parent for item in items for path in item.places}
        places |= {self._note_of(item).parent for item in items} | {self.state}
        for place in sorted(places):
            try:
                place.mkdir(parents=True, exist_ok=True)
            except OSError as problem:
                raise JobError(
                    f"the folder {place} cannot be made ({problem.strerror}); choose another one"
                ) from problem

    def key_of(self, item: Item) -> str:
        """A checksum of all that the result depends on: bytes read, options, version.

        How many threads there are and where the results are put changes nothing. Raises JobError.
        """
        plain, files = vars(item.options), files_read(item.options)
        # What a file is called changes nothing; what is in it does.
        said = {
            name: "a file" if isinstance(value, Path) or name in files else str(value)
            for name, value in plain.items()
            if name not in _NOT_IN_KEY
        }
        read = [self._digest(path) for path in files.values()]
        suffixes = [path.suffix for path in item.places if path != item.log]
        whole = json.dumps([1, core.VERSION, said, read, suffixes], sort_keys=True)
        return hashlib.sha256(whole.encode("utf-8")).hexdigest()

    def record_of(self, item: Item) -> Record | None:
        """What is known of an item, or None."""
        try:
            return Record(**json.loads(self._note_of(item).read_text(encoding="utf-8")))
        except (OSError, ValueError, TypeError):
            return None

    def is_done(self, item: Item, key: str) -> bool:
        """Whether an item is finished, of the same bytes and options, and its files still there."""
        record = self.record_of(item)
        if record is None or record.state != "done" or record.key != key:
            return False
        return record.sizes == self._sizes_of(item)

    def failure_since(self, item: Item, key: str, moment: float) -> str:
        """What went wrong with an item after a moment(), elsewhere; empty: nothing."""
        record = self.record_of(item)
        if record is None or record.state != "failed" or record.key != key:
            return ""
        with contextlib.suppress(OSError):
            if self._note_of(item).stat().st_mtime >= moment:
                return record.sentence
        return ""

    def moment(self) -> float:
        """The time by the clock of the folder, which another machine may hold."""
        probe = self.state / f"now-{os.getpid()}-{time.monotonic_ns()}"
        probe.touch()
        try:
            return probe.stat().st_mtime
        finally:
            probe.unlink()

    def write(self, item: Item, key: str, sentence: str, seconds: float) -> None:
        """Notes what became of an item. Raises FileError."""
        record = Record(
            key, "failed" if sentence else "done", sentence, round(seconds, 3), platform.node(),
            time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()), self._sizes_of(item),
        )  # fmt: skip
        with whole_file(self._note_of(item)) as temporary:
            temporary.write_text(json.dumps(asdict(record), indent=2) + "\n", encoding="utf-8")

    def claim(self, item: Item, needed: bool) -> Claim | None:
        """The right to run an item, or None while somebody else has it.

        needed   others may ask for the same item; else a folder that cannot lock is good enough

        Raises JobError.
        """
        return _claim(self.state / f"{item.name}.lock", needed)

    def missing(self, item: Item) -> list[Path]:
        """What an item should have written and has not."""
        return [path for path in item.written if not path.is_file()]

    def _sizes_of(self, item: Item) -> dict[str, int]:
        """The size of every file of an item that is there, in bytes."""
        sizes: dict[str, int] = {}
        for path in (*item.written, *item.more):
            with contextlib.suppress(OSError):
                sizes[os.path.relpath(path, self.path)] = path.stat().st_size
        return sizes

    def _note_of(self, item: Item) -> Path:
        return self.state / f"{item.name}.json"

    def _digest(self, path: Path) -> str:
        try:
            status = path.stat()
        except OSError:
            return digest_of(path)  # which says so
        known = (str(path), status.st_size, status.st_mtime_ns)
        if known not in self._digests:
            self._digests[known] = digest_of(path)
        return self._digests[known]


# Where things lie, whose bytes count instead, and what changes nothing in them.
_NOT_IN_KEY = (
    *("input", "seed", "guides", "output", "cut", "maps", "report", "threads", "quiet"),
    *("limit_nodes", "limit_memory"),
)


class Claim:
    """The right to run an item, held until released or the process and its child have ended."""

    def __init__(self, handle: int) -> None:
        self.handle = handle
        self._clear()  # whoever stood there has ended

    def note(self, child: int) -> None:
        """Says who holds it: this process, and the group of its child."""
        if fcntl is not None:
            text = json.dumps({"place": _place(), "runner": os.getpid(), "child": child})
            os.pwrite(self.handle, text.encode("ascii"), 0)

    def release(self) -> None:
        self._clear()
        os.close(self.handle)

    def _clear(self) -> None:
        if fcntl is not None:  # on Windows a locked file is no place for notes
            os.ftruncate(self.handle, 0)


def _claim(path: Path, needed: bool) -> Claim | None:
    handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
    try:
        _lock(handle)
    except OSError as problem:
        if problem.errno in (errno.EACCES, errno.EAGAIN, errno.EDEADLK):
            _end_orphan(handle)
            os.close(handle)
            return None
        if needed:
            os.close(handle)
            raise JobError(
                f"files in {path.parent} cannot be locked ({problem.strerror}), so processes "
                "cannot share items; give each a part of its own with --shard I/N"
            ) from problem
    return Claim(handle)


def _lock(handle: int) -> None:
    if fcntl is not None:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    else:
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)


def _place() -> str:
    """Where process numbers mean the same; empty: unknown."""
    with contextlib.suppress(OSError):
        boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
        return f"{boot} {os.readlink('/proc/self/ns/pid')}"
    return ""


def _end_orphan(handle: int) -> None:
    """Ends the child of a runner that was killed: nobody would end it at its time limit."""
    with contextlib.suppress(OSError, ValueError, KeyError, TypeError):
        said = json.loads(os.pread(handle, 4096, 0))
        if not said["place"] or said["place"] != _place():
            return
        if not os.path.exists(f"/proc/{said['runner']}"):
            end_group(said["child"])
