# SPDX-License-Identifier: GPL-3.0-or-later
"""Which functions of the add-on a test calls, and which tests are enough to call them all.

Versions of Blender differ in what they answer to a function of ours, not in what the library
computes. So the gate runs every test in one Blender, which notes what each of them calls, and in
the other as many as call every function of the files that import bpy. Every night both run all
(scripts/test.sh --all). What a test that is skipped or fails in the one calls is not known, so it
runs in the other.

Calls are seen in the process of the tests only: that some test of a file starts programs counts as
a function of that file.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from types import CodeType, FrameType

IMPORTS_BPY = re.compile(r"^\s*(?:import|from) bpy\b", re.MULTILINE)
STARTS_PROGRAMS = subprocess.Popen.__init__.__code__


@contextmanager
def called() -> Iterator[set[CodeType]]:
    """The code of every function that this thread calls meanwhile, whoever has written it."""
    seen: set[CodeType] = set()

    def note(frame: FrameType, _event: str, _argument: object) -> None:
        seen.add(frame.f_code)

    before = sys.gettrace()
    sys.settrace(note)
    try:
        yield seen
    finally:
        sys.settrace(before)


@cache
def _is_of_blender(file: str) -> bool:
    return bool(IMPORTS_BPY.search(Path(file).read_text(encoding="utf-8")))


def of_blender(seen: Collection[CodeType], package: Path, test: str) -> list[str]:
    """The names "scene/results.py last_result" of those in files of the package that import bpy."""
    names = set()
    for code in seen:
        if code is STARTS_PROGRAMS:
            names.add(f"{test.split('::')[0]} starts programs")
        elif code.co_filename.startswith(f"{package}/") and _is_of_blender(code.co_filename):
            names.add(f"{code.co_filename[len(str(package)) + 1:]} {code.co_qualname}")
    return sorted(names)


def enough(calls: Mapping[str, Collection[str]]) -> set[str]:
    """Tests that call every function that any does: each is the first of those that add most."""
    chosen: set[str] = set()
    left = {test: set(names) for test, names in calls.items()}
    while True:
        most = max(left, key=lambda test: len(left[test]), default=None)
        if most is None or not left[most]:
            return chosen
        chosen.add(most)
        now_called = left.pop(most)
        for names in left.values():
            names -= now_called


def write(file: Path, calls: Mapping[str, Collection[str]]) -> None:
    """Writes the functions that each test calls, for `read`."""
    file.write_text(json.dumps(calls, indent=0), encoding="utf-8")


def read(file: Path) -> dict[str, list[str]]:
    """What `write` has written, in its order; nothing where it has not."""
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
