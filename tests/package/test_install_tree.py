# SPDX-License-Identifier: GPL-3.0-or-later
"""What `cmake --install` leaves, moved elsewhere: C programs are built from it in the two ways."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
README = ROOT / "README.md"


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The installed tree, no longer where it was installed."""
    folder = tmp_path_factory.mktemp("tree")
    build = ["cmake", "--build", ROOT / "build", "--target", "meander_installed"]
    subprocess.run(build, check=True, capture_output=True, timeout=300)
    first = folder / "first"
    install = ["cmake", "--install", ROOT / "build", "--prefix", first]
    subprocess.run(install, check=True, capture_output=True, timeout=60)
    moved = folder / "elsewhere" / "prefix"
    moved.parent.mkdir()
    shutil.move(first, moved)
    return moved


@pytest.fixture
def client(tmp_path: Path) -> Path:
    """A folder with the program of the README."""
    text = README.read_text(encoding="utf-8")
    source = re.search(r"<!-- file: build/example/fill\.c -->\n```c\n(.*?)```", text, re.DOTALL)
    (tmp_path / "fill.c").write_text(source[1])
    return tmp_path


def run(*command: object, **variables: str) -> subprocess.CompletedProcess:
    environment = {"PATH": os.environ["PATH"], "LANG": "C.UTF-8", **variables}
    return subprocess.run(
        [str(word) for word in command], env=environment, capture_output=True, text=True,
        timeout=120,
    )  # fmt: skip


def assert_works(program: Path, **variables: str) -> None:
    done = run(program, **variables)
    assert done.returncode == 0, done.stderr
    assert re.fullmatch(r"\d+ iterations, \d+ nodes, length [\d.]+\n", done.stdout)


def version() -> str:
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"project\(Meander VERSION ([0-9.]+)", text)[1]


def test_nothing_in_it_knows_where_it_was_made(tree: Path) -> None:
    files = [path for path in tree.rglob("*") if path.is_file()]
    assert {path.suffix for path in files} >= {".h", ".pc", ".cmake"}
    for path in files:
        if path.suffix in (".pc", ".cmake", ".h"):
            text = path.read_text()
            assert str(ROOT) not in text and str(tree.parents[1]) not in text, path


def test_the_library_has_the_names_that_programs_keep(tree: Path) -> None:
    header = (tree / "include/meander/meander.h").read_text()
    abi = re.search(r"#define MEANDER_ABI_VERSION (\d+)", header)[1]
    library = tree / "lib/libmeander.so"
    assert library.resolve().name == f"libmeander.so.{version()}"
    assert (tree / f"lib/libmeander.so.{abi}").resolve() == library.resolve()
    found = run("readelf", "-d", library)
    assert f"soname: [libmeander.so.{abi}]" in found.stdout


def write_project(folder: Path, wanted: str) -> None:
    (folder / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.22)\nproject(client LANGUAGES C)\n"
        f"find_package(Meander {wanted} REQUIRED)\nadd_executable(fill fill.c)\n"
        "target_link_libraries(fill PRIVATE Meander::meander)\n"
    )


def configure(folder: Path, tree: Path) -> subprocess.CompletedProcess:
    return run("cmake", "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={tree}")


def test_a_client_by_cmake(tree: Path, client: Path) -> None:
    write_project(client, version())
    configured = configure(client, tree)
    assert configured.returncode == 0, configured.stdout + configured.stderr
    built = run("cmake", "--build", client / "build")
    assert built.returncode == 0, built.stdout + built.stderr
    assert_works(client / "build/fill")


def test_another_first_number_is_refused(tree: Path, client: Path) -> None:
    write_project(client, f"{int(version().split('.')[0]) + 1}.0")
    refused = configure(client, tree)
    assert refused.returncode != 0
    assert f"version: {version()}" in refused.stderr and "Meander" in refused.stderr


def test_a_client_by_pkg_config(tree: Path, client: Path) -> None:
    where = {"PKG_CONFIG_PATH": str(tree / "lib/pkgconfig")}
    assert run("pkg-config", "--modversion", "meander", **where).stdout.strip() == version()
    flags = run("pkg-config", "--cflags", "--libs", "meander", **where)
    assert flags.returncode == 0, flags.stderr
    built = run(
        "cc", "-std=c99", "-Wall", "-Werror", client / "fill.c", *flags.stdout.split(),
        "-o", client / "fill",
    )  # fmt: skip
    assert built.returncode == 0, built.stderr
    assert_works(client / "fill", LD_LIBRARY_PATH=str(tree / "lib"))
