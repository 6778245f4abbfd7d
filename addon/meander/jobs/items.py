# SPDX-License-Identifier: GPL-3.0-or-later
"""The items of a job: globs over files, objects and frames followed, names given, all checked."""

from __future__ import annotations

import argparse
import fnmatch
import glob
import itertools
import os
import re
import string
import unicodedata
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..cli.arguments import files_read
from ..model import sheets
from ..model.files.whole import why_no_file
from ..model.image_files import is_of
from . import job_file, options
from .job_file import JobError, JobFile, texts
from .objects import Meshes

_FRAMES = re.compile(r"\s*(-?\d{1,7})\s*(?:-\s*(-?\d{1,7})\s*(?::\s*(\d{1,7})\s*)?)?")
# What may stand behind a placeholder's colon, such as 04: a name has a few hundred letters at most.
_WIDTH = re.compile(r"[<>^]?\d{0,3}d?")
# Items of one job; more are surely a mistake in the frames.
_MOST_FRAMES = 100_000
# Of a file or a folder, in bytes: file systems have room for 255, of which the ends of names and of
# temporary files take some.
_LONGEST_NAME = 200


@dataclass(frozen=True)
class Item:
    """One run of the batch command.

    name      unique in the job; what it writes beside its output is called so
    arguments of the batch command, without those that say only how it runs
    options   the same, parsed
    report, log   what is written of the run
    timeout   seconds that it may take; None: any
    memory    megabytes that it may ask for; None: any
    """

    name: str
    arguments: tuple[str, ...]
    options: argparse.Namespace
    report: Path
    log: Path
    timeout: float | None = None
    memory: float | None = None

    @property
    def written(self) -> list[Path]:
        """Every file that the batch command writes."""
        outputs = [path for path in (self.options.output, self.options.cut) if path is not None]
        return [*outputs, self.report]

    @property
    def places(self) -> list[Path]:
        """What names the files that are written: those, the log, and what images are called by."""
        of_images = [] if self.options.maps is None else [self.options.maps]
        return [*self.written, self.log, *of_images]

    @property
    def more(self) -> list[Path]:
        """Files that are there of which the run decides how many there are: images of its maps,
        sheets of its drawing."""
        found: list[Path] = []
        for of_run, name in self.several:
            if name.parent.is_dir():
                found += sorted(path for path in name.parent.iterdir() if of_run(name, path))
        return found

    @property
    def several(self) -> list[tuple[Callable[[Path, Path], bool], Path]]:
        """Names of which the run makes others, and what says whether one is of them."""
        sheet = None if self.options.sheet is None else self.options.output
        both = ((is_of, self.options.maps), (sheets.is_of, sheet))
        return [(of_run, name) for of_run, name in both if name is not None]


def items_of(job: JobFile, meshes: Meshes, summary: Path | None = None) -> list[Item]:
    """All items of a job, in the order of its file. Raises JobError.

    summary  is written of the job, beside what the items write; None: nothing
    meshes   says which meshes a .blend holds, where an item has a pattern for their names
    """
    named: dict[str, Item] = {}
    defaults = options.check_keys(f"{job.path.name}: [defaults]", job.defaults)
    for number, table in enumerate(job.items, 1):
        where = f"{job.path.name}: [[items]] number {number}"
        merged = defaults | options.check_keys(where, table)
        for item in _expanded(job, where, merged, meshes, named):
            other = named.get(one_file(item.name))
            if other is not None:
                raise JobError(f"{where}: {_one_name(item.name, other.options, item.options)}")
            named[one_file(item.name)] = item
    items = list(named.values())
    _check_paths(items, job.path, summary)
    return items


def _one_name(name: str, first: argparse.Namespace, second: argparse.Namespace) -> str:
    """About two items with one name, by their options: what they are made from, and what to do."""
    both = f"two items are called {name!r}, of {first.input} and of {second.input}"
    for part, differs in (
        ("{stem}-{object}", first.object != second.object),
        ("{stem}-{frame}", first.frame != second.frame),
        ("{folder}-{stem}", first.input.parent.name != second.input.parent.name),
        ("{stem}-{suffix}", first.input.suffix.lower() != second.input.suffix.lower()),
    ):
        if differs:
            return f'{both}; tell them apart with name = "{part}"'
    return f'{both}; give one of them a name of its own, such as name = "{{stem}}-fine"'


def shard_of(items: list[Item], number: int, count: int) -> list[Item]:
    """Part `number` of `count`, counted from 1: every item is in exactly one, whoever asks."""
    return items[number - 1 :: count]


def one_file(path: str) -> str:
    """What names have in common that are one file where a system does not tell capitals from small
    letters, or letters with accents from letters and accents."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", path).casefold())


def _expanded(
    job: JobFile, where: str, table: dict[str, Any], meshes: Meshes, named: Mapping[str, Item]
) -> Iterable[Item]:
    """The items that one table of the file stands for.

    named   those that are there already, by one_file() of their names
    """
    if "input" not in table:
        raise JobError(f"{where}: the input is missing; name a file, or several by a pattern")
    frames = _frames(where, table)
    patterns = texts(where, "object", table["object"]) if "object" in table else None
    for path in _files(job, where, texts(where, "input", table["input"])):
        for name in _objects(where, path, patterns, meshes):
            for frame in frames:
                yield _item(job, where, table, path, name, frame, named)


def _files(job: JobFile, where: str, patterns: list[str]) -> list[Path]:
    """The files that patterns stand for, each once, those of a pattern sorted."""
    found: dict[Path, None] = {}
    results = os.path.abspath(job.folder) + os.sep
    for pattern in patterns:
        whole = _place(where, "input", job.path.parent, pattern)
        if whole.exists() or not glob.has_magic(pattern):
            found[whole] = None
            continue
        matches = sorted(glob.glob(str(whole), recursive=True))
        # What the job itself has written is not its input.
        files = [path for path in matches if not os.path.abspath(path).startswith(results)]
        files = [path for path in files if os.path.isfile(path)]
        if not files:
            raise JobError(f"{where}: no file is called {pattern!r}; correct the pattern")
        found.update((Path(path), None) for path in files)
    return list(found)


def _objects(
    where: str, path: Path, patterns: list[str] | None, meshes: Meshes
) -> list[str | None]:
    """The objects of a file that patterns stand for; [None]: the active one."""
    if patterns is None:
        return [None]
    if path.suffix.lower() != ".blend" or not any(map(glob.has_magic, patterns)):
        return list(dict.fromkeys(patterns))
    there = meshes.of(path)
    found: dict[str, None] = {}
    for pattern in patterns:
        names = [pattern] if pattern in there else fnmatch.filter(there, pattern)
        if not names:
            has = ", ".join(there[:5]) + (" and more" if len(there) > 5 else "") or "none"
            raise JobError(
                f"{where}: no mesh object of {path} is called {pattern!r}, but it has {has}; "
                "correct the pattern"
            )
        found.update((name, None) for name in names)
    return list(found)


def _frames(where: str, table: Mapping[str, Any]) -> list[int | None]:
    """The frames of an item; [None]: the one that the file was saved in."""
    if "frames" not in table:
        return [None]
    if "frame" in table:
        raise JobError(f"{where}: frame and frames are both there; keep one")
    if "bake-frames" in table:
        raise JobError(
            f"{where}: baked frames cannot be parted, as the curve of each goes on from the one "
            "before; leave frames out, and the item bakes all of bake-frames"
        )
    value = table["frames"]
    parts = value if isinstance(value, list) else str(value).split(",")
    frames: dict[int, None] = {}
    for part in parts:
        match = None if isinstance(part, (bool, float)) else _FRAMES.fullmatch(str(part))
        if match is None:
            raise JobError(
                f'{where}: the frames {value!r} cannot be read; write them as "1-24, 30", or '
                '"1-100:10" for every tenth'
            )
        first, last, step = (None if group is None else int(group) for group in match.groups())
        span = range(first, (first if last is None else last) + 1, 1 if step is None else step or 1)
        if not 0 < len(span) <= _MOST_FRAMES:
            raise JobError(f"{where}: the frames {part!r} are none, or too many; correct them")
        frames.update((frame, None) for frame in span)
    return sorted(frames)


def _item(
    job: JobFile,
    where: str,
    table: Mapping[str, Any],
    path: Path,
    object_name: str | None,
    frame: int | None,
    named: Mapping[str, Item],
) -> Item:
    values = {
        "stem": _as_part(path.stem),
        "suffix": _as_part(path.suffix.lower()),
        "folder": _as_part(path.parent.name),
        "object": _as_part(object_name or ""),
        "frame": "" if frame is None else frame,
    }
    name = _filled(where, "name", table.get("name", _usual_name(object_name, frame)), values)
    name = _apart(name, named)
    where = f"{where} ({name})"
    chosen = {key: table[key] for key in table if key not in options.OWN_KEYS}
    chosen["input"] = str(path)
    for key in options.read_keys(path):
        if key in chosen:
            chosen[key] = str(_existing(where, key, job.path.parent, chosen[key]))
    for key in options.WRITTEN_KEYS:
        pattern = table.get(key, "{name}.obj" if key == "output" else None)
        if pattern is not None:
            chosen[key] = str(job.folder / _filled(where, key, pattern, values | {"name": name}))
    if object_name is not None:
        chosen["object"] = object_name
    if frame is not None:
        chosen["frame"] = frame
    arguments = options.flags_of(where, chosen)
    limits: dict[str, float] = {
        key: job_file.limit(where, key, table[key])
        for key in job_file.LEAST_LIMITS
        if key in table
    }
    beside = job.folder / name
    return Item(
        name,
        tuple(arguments),
        options.check(where, arguments),
        beside.with_name(f"{beside.name}.report.json"),
        beside.with_name(f"{beside.name}.log"),
        **limits,
    )


def _apart(name: str, named: Mapping[str, Item]) -> str:
    """A name, with a number behind it where another differs from it in capitals only: what they
    write would be one file on some systems, and has the same name on all."""
    other = named.get(one_file(name))
    if other is None or other.name == name:
        return name
    numbers = itertools.count(2)
    return next(new for k in numbers if one_file(new := f"{name}-{k}") not in named)


def _usual_name(object_name: str | None, frame: int | None) -> str:
    parts = ["{stem}"]
    parts += [] if object_name is None else ["{object}"]
    parts += [] if frame is None else ["{frame:04}"]
    return "-".join(parts)


def _as_part(text: str) -> str:
    """A name as a part of a path: without what a path may not have everywhere."""
    return re.sub(r"[^\w.+-]+", "_", text).lstrip(".") or "_"


def _filled(where: str, key: str, pattern: Any, values: Mapping[str, Any]) -> str:
    """A pattern with the values in the places of its placeholders."""
    if not isinstance(pattern, str):
        raise JobError(f"{where}: {key} is a text in quotes, not {pattern!r}")
    try:
        # Only the names themselves: not what hangs on a value in Python, such as {stem.__class__}.
        for _text, name, width, _conversion in string.Formatter().parse(pattern):
            if name is not None and (name not in values or not _WIDTH.fullmatch(width or "")):
                raise KeyError(name)
        text = pattern.format(**values)
    except (KeyError, IndexError, ValueError, AttributeError) as problem:
        known = ", ".join(f"{{{name}}}" for name in values)
        raise JobError(
            f"{where}: the {key} {pattern!r} cannot be filled in; use {known}"
        ) from problem
    _refuse_backslashes(where, key, text)
    parts = Path(text).parts
    if not text.strip():
        raise JobError(f"{where}: the {key} is empty; give one, or leave it out")
    if os.path.isabs(text) or ".." in parts or parts[0].startswith("."):
        raise JobError(f"{where}: the {key} {text!r} leads out of the job's folder; correct it")
    if any(len(os.fsencode(part)) > _LONGEST_NAME for part in parts):
        raise JobError(f"{where}: the {key} is too long for a file; give a shorter one")
    return text


def _place(where: str, key: str, folder: Path, text: str) -> Path:
    """Where a file that is read may be, which need not be there. Raises JobError."""
    path = folder / text
    try:
        there = path.exists()
    except OSError as problem:
        raise JobError(
            f"{where}: the {key} can be no file ({problem.strerror}); correct "
            f"{job_file.quoted(text)}"
        ) from problem
    if not there:
        _refuse_backslashes(where, key, text)
    return path


def _refuse_backslashes(where: str, key: str, text: str) -> None:
    """Elsewhere than on Windows they are letters like any other, and surely not meant as such."""
    if os.sep == "/" and "\\" in text:
        raise JobError(f"{where}: the {key} {text!r} has backslashes; write paths with /")


def _existing(where: str, key: str, folder: Path, value: Any) -> Path:
    if not isinstance(value, str):
        raise JobError(f"{where}: {key} is a text in quotes, not {value!r}")
    path = _place(where, key, folder, value)
    wrong = why_no_file(path)
    if wrong:
        raise JobError(f"{where}: the {key} {path} {wrong}")
    return path


def _check_paths(items: list[Item], job: Path, summary: Path | None) -> None:
    """Refuses items of which one would overwrite what another or the job reads or writes."""
    read: dict[str, Item] = {}
    written: dict[str, Item] = {}
    of_job = {one_file(os.path.realpath(job)): "the job file"}
    for item in items:
        for path in files_read(item.options).values():
            read[one_file(os.path.realpath(path))] = item
    if summary is not None:
        place = one_file(os.path.realpath(summary))
        if place in of_job or place in read:
            what = of_job.get(place) or f"what {read[place].name} is made from"
            raise JobError(
                f"the summary {summary} would overwrite {what}; choose another --summary"
            )
        of_job[place] = "the summary of the job"
    for item in items:
        for path in item.places:
            place = one_file(os.path.realpath(path))
            if place in of_job:
                raise JobError(
                    f"{item.name} would overwrite {path}, which is {of_job[place]}; choose another "
                    "folder or output"
                )
            if place in read:
                raise JobError(
                    f"{item.name} would overwrite {path}, from which {read[place].name} is made; "
                    "choose another folder or output"
                )
            if place in written:
                other = written[place].name
                both = "itself twice" if other == item.name else f"{other} and {item.name}"
                raise JobError(f"{path} would be written by {both}; put {{name}} into the output")
            written[place] = item
    _check_several(items)


def _check_several(items: list[Item]) -> None:
    """Refuses items whose sheets or images could have the name of what is read or written."""
    makers = [(item, *each) for item in items for each in item.several]
    of_folder: dict[Path, list[tuple[Path, Item]]] = {}
    for item in items if makers else ():
        for path in (*item.written, *files_read(item.options).values()):
            place = Path(one_file(os.path.realpath(path)))
            of_folder.setdefault(place.parent, []).append((place, item))
    for item, of_run, name in makers:
        place = Path(one_file(os.path.realpath(name)))
        for other, owner in of_folder.get(place.parent, ()):
            if of_run(place, other):
                raise JobError(
                    f"{item.name} writes several files beside {name}, and could overwrite "
                    f"{other.name} of {owner.name}; put {{name}} into the output"
                )
