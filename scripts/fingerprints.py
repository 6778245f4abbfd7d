#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fingerprints of curves, to see whether a change of the code changes a single byte of a result.

    fingerprints.py > before.txt             one line a case, half a minute on one core
    fingerprints.py --compare before.txt     exit code 1, and the cases that differ

A line is ``name sha256 nodes iterations stop_reason``; a case of fields or outlines has the number
of values in place of nodes. The digest covers the polylines, nodes, guides, gaps, data of the
points, statistics and history of a run, except times. It is valid for one machine with one numpy,
which computes the meshes; it is the same for any number of threads.

Runs go through the public names of `meander.core` only, so that the script also works on a checkout
that is organised differently inside: `--package` names the add-on's folder.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from fingerprint_cases import CASES, Case, Mesh, blob, mask_of_disk, sheet, strands, tube

DEFAULT_PACKAGE = Path(__file__).resolve().parents[1] / "addon" / "meander"

# A renamed option: the first of these names that exists.
RENAMED = {"border_distance": ("border_distance", "boundary_distance")}

# In this order. Figures that come later are left out, so that old fingerprints stay comparable.
STATISTICS = (
    "stop_reason", "iterations", "nodes", "strands", "closed_strands", "crossings", "polishing",
    "guides", "empty_components", "length", "energy", "mean_step", "spacing_target",
    "spacing_p05", "spacing_median", "spacing_p95",
)  # fmt: skip
HISTORY = ("iteration", "nodes", "length", "mean_step", "energy")
PREPARED = (
    "vertices", "faces", "components", "boundary_loops", "turned_faces", "unused_vertices",
    "merged_vertices", "dropped_faces", "split_vertices", "cut_edges", "masked_faces",
    "clipped_faces", "area", "diagonal",
)  # fmt: skip


class Digest:
    """A hash of arrays and numbers, whatever width their integers have."""

    def __init__(self) -> None:
        self._hash = hashlib.sha256()

    def add(self, *values: Any) -> None:
        for value in values:
            array = np.asarray(value)
            dtype = "<f8" if array.dtype.kind == "f" else "<i8"
            self._hash.update(repr(array.shape).encode())
            self._hash.update(np.ascontiguousarray(array, dtype=dtype).tobytes())

    def add_figures(self, figures: dict[str, Any], names: tuple[str, ...]) -> None:
        for name in names:
            value = figures[name]
            self._hash.update(f"{name}={value}".encode() if isinstance(value, str) else b"")
            if not isinstance(value, str):
                self.add(value)

    def text(self) -> str:
        return self._hash.hexdigest()


@dataclass(frozen=True)
class Row:
    """What is printed for a case."""

    name: str
    digest: str
    count: int
    iterations: int
    reason: str

    def __str__(self) -> str:
        return f"{self.name} {self.digest} {self.count} {self.iterations} {self.reason}"


def flow_options(core: ModuleType, case: Case, threads: int) -> Any:
    """The options of a case; raises AttributeError for one that the package does not have."""
    options = core.default_options(case.preset)
    options.radius = case.radius
    options.threads = threads
    enums = {
        "medial_axis": core.MedialAxis,
        "boundary_rule": core.BoundaryRule,
        "stop_rule": core.StopRule,
    }
    for key, value in case.options.items():
        names = [name for name in RENAMED.get(key, (key,)) if hasattr(options, name)]
        if not names:
            raise AttributeError(f"there is no option {key!r}; name its successor in RENAMED")
        setattr(options, names[0], enums[key][value] if key in enums else value)
    return options


def prepared_surface(core: ModuleType, case: Case, mesh: Mesh, threads: int) -> Any:
    preparation = None
    if case.preparation is not None:
        preparation = core.SurfaceOptions(**case.preparation(mesh))
    return core.Surface(*mesh, preparation, threads)


def add_curve(digest: Digest, flow: Any) -> None:
    """The state of a flow."""
    digest.add(*flow.polylines(), *flow.nodes(), flow.guides())
    digest.add(*flow.point_data())
    gaps = flow.gaps()
    digest.add(gaps.positions, gaps.radii, gaps.sizes, gaps.faces)
    digest.add_figures(flow.statistics(), STATISTICS)
    for record in flow.history():
        digest.add_figures(record, HISTORY)


def run_case(core: ModuleType, name: str, threads: int) -> Row:
    case, digest = CASES[name], Digest()
    mesh = case.mesh()
    with prepared_surface(core, case, mesh, threads) as surface:
        digest.add_figures(surface.statistics(), PREPARED)
        seed = None if case.seed is None else core.Seed(**case.seed())
        if case.outline:
            seed, skipped = surface.outlines(case.outline * case.radius, 2 * case.radius)
            digest.add(skipped)
        density = None if case.density is None else case.density(mesh[0])
        directions = None if case.directions is None else case.directions(surface, mesh[0])
        flow = core.Flow(surface, flow_options(core, case, threads), seed, density)
    with flow:
        if directions is not None:
            flow.set_directions(directions, case.kind)
        reason = flow.run()
        add_curve(digest, flow)
        for move in case.motion:
            flow.set_vertices(move(mesh[0]))
            digest.add(*flow.polylines())
            for _ in range(3):
                flow.step()
            add_curve(digest, flow)
        figures = flow.statistics()
    return Row(name, digest.text(), figures["nodes"], figures["iterations"], reason)


def field_rows(core: ModuleType, threads: int) -> dict[str, Callable[[], Row]]:
    """Cases without a flow: curvature, directions, outlines."""

    def row(name: str, mesh: Mesh, values_of: Callable[[Any], tuple[Any, ...]], **options) -> Row:
        digest = Digest()
        with core.Surface(*mesh, core.SurfaceOptions(**options), threads) as surface:
            values = values_of(surface)
        digest.add(*values)
        return Row(name, digest.text(), sum(np.size(value) for value in values), 0, "-")

    def curvature(smoothing: float) -> Callable[[Any], tuple[Any, ...]]:
        return lambda surface: tuple(surface.curvature(k, smoothing) for k in core.CURVATURES)

    def directions(smoothing: float) -> Callable[[Any], tuple[Any, ...]]:
        return lambda surface: tuple(surface.directions(k, smoothing) for k in core.DIRECTIONS)

    def extended(surface: Any) -> tuple[Any, ...]:
        seed = strands()
        return (surface.extended_directions(seed["points"], seed["offsets"]),)

    def outlines(distance: float, spacing: float) -> Callable[[Any], tuple[Any, ...]]:
        def of(surface: Any) -> tuple[Any, ...]:
            seed, skipped = surface.outlines(distance, spacing)
            return seed.points, seed.offsets, seed.closed, seed.guides, skipped

        return of

    rough, holes = sheet(24, 0.3), mask_of_disk(sheet(24, 0.3))
    return {
        "field_curvature": lambda: row("field_curvature", blob(24, 36), curvature(0.0)),
        "field_curvature_mean": lambda: row("field_curvature_mean", blob(24, 36), curvature(0.3)),
        "field_curvature_open": lambda: row("field_curvature_open", tube(), curvature(0.2)),
        "field_directions": lambda: row("field_directions", blob(24, 36), directions(0.2)),
        "field_directions_open": lambda: row("field_directions_open", tube(), directions(0.0)),
        "field_extended": lambda: row("field_extended", rough, extended),
        "outlines_sheet": lambda: row("outlines_sheet", rough, outlines(0.06, 0.05)),
        "outlines_holes": lambda: row("outlines_holes", rough, outlines(0.02, 0.04), **holes),
        "outlines_tube": lambda: row("outlines_tube", tube(), outlines(0.3, 0.2)),
    }


def rows(core: ModuleType, wanted: str, threads: int) -> Iterator[Row]:
    """The cases whose names contain `wanted`, in their order."""
    others = field_rows(core, threads)
    names = [name for name in (*CASES, *others) if wanted in name]
    if not names:
        sys.exit(f"fingerprints.py: no case has {wanted!r} in its name")
    for name in names:
        yield run_case(core, name, threads) if name in CASES else others[name]()


def load_core(package: Path) -> ModuleType:
    """`meander.core` of an add-on's folder, no matter what is installed."""
    if not (package / "__init__.py").is_file():
        sys.exit(f"fingerprints.py: {package} is not the folder of the add-on; see --package")
    spec = importlib.util.spec_from_file_location(
        "meander", package / "__init__.py", submodule_search_locations=[str(package)]
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules["meander"] = module
    spec.loader.exec_module(module)
    return importlib.import_module("meander.core")


def differing(found: dict[str, str], saved: Path, wanted: str) -> list[str]:
    """The names of cases that are not as saved, in the order of the file, then of the run."""
    lines_of_file = saved.read_text().splitlines()
    before = {line.split()[0]: line for line in lines_of_file if line.strip()}
    names = [name for name in before if wanted in name]
    names += [name for name in found if name not in before]
    return [name for name in names if found.get(name) != before.get(name)]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--package", type=Path, default=DEFAULT_PACKAGE, help="the add-on's folder")
    parser.add_argument("--compare", type=Path, metavar="FILE", help="a saved output")
    parser.add_argument("--only", default="", metavar="SUBSTRING", help="of the names of cases")
    parser.add_argument("--threads", type=int, default=1, help="of a run; 0: all of the machine")
    arguments = parser.parse_args()
    core = load_core(arguments.package.resolve())
    found: dict[str, str] = {}
    for row in rows(core, arguments.only, arguments.threads):
        found[row.name] = str(row)
        print(row, flush=True)
    if arguments.compare is None:
        return 0
    names = differing(found, arguments.compare, arguments.only)
    for name in names:
        print(f"fingerprints.py: {name} differs", file=sys.stderr)
    return 1 if names else 0


if __name__ == "__main__":
    sys.exit(main())
