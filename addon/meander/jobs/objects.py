# SPDX-License-Identifier: GPL-3.0-or-later
"""Which mesh objects a .blend holds: Blender is asked, once for each file and its contents."""

from __future__ import annotations

import hashlib
import json
import subprocess
from collections.abc import Sequence
from pathlib import Path

from ..model.files.whole import whole_file
from .job_file import JobError

_SCRIPT = Path(__file__).resolve().parents[1] / "headless" / "list_objects.py"
# Opening a file is all that Blender does here.
_LONGEST_SECONDS = 600


class Meshes:
    """Names of mesh objects by file. What is found is kept in a folder, for other processes.

    blender   the program and its first arguments
    kept      the folder; None: nothing is kept
    """

    def __init__(self, blender: Sequence[str], kept: Path | None) -> None:
        self._blender = list(blender)
        self._kept = kept
        self._known: dict[Path, list[str]] = {}

    def of(self, path: Path) -> list[str]:
        """The mesh objects in the scene of a .blend, sorted. Raises JobError, FileError."""
        if path not in self._known:
            self._known[path] = self._read(path)
        return self._known[path]

    def _read(self, path: Path) -> list[str]:
        digest = digest_of(path)  # before Blender is asked: it says what is wrong with the path
        note = None if self._kept is None else self._kept / f"{digest}.json"
        if note is not None:
            try:
                return json.loads(note.read_text(encoding="utf-8"))
            except (OSError, ValueError):
                pass  # not asked yet
        names = self._ask(path)
        if note is not None:
            note.parent.mkdir(parents=True, exist_ok=True)
            with whole_file(note) as temporary:
                temporary.write_text(json.dumps(names), encoding="utf-8")
        return names

    def _ask(self, path: Path) -> list[str]:
        if not _SCRIPT.is_file():
            raise JobError(
                f"the objects of {path} can be listed in Blender only; start the job by farm.py "
                "of the add-on"
            )
        command = [*self._blender, "--python-exit-code", "1", "--python", str(_SCRIPT), "--"]
        try:
            done = subprocess.run(
                [*command, str(path)], capture_output=True, encoding="utf-8", errors="replace",
                timeout=_LONGEST_SECONDS, stdin=subprocess.DEVNULL,
            )  # fmt: skip
        except (OSError, subprocess.TimeoutExpired) as problem:
            raise JobError(
                f"the objects of {path} cannot be listed with {self._blender[0]!r} ({problem}); "
                "name Blender with blender in [job]"
            ) from problem
        for line in done.stdout.splitlines():
            if done.returncode == 0 and line.startswith("meander objects: "):
                return json.loads(line.removeprefix("meander objects: "))
        raise JobError(
            f"the objects of {path} cannot be listed, as Blender cannot open it; "
            "save it again with this version or an older one"
        )


def digest_of(path: Path) -> str:
    """A checksum of the bytes of a file. Raises JobError."""
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as problem:
        raise JobError(f"{path} cannot be read ({problem.strerror}); check the path") from problem
