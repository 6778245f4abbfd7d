# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a job file: TOML with [job], [defaults] and [[items]]."""

from __future__ import annotations

import difflib
import os
import re
import sys
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..model.files.text import read_plain
from ..model.files.whole import FileError

# What "\t", "\b", "\f" and the like in quotes are.
_BACKSLASH = re.compile(r"\\")
# A number as other languages have it: .2, -.5 or 3., behind what a value stands behind.
_BARE_POINT = re.compile(r"[=\[,]\s*[+-]?(\.\d|\d+\.(?!\d))")
_CONTROL = re.compile(r"[\x00-\x1f\x7f]")

ENGINES = ("auto", "blender", "python")

# What an item may take, with the least that makes sense: with less memory no Python starts, or it
# hangs before it does.
LEAST_LIMITS = {"timeout": (1, "seconds"), "memory": (100, "megabytes")}

# What [job] may hold, by the kind of value.
_JOB_KEYS = {"folder": str, "engine": str, "blender": str, "python": str, "command": list}
_KINDS = {str: "a text in quotes", list: "a list of texts in quotes"}


class JobError(Exception):
    """A job that cannot be run as it is; ``str(error)`` is one sentence for people."""


@dataclass(frozen=True)
class JobFile:
    """What a job file says, before globs and patterns are looked at.

    path      of the file, absolute; what is relative in it is so to its folder
    folder    of all that is written
    engine    one of ENGINES
    blender, python   programs; empty: to be found
    command   what the flags of an item are put behind instead; empty: nothing
    defaults  for every item
    items     of the file, in its order
    """

    path: Path
    folder: Path
    engine: str = "auto"
    blender: str = ""
    python: str = ""
    command: tuple[str, ...] = ()
    defaults: dict[str, Any] = field(default_factory=dict)
    items: tuple[dict[str, Any], ...] = ()


def read(path: Path) -> JobFile:
    """The job that a file describes. Raises JobError."""
    try:
        path = Path(os.path.abspath(path))
    except OSError as problem:  # the current folder has been deleted
        raise JobError(
            f"{path} cannot be read ({problem.strerror}); change into a folder that exists"
        ) from problem
    tables = _tables(path)
    for name in tables:
        if name not in ("job", "defaults", "items"):
            raise JobError(
                f"{path.name}: {quoted(name)} stands outside of [job], [defaults] and [[items]]; "
                "put it into one of them"
            )
    job = _table(path, tables, "job")
    _check_job(path, job)
    items = tables.get("items", [])
    if not isinstance(items, list) or not all(isinstance(item, dict) for item in items):
        raise JobError(f"{path.name}: items are tables; begin each with a line [[items]]")
    if not items:
        raise JobError(f"{path.name}: there is nothing to do; add [[items]] with an input")
    folder = path.parent / job.pop("folder", path.stem)
    command = tuple(job.pop("command", ()))
    defaults = _table(path, tables, "defaults")
    return JobFile(path, folder, command=command, defaults=defaults, items=tuple(items), **job)


def _tables(path: Path) -> dict[str, Any]:
    try:
        import tomllib
    except ModuleNotFoundError as missing:
        raise JobError(
            f"job files need Python 3.11 or later, and this is {sys.version.split()[0]}; run this "
            "command with another Python, or in Blender 4.1 or later"
        ) from missing
    try:
        tables = tomllib.loads(read_plain(path, may_be_empty=True).decode("utf-8"))
    except FileError as problem:
        raise JobError(str(problem)) from problem
    except UnicodeDecodeError as problem:
        raise JobError(f"{path} is not text in UTF-8; save it again as UTF-8") from problem
    except ValueError as problem:  # also of numbers without end
        if re.search(r"^(Unescaped|Invalid hex value)", str(problem)) and (
            backslash := _line_of(problem, path, _BACKSLASH)
        ):
            raise JobError(
                f"{path}, line {backslash}: a backslash in \"...\" begins a special letter; write "
                "paths with /, or in '...'"
            ) from problem
        if number := _line_of(problem, path, _BARE_POINT):
            raise JobError(
                f"{path}, line {number}: a number of TOML has a digit before its point and behind "
                "it; write 0.2 for .2"
            ) from problem
        raise JobError(f"{path} is no TOML: {problem}; correct it there") from problem
    except RecursionError as problem:
        raise JobError(f"{path} has brackets in brackets without end; correct it") from problem
    _refuse_control_letters(path, tables)
    return tables


def _line_of(problem: ValueError, path: Path, pattern: re.Pattern[str]) -> int:
    """The line that an error names, where a pattern is found in it; else 0."""
    found = re.search(r"at line (\d+)", str(problem))
    lines = read_plain(path).decode("utf-8", "replace").split("\n")
    number = int(found[1]) if found else 0
    return number if number and pattern.search(lines[number - 1]) else 0


def _refuse_control_letters(path: Path, value: Any) -> None:
    """Raises JobError for a text that a path of Windows in quotes has become, such as "a\tile"."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for part in value:
            _refuse_control_letters(path, part)
    elif isinstance(value, str) and not value.isprintable() and _CONTROL.search(value):
        raise JobError(
            f"{path.name}: {quoted(value)} holds a letter that a backslash in \"...\" makes; write "
            "paths with /, or in '...'"
        )


def _table(path: Path, tables: dict[str, Any], name: str) -> dict[str, Any]:
    table = tables.get(name, {})
    if not isinstance(table, dict):
        raise JobError(f"{path.name}: {name} is a table; begin it with a line [{name}]")
    return dict(table)


def _check_job(path: Path, job: dict[str, Any]) -> None:
    for key, value in job.items():
        kind = _JOB_KEYS.get(key)
        if kind is None:
            raise JobError(f"{path.name}: [job] {unknown_key(key, _JOB_KEYS)}")
        right = isinstance(value, kind)
        if right and kind is list:
            right = bool(value) and all(isinstance(part, str) for part in value)
        if not right:
            raise JobError(f"{path.name}: [job] {key} is {_KINDS[kind]}, not {quoted(value)}")
        texts(f"{path.name}: [job]", key, value)
    if job.get("engine", "auto") not in ENGINES:
        choices = ", ".join(ENGINES)
        raise JobError(
            f"{path.name}: [job] has no engine {quoted(job['engine'])}; choose from {choices}"
        )
    if "command" in job and len(job) > 1 + ("folder" in job):
        raise JobError(
            f"{path.name}: [job] command stands for engine, blender and python; drop these"
        )


def quoted(value: Any) -> str:
    """What stands in a job file, as Python would write it; of much the beginning."""
    text = repr(value)
    return text if len(text) <= 80 else text[:77] + "..."


def unknown_key(key: str, known: Iterable[str]) -> str:
    """The end of a sentence about a key that there is not."""
    near = difflib.get_close_matches(key, list(known), 1)
    advice = f"did you mean {near[0]!r}?" if near else "see the page about farms"
    return f"has the unknown key {quoted(key)}; {advice}"


def limit(where: str, key: str, value: Any) -> float:
    """The limit `key` of LEAST_LIMITS as a number. Raises JobError."""
    least, unit = LEAST_LIMITS[key]
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    # The one is not finite, and the other larger than any double.
    if not number or value != value or not least <= value <= sys.float_info.max:
        given = quoted(value)
        raise JobError(f"{where}: {key} is a number of {unit}, {least} or more, not {given}")
    return float(value)


def texts(where: str, key: str, value: Any) -> list[str]:
    """A text, or a list of them, as a list. Raises JobError."""
    several = value if isinstance(value, list) else [value]
    if any(isinstance(one, str) and not one.strip() for one in several):
        raise JobError(f"{where}: {key} is empty; give a name, or leave it out")
    if not several or not all(isinstance(one, str) and one for one in several):
        raise JobError(f"{where}: {key} is a text in quotes or a list of them, not {quoted(value)}")
    return several
