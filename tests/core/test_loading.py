# SPDX-License-Identifier: GPL-3.0-or-later
"""The library is loaded on first use, and what does not fit is one sentence."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import PACKAGE
from meander import batch, core
from meander.binding import native_library
from sentences import assert_sentence

HAVE_COMPILER = shutil.which("gcc") is not None and sys.platform == "linux"


@pytest.fixture
def load_from(monkeypatch: pytest.MonkeyPatch):
    """Makes core load another file as if for the first time, and returns its complaint."""

    def attempt(path: Path) -> str:
        monkeypatch.setenv(core.LIBRARY_VARIABLE, str(path))
        monkeypatch.setattr(native_library, "_loaded", None)
        with pytest.raises(core.MeanderError) as caught:
            core.default_options()
        assert caught.value.status == core.STATUS_NO_LIBRARY
        assert_sentence(str(caught.value))
        assert str(path) in str(caught.value)
        return str(caught.value)

    return attempt


def compile_stub(path: Path, source: str) -> Path:
    code = path.with_suffix(".c")
    code.write_text(source, encoding="ascii")
    subprocess.run(["gcc", "-shared", "-fPIC", "-o", path, code], check=True)
    return path


def test_import_loads_nothing() -> None:
    script = (
        "import importlib.util, sys\n"
        f"spec = importlib.util.spec_from_file_location('m', {str(PACKAGE / '__init__.py')!r},"
        f" submodule_search_locations=[{str(PACKAGE)!r}])\n"
        "package = importlib.util.module_from_spec(spec)\n"
        "sys.modules['m'] = package\n"
        "spec.loader.exec_module(package)\n"
        "from m import core\n"
        "from m.binding import native_library\n"
        "assert native_library._loaded is None and 'bpy' not in sys.modules\n"
        "try:\n"
        "    core.default_options()\n"
        "except core.MeanderError as error:\n"
        "    print(error)\n"
    )
    environment = os.environ | {core.LIBRARY_VARIABLE: "/nowhere/libmeander.so"}
    done = subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True
    )
    assert "/nowhere/libmeander.so" in done.stdout
    assert done.stderr == ""


def test_missing_file(load_from, tmp_path: Path) -> None:
    assert "missing" in load_from(tmp_path / "libmeander.so")


def test_a_folder_or_a_pipe_in_its_place(load_from, tmp_path: Path) -> None:
    assert "names, is a folder; correct" in load_from(tmp_path)
    if hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / "pipe.so")
        assert "names, is no file; correct" in load_from(tmp_path / "pipe.so")


def test_no_library_at_all(load_from, tmp_path: Path) -> None:
    path = tmp_path / "libmeander.so"
    path.write_text("not a library")
    load_from(path)


@pytest.mark.skipif(not HAVE_COMPILER, reason="compiles a stub with gcc")
def test_other_abi(load_from, tmp_path: Path) -> None:
    stub = compile_stub(
        tmp_path / "libabi.so", "unsigned meander_abi_version(void) { return 4242; }\n"
    )
    assert "4242" in load_from(stub)


@pytest.mark.skipif(not HAVE_COMPILER, reason="compiles a stub with gcc")
def test_other_version(load_from, tmp_path: Path) -> None:
    stub = compile_stub(
        tmp_path / "libversion.so",
        f"unsigned meander_abi_version(void) {{ return {core.ABI_VERSION}; }}\n"
        'const char* meander_version(void) { return "99.1.2"; }\n',
    )
    complaint = load_from(stub)
    assert "99.1.2" in complaint and core.VERSION in complaint


@pytest.mark.skipif(not HAVE_COMPILER, reason="compiles a stub with gcc")
def test_other_library(load_from, tmp_path: Path) -> None:
    load_from(compile_stub(tmp_path / "libother.so", "int other(void) { return 1; }\n"))


def test_file_name_carries_the_version(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(core.LIBRARY_VARIABLE, raising=False)
    path = core.library_path()
    assert path.parents[1] == PACKAGE / "native"
    assert core.VERSION in path.name


def test_override_is_the_full_path(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(core.LIBRARY_VARIABLE, "/some/where.so")
    assert core.library_path() == Path("/some/where.so")


def test_a_bare_name_is_a_file_here(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    # The loader of the system looks for a bare name in its own folders, and would find another.
    name = "libc.so.6" if sys.platform == "linux" else "libsystem.dylib"
    (tmp_path / name).write_text("not a library")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv(core.LIBRARY_VARIABLE, name)
    monkeypatch.setattr(native_library, "_loaded", None)
    with pytest.raises(core.MeanderError) as caught:
        core.default_options()
    assert str(tmp_path / name) in str(caught.value)


def test_another_library_is_said_aloud(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.delenv(core.LIBRARY_VARIABLE, raising=False)
    assert core.library_notice() == ""
    path, report = core.library_path(), tmp_path / "report.json"
    mesh = tmp_path / "square.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
    given = ["--input", mesh, "--output", tmp_path / "out.obj", "--spacing", 0.3, "--quiet"]
    given += ["--iterations", 2, "--report", report]
    assert batch.main([str(item) for item in given]) == 0
    assert capsys.readouterr().err == ""
    monkeypatch.setenv(core.LIBRARY_VARIABLE, str(path))
    assert batch.main([str(item) for item in given]) == 0
    notice = capsys.readouterr().err.rstrip("\n")
    assert str(path) in notice and core.LIBRARY_VARIABLE in notice
    assert_sentence(notice)
    assert notice.endswith(json.loads(report.read_text())["warnings"][0])
