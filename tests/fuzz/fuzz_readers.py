#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every reader of files under Atheris, which is libFuzzer for Python.

    build/fuzz-tools/bin/python tests/fuzz/fuzz_readers.py -max_len=600 FOLDER

goes on until something is found; libFuzzer's own flags apply. Any bytes have to end in a mesh, a
curve or a job, or in the project's own error with one short sentence that can be printed, within a
second of the processor. An input's first byte says which reader is meant; tests/fuzz/readers has
one of each kind to begin with, and tests/core/test_fuzzed_files.py reads them all without Atheris.

Atheris (Apache 2.0) is on the Python index: `python3 -m venv --system-site-packages
build/fuzz-tools`, then `build/fuzz-tools/bin/pip install atheris`.
"""

from __future__ import annotations

import importlib.util
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SECONDS = 1.0
LONGEST_SENTENCE = 600


def import_package() -> None:
    """The add-on as `meander`, from its folder, unless it is there already."""
    if "meander" in sys.modules:
        return
    package = ROOT / "addon" / "meander"
    spec = importlib.util.spec_from_file_location(
        "meander", package / "__init__.py", submodule_search_locations=[str(package)]
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules["meander"] = module
    spec.loader.exec_module(module)


def readers() -> list[tuple[str, Callable[[Path], object], type[Exception]]]:
    """Of each: the suffix of its files, what reads them, and what it raises."""
    from meander.jobs import job_file
    from meander.model.files import meshes, obj, whole

    def read_mesh(path: Path) -> None:
        vertices, faces = meshes.read_mesh(path)
        assert vertices.dtype == "float64" and vertices.ndim == 2 and vertices.shape[1] == 3
        assert faces.dtype == "uint32" and faces.ndim == 2 and faces.shape[1] == 3
        assert len(faces)

    def read_curve(path: Path) -> None:
        seed = obj.read_obj_curve(path)
        assert len(seed.points) == seed.offsets[-1] and seed.offsets[0] == 0
        assert len(seed.closed) == len(seed.offsets) - 1
        assert (seed.offsets[1:] - seed.offsets[:-1] >= 2).all()

    return [
        (".ply", read_mesh, whole.FileError),
        (".stl", read_mesh, whole.FileError),
        (".obj", read_mesh, whole.FileError),
        (".obj", read_curve, whole.FileError),
        (".toml", job_file.read, job_file.JobError),
    ]


def read_one(data: bytes, folder: Path) -> str:
    """Reads an input, and returns the sentence if it is refused; anything else is an exception."""
    known = readers()
    suffix, read, refusal = known[data[0] % len(known) if data else 0]
    path = folder / f"input{suffix}"
    path.write_bytes(data[1:])
    begin = time.process_time()
    sentence = ""
    try:
        read(path)
    except refusal as problem:
        sentence = str(problem)
        said = sentence.replace(str(path), "FILE")
        assert said.isprintable(), repr(said)
        assert 20 < len(said) < LONGEST_SENTENCE, said
    assert time.process_time() - begin < SECONDS, "it takes long"
    return sentence


def main() -> None:
    import atheris

    with atheris.instrument_imports(include=["meander", "tomllib"]):
        import_package()
        readers()
    with tempfile.TemporaryDirectory(dir="/dev/shm" if Path("/dev/shm").is_dir() else None) as name:
        folder = Path(name)
        atheris.Setup(sys.argv, lambda data: read_one(data, folder) and None)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
