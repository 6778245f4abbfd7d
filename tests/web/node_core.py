# SPDX-License-Identifier: GPL-3.0-or-later
"""As much of `meander.core` as scripts/fingerprints.py uses, by build/web/meander.mjs in Node."""

from __future__ import annotations

import base64
import json
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

_SCRIPT = Path(__file__).with_name("serve.mjs")
_TYPES = {"Float64Array": np.float64, "Uint32Array": np.uint32, "Uint8Array": np.uint8}


def _camel(name: str) -> str:
    return re.sub(r"_(\w)", lambda match: match[1].upper(), name)


def _snake(name: str) -> str:
    return re.sub(r"[A-Z]", lambda match: "_" + match[0].lower(), name)


def _snakes(figures: dict[str, Any]) -> dict[str, Any]:
    return {_snake(name): value for name, value in figures.items()}


class _Names:
    """An enumeration, whose members are strings there."""

    def __getitem__(self, name: str) -> str:
        return name.lower()


@dataclass
class Seed:
    points: Any
    offsets: Any
    closed: Any
    fixed: Any = None
    guides: Any = None
    loops: bool = False


class SurfaceOptions:
    def __init__(self, **options: Any) -> None:
        self.options = options


class NodeCore:
    """The module: `core.Surface(...)` and so on."""

    MedialAxis = BoundaryRule = StopRule = _Names()
    Seed, SurfaceOptions = Seed, SurfaceOptions

    def __init__(self) -> None:
        self._process = subprocess.Popen(
            ["node", str(_SCRIPT)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self.CURVATURES, self.DIRECTIONS = self.ask("CURVATURES"), self.ask("DIRECTIONS")

    def close(self) -> None:
        self._process.communicate()

    def ask(self, call: str, *args: Any, **more: Any) -> Any:
        message = json.dumps({"call": call, "args": args, **more}, default=_as_json)
        self._process.stdin.write(message + "\n")
        self._process.stdin.flush()
        answer = json.loads(self._process.stdout.readline(), object_hook=_array)
        if isinstance(answer, dict) and "problem" in answer:
            raise RuntimeError(answer["problem"])
        return answer

    def default_options(self, preset: str) -> SimpleNamespace:
        return SimpleNamespace(**_snakes(self.ask("defaultOptions", preset)))

    def Surface(self, vertices: Any, faces: Any, options: Any = None, threads: int = 1) -> Any:
        given = {} if options is None else options.options
        return _Surface(self, vertices, faces, {_camel(key): given[key] for key in given})

    def Flow(self, surface: Any, options: Any, seed: Any = None, density: Any = None) -> Any:
        given = {_camel(key): value for key, value in vars(options).items()}
        start = None if seed is None else vars(seed)
        return _Flow(self, surface, given, start, density)


def _as_json(value: Any) -> Any:
    if isinstance(value, _Object):
        return value.place
    if isinstance(value, np.generic):
        return value.item()
    kind = "f8" if value.dtype.kind == "f" else "u4" if value.dtype.itemsize > 1 else "u1"
    name = {"f8": "Float64Array", "u4": "Uint32Array", "u1": "Uint8Array"}[kind]
    data = np.ascontiguousarray(value, dtype="<" + kind).tobytes()
    return {"array": name, "base64": base64.b64encode(data).decode()}


def _array(value: dict[str, Any]) -> Any:
    if "array" not in value:
        return value
    return np.frombuffer(base64.b64decode(value["base64"]), _TYPES[value["array"]])


class _Object:
    def __init__(self, core: NodeCore, name: str, *args: Any) -> None:
        self._core = core
        self.place = core.ask("", *args, make=name)

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: object) -> None:
        self.ask("close")

    def ask(self, call: str, *args: Any) -> Any:
        return self._core.ask(call, *args, object=self.place)


class _Surface(_Object):
    def __init__(self, core: NodeCore, *args: Any) -> None:
        super().__init__(core, "Surface", *args)

    def statistics(self) -> dict[str, Any]:
        return _snakes(self.ask("statistics"))

    def curvature(self, kind: str, smoothing: float = 0.0) -> Any:
        return self.ask("curvature", kind, smoothing)

    def directions(self, kind: str, smoothing: float = 0.0) -> Any:
        return self.ask("directions", kind, smoothing).reshape(-1, 3)

    def extended_directions(self, points: Any, offsets: Any) -> Any:
        return self.ask("extendedDirections", points, offsets).reshape(-1, 3)

    def outlines(self, distance: float, spacing: float) -> Any:
        found = self.ask("outlines", distance, spacing)
        seed = Seed(**found["seed"])
        seed.points = seed.points.reshape(-1, 3)
        return seed, found["skipped"]


class _Flow(_Object):
    def __init__(self, core: NodeCore, *args: Any) -> None:
        super().__init__(core, "Flow", *args)

    def run(self) -> str:
        return self.ask("run")

    def step(self) -> str:
        return self.ask("step")

    def set_directions(self, directions: Any, kind: str) -> None:
        self.ask("setDirections", directions, kind)

    def set_vertices(self, vertices: Any) -> None:
        self.ask("setVertices", vertices)

    def polylines(self) -> tuple[Any, ...]:
        found = self.ask("polylines")
        normals = self.ask("pointData", "normals")["normals"].reshape(-1, 3)
        return found["positions"].reshape(-1, 3), normals, found["offsets"], found["closed"]

    def guides(self) -> Any:
        return self.ask("polylines")["guides"]

    def nodes(self) -> tuple[Any, ...]:
        found = self.ask("nodes")
        weights, radii = found["barycentrics"].reshape(-1, 3), found["radii"].reshape(-1, 2)
        return found["faces"], weights, radii, found["fixed"]

    def point_data(self) -> tuple[Any, ...]:
        found = self.ask("pointData")
        return (
            found["arcLengths"],
            found["normals"].reshape(-1, 3),
            found["tangents"].reshape(-1, 3),
            found["radii"].reshape(-1, 2),
            found["faces"],
            found["barycentrics"].reshape(-1, 3),
        )

    def gaps(self) -> SimpleNamespace:
        found = self.ask("gaps")
        return SimpleNamespace(**{**found, "positions": found["positions"].reshape(-1, 3)})

    def statistics(self) -> dict[str, Any]:
        return _snakes(self.ask("statistics"))

    def history(self) -> list[dict[str, Any]]:
        return [_snakes(record) for record in self.ask("history")]
