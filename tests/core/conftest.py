# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the add-on importable as `meander` without Blender, and grows the curves tests share.

The library is addon/meander/native/, where the build puts it, or MEANDER_LIBRARY.
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
PACKAGE = REPOSITORY / "addon" / "meander"


def _import_package() -> None:
    # By location: a folder on sys.path could shadow it, or be shadowed by an installed add-on.
    spec = importlib.util.spec_from_file_location(
        "meander", PACKAGE / "__init__.py", submodule_search_locations=[str(PACKAGE)]
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules["meander"] = module
    spec.loader.exec_module(module)


def of_python_package(name: str) -> ModuleType:
    """A module of the Python package, beside the modules of the add-on."""
    for each in ("files", "pictures"):
        if f"meander.{each}" not in sys.modules:
            place = REPOSITORY / "python" / "meander" / f"{each}.py"
            spec = importlib.util.spec_from_file_location(f"meander.{each}", place)
            module = importlib.util.module_from_spec(spec)
            sys.modules[spec.name] = module
            setattr(sys.modules["meander"], each, module)
            spec.loader.exec_module(module)
    return sys.modules[f"meander.{name}"]


_import_package()
sys.path.append(str(REPOSITORY / "tests"))

import geometry  # noqa: E402  (the package must be importable before tests are)
from meander import core  # noqa: E402
from processor_time import pytest_runtest_protocol  # noqa: E402, F401

# For what is said where there is no Blender; in the Python of a bpy there is one.
without_blender = pytest.mark.skipif(
    importlib.util.find_spec("bpy") is not None, reason="this Python has Blender"
)


@dataclass(frozen=True)
class Grown:
    """A finished run: what went in and what came out."""

    mesh: geometry.Mesh
    radius: float
    reason: str
    curve: core.Polylines
    nodes: core.Nodes
    surface: dict
    statistics: dict
    history: list


# Name -> mesh and radius, chosen for a thousand or two nodes each: enough to fill, soon done.
MODELS: dict[str, tuple[Callable[[], geometry.Mesh], float]] = {
    "icosphere": (lambda: geometry.icosphere(3), 0.12),
    "torus": (lambda: geometry.torus(40, 20), 0.1),
    "grid": (lambda: geometry.grid(16), 0.03),
    "cube": (geometry.cube, 0.15),
    "two_spheres": (geometry.two_spheres, 0.15),
}


def grow(mesh: geometry.Mesh, radius: float, seed: core.Seed | None = None, **changes) -> Grown:
    """Runs a flow to its end; `changes` are options, and density."""
    density = changes.pop("density", None)
    options = core.default_options(changes.pop("preset", "even"))
    options.radius = radius
    for name, value in changes.items():
        setattr(options, name, value)
    with (
        core.Surface(mesh.vertices, mesh.faces) as surface,
        core.Flow(surface, options, seed, density) as flow,
    ):
        reason = flow.run()
        return Grown(
            mesh,
            radius,
            reason,
            flow.polylines(),
            flow.nodes(),
            surface.statistics(),
            flow.statistics(),
            flow.history(),
        )


def polylines(*lines: tuple[np.ndarray, bool]) -> core.Polylines:
    """A curve of lines, closed or not, whose normals point up."""
    points = np.vstack([line for line, _closed in lines])
    return core.Polylines(
        points,
        np.tile([0.0, 0.0, 1.0], (len(points), 1)),
        np.cumsum([0] + [len(line) for line, _closed in lines]).astype(np.uint32),
        np.array([closed for _line, closed in lines], dtype=np.uint8),
    )


@cache
def _model(name: str) -> Grown:
    make, radius = MODELS[name]
    return grow(make(), radius)


@pytest.fixture(params=sorted(MODELS))
def grown(request: pytest.FixtureRequest) -> Grown:
    """Each of the models, filled by default; computed once per session."""
    return _model(request.param)


@pytest.fixture
def model() -> Callable[[str], Grown]:
    """A filled model by name; computed once per session."""
    return _model
