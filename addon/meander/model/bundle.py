# SPDX-License-Identifier: GPL-3.0-or-later
"""What led to a defect of the library, in one file that can be added to a report; no bpy.

A bundle is a .npz of numpy's: the arrays of a problem, and the last good curve, under names that
begin with what they belong to, and "record", a JSON text with all that is no array. Reading one
executes nothing.
"""

from __future__ import annotations

import json
import tempfile
import zipfile
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .. import core
from .files.whole import FileError, whole_file
from .problem import Problem

SUFFIX = ".npz"
_FORMAT = 1

# What earlier bundles know by another name.
_OLD_NAMES = {
    "border_distance": "boundary_distance",
    "ripening_iterations": "hairpin_removal_iterations",
    "reach": "max_distance",
}


@dataclass(frozen=True)
class Bundle:
    """A problem, and what became of it.

    problem    as it was, with density and directions as arrays
    version    of Meander
    iteration  the last one that ended well
    sentence   what was wrong with the one after it
    curve      of that last iteration; None: there was none
    """

    problem: Problem
    version: str
    iteration: int
    sentence: str
    curve: core.Polylines | None


def is_defect(error: BaseException) -> bool:
    """Whether an error is one of the library's own, which a bundle helps to find."""
    return isinstance(error, core.MeanderError) and error.status == core.Status.INTERNAL


def bundle_of(flow: core.Flow, problem: Problem, error: BaseException) -> Bundle:
    """What is known once a run has ended with a defect. Raises core.MeanderError.

    problem   resolved, see problem.Opened
    """
    iterations = len(flow.history())
    return Bundle(problem, core.VERSION, iterations, str(error), flow.polylines())


def write_bundle(path: Path, bundle: Bundle) -> None:
    """Writes a bundle, whole or not at all. Raises FileError."""
    problem = bundle.problem
    arrays: dict[str, np.ndarray] = {}
    record = {
        "format": _FORMAT,
        "version": bundle.version,
        "iteration": bundle.iteration,
        "sentence": bundle.sentence,
        "alignment": problem.alignment,
        "outline": problem.outline,
        "options": {name: _plain(value) for name, value in asdict(problem.options).items()},
    }
    arrays |= {"vertices": problem.vertices, "faces": problem.faces}
    for name in ("density", "directions"):
        if getattr(problem, name) is not None:
            arrays[name] = np.asarray(getattr(problem, name))
    for name in ("seed", "surface_options"):
        if getattr(problem, name) is not None:
            record[name] = _parted(name, vars(getattr(problem, name)), arrays)
    if bundle.curve is not None:
        _parted("curve", bundle.curve._asdict(), arrays)
    with whole_file(path) as temporary, temporary.open("wb") as file:
        np.savez_compressed(file, record=np.array(json.dumps(record)), **arrays)


def left_by(
    flow: core.Flow, problem: Problem, error: BaseException
) -> tuple[int, Path] | None:
    """Writes the bundle of a run that a defect has ended into a folder of its own. Returns the
    iteration before it and the file; None: there is nothing to write, or no room for it."""
    try:
        made = bundle_of(flow, problem, error)
        path = Path(tempfile.mkdtemp(prefix="meander-")) / f"defect{SUFFIX}"
        write_bundle(path, made)
    except (core.MeanderError, FileError, OSError):
        return None
    return made.iteration, path


def read_bundle(path: Path) -> Bundle:
    """Reads what write_bundle has written. Raises FileError."""
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files}
        record = json.loads(str(arrays["record"]))
        if record["format"] != _FORMAT:
            raise FileError(f"{path} is a bundle of another version of Meander")
        options = core.default_options(record["options"]["preset"])
        for written, value in record["options"].items():
            name = _OLD_NAMES.get(written, written)
            if name in options.tunings:  # where earlier bundles have them among the options
                options.tunings[name] = float(value)
            else:
                setattr(options, name, type(getattr(options, name))(value))
        problem = Problem(
            arrays["vertices"],
            arrays["faces"],
            options,
            density=arrays.get("density"),
            directions=arrays.get("directions"),
            alignment=record["alignment"],
            outline=record["outline"],
        )
        if "seed" in record:
            plain = {_OLD_NAMES.get(name, name): value for name, value in record["seed"].items()}
            problem.seed = core.Seed(**plain, **_of("seed", arrays))
        if "surface_options" in record:
            given = record["surface_options"] | _of("surface_options", arrays)
            problem.surface_options = core.SurfaceOptions(**given)
        curve = _of("curve", arrays)
        return Bundle(
            problem,
            record["version"],
            record["iteration"],
            record["sentence"],
            core.Polylines(**curve) if curve else None,
        )
    except (OSError, KeyError, ValueError, TypeError, AttributeError, zipfile.BadZipFile) as wrong:
        raise FileError(f"{path} is no bundle of Meander's ({wrong})") from wrong


def _parted(of: str, values: Mapping[str, Any], arrays: dict[str, np.ndarray]) -> dict[str, Any]:
    """Puts the arrays among values away, and returns the rest."""
    plain = {}
    for name, value in values.items():
        if isinstance(value, np.ndarray):
            arrays[f"{of}.{name}"] = value
        else:
            plain[name] = _plain(value)
    return plain


def _of(what: str, arrays: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The arrays that belong to something, by their own names."""
    return {
        name.removeprefix(f"{what}."): array
        for name, array in arrays.items()
        if name.startswith(f"{what}.")
    }


def _plain(value: Any) -> Any:
    """A value as JSON has it: numbers of enumerations are numbers."""
    return int(value) if isinstance(value, int) and not isinstance(value, bool) else value
