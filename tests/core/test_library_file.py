# SPDX-License-Identifier: GPL-3.0-or-later
"""Each platform has its library; one that is missing, foreign, damaged or too old is one sentence.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import struct
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import PACKAGE
from meander import core
from meander.binding import library_file, native_library
from sentences import assert_sentence

TAGS = ("linux-x64", "linux-arm64", "macos-x64", "macos-arm64", "windows-x64", "windows-arm64")


def elf(machine: int) -> bytes:
    return b"\x7fELF\x02\x01\x01" + bytes(9) + struct.pack("<HH", 3, machine) + bytes(200)


def pe(machine: int) -> bytes:
    head = bytearray(b"MZ" + bytes(300))
    struct.pack_into("<I", head, 60, 128)
    struct.pack_into("<4sH", head, 128, b"PE\0\0", machine)
    return bytes(head)


def mach_o(machine: int) -> bytes:
    return struct.pack("<IIII", 0xFEEDFACF, machine, 0, 6) + bytes(200)


HEADS = {
    "linux-x64": elf(62),
    "linux-arm64": elf(183),
    "windows-x64": pe(0x8664),
    "windows-arm64": pe(0xAA64),
    "macos-x64": mach_o(0x01000007),
    "macos-arm64": mach_o(0x0100000C),
}


@pytest.fixture
def package(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """A package without libraries, from which core loads as if for the first time."""
    monkeypatch.delenv(core.LIBRARY_VARIABLE, raising=False)
    monkeypatch.setattr(native_library, "_NATIVE", tmp_path / "native")
    monkeypatch.setattr(native_library, "_loaded", None)
    (tmp_path / "native").mkdir()
    return tmp_path / "native"


def put(package: Path, tag: str, contents: bytes) -> Path:
    path = package / library_file.library_file(tag)
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(contents)
    return path


def complaint() -> str:
    with pytest.raises(core.MeanderError) as caught:
        core.default_options()
    assert caught.value.status == core.STATUS_NO_LIBRARY
    assert_sentence(str(caught.value))
    return str(caught.value)


@pytest.mark.parametrize(
    ("system", "machine", "tag"),
    [
        ("linux", "x86_64", "linux-x64"),
        ("linux", "aarch64", "linux-arm64"),
        ("darwin", "arm64", "macos-arm64"),
        ("darwin", "x86_64", "macos-x64"),
        ("win32", "AMD64", "windows-x64"),
        ("win32", "ARM64", "windows-arm64"),
        ("freebsd14", "amd64", "freebsd14-x64"),
        ("linux", "riscv64", "linux-riscv64"),
    ],
)
def test_platforms_are_called_as_in_manifests(system: str, machine: str, tag: str) -> None:
    assert library_file.platform_tag(system, machine) == tag


def test_on_windows_the_python_decides_not_the_processor(monkeypatch: pytest.MonkeyPatch) -> None:
    # A Blender for x86-64 on an ARM computer.
    monkeypatch.setattr(library_file.sys, "platform", "win32")
    monkeypatch.setattr(library_file.platform, "machine", lambda: "ARM64")
    monkeypatch.setattr(library_file.sysconfig, "get_platform", lambda: "win-amd64")
    assert library_file.platform_tag() == "windows-x64"


def test_every_platform_has_a_file_of_its_own() -> None:
    files = [library_file.library_file(tag) for tag in TAGS]
    assert len(set(files)) == len(TAGS)
    assert {path.suffix for path in files} == {".so", ".dll", ".dylib"}
    assert all(core.VERSION in path.name for path in files)


@pytest.mark.parametrize("tag", TAGS)
def test_reads_what_a_file_is_for(tag: str, tmp_path: Path) -> None:
    path = tmp_path / "library"
    path.write_bytes(HEADS[tag])
    assert library_file.built_for(path) == tag


@pytest.mark.parametrize("head", [b"", b"MZ", b"\x7fELF", b"MZ" + b"\xff" * 200, b"text" * 50])
def test_what_is_no_library_is_for_nothing(head: bytes, tmp_path: Path) -> None:
    path = tmp_path / "library"
    path.write_bytes(head)
    assert library_file.built_for(path) is None


def test_names_a_processor_that_it_does_not_know(tmp_path: Path) -> None:
    path = tmp_path / "library"
    path.write_bytes(elf(243))
    assert library_file.built_for(path) == "linux-0xf3"


def test_without_any_library(package: Path) -> None:
    text = complaint()
    tag = library_file.platform_tag()
    assert tag in text and "there is none" in text
    assert f"meander-{core.VERSION}-{tag.replace('-', '_')}.zip" in text


def test_with_those_of_other_platforms_only(package: Path) -> None:
    others = [tag for tag in TAGS if tag != library_file.platform_tag()]
    for tag in others:
        put(package, tag, HEADS[tag])
    text = complaint()
    assert ", ".join(sorted(others)) in text and "missing" in text


def test_an_older_version_is_not_taken_for_this_one(package: Path) -> None:
    path = put(package, library_file.platform_tag(), b"")
    path.rename(path.with_name(path.name.replace(core.VERSION, "0.0.1")))
    assert "missing" in complaint()


@pytest.mark.parametrize("tag", TAGS)
def test_a_foreign_library_in_our_place(tag: str, package: Path) -> None:
    ours = library_file.platform_tag()
    if tag == ours:
        pytest.skip("this is the platform of this machine")
    path = put(package, ours, HEADS[tag])
    text = complaint()
    assert tag in text and ours in text and str(path) in text and ".zip" in text


def test_a_platform_without_a_release(
    package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(native_library, "platform_tag", lambda: "linux-riscv64")
    text = complaint()
    assert "linux-riscv64" in text and "sources" in text


def test_a_library_that_asks_for_a_newer_system(package: Path) -> None:
    # An ELF head and nothing behind it: what the loader says is in the sentence, with the system.
    tag = library_file.platform_tag()
    put(package, tag, HEADS[tag])
    text = complaint()
    assert tag in text and library_file.needed(tag) in text
    assert library_file.system_version() in text


@pytest.mark.skipif(shutil.which("gcc") is None, reason="compiles a library with gcc")
def test_a_library_for_a_newer_glibc(package: Path, tmp_path: Path) -> None:
    if not library_file.platform_tag().startswith("linux"):
        pytest.skip("of glibc")
    # A library that needs GLIBC_2.99 of a stand-in for the C library.
    stand_in, versions = tmp_path / "libnewer.so", tmp_path / "versions"
    versions.write_text("GLIBC_2.99 { global: newer; };")
    (tmp_path / "newer.c").write_text("int newer(void) { return 1; }")
    (tmp_path / "ours.c").write_text("int newer(void); int ours(void) { return newer(); }")
    subprocess.run(["gcc", "-shared", "-fPIC", "-Wl,-soname,libc.so.6", "-o", stand_in,
                    f"-Wl,--version-script={versions}", tmp_path / "newer.c"], check=True)
    path = package / library_file.library_file(library_file.platform_tag())
    path.parent.mkdir()
    subprocess.run(["gcc", "-shared", "-fPIC", "-nostdlib", "-o", path, tmp_path / "ours.c",
                    stand_in], check=True)
    text = complaint()
    assert "GLIBC_2.99" in text and "glibc 2.28" in text


# ------------------------------------------------------------------------------------------------
# A library that is not whole


# What may have become of a file on its way; the record is of the whole one.
DAMAGES: dict[str, Callable[[bytes], bytes]] = {
    "nothing left": lambda data: b"",
    "a few bytes": lambda data: data[:100],
    "5 kB": lambda data: data[:5000],
    "100 kB": lambda data: data[:100_000],
    "1 MB": lambda data: data[:1_000_000],
    "all but a page": lambda data: data[:-4096],
    "all but a byte": lambda data: data[:-1],
    "a bit that has turned": lambda data: data[:700_000] + b"\xff" + data[700_001:],
    "zeros from a place on": lambda data: data[:800_000] + bytes(len(data) - 800_000),
    "line ends made Unix's": lambda data: data.replace(b"\r\n", b"\n") + b"\n",
    "more behind it": lambda data: data + b"\0" * 10,
}


def loaded_elsewhere(library: Path) -> subprocess.CompletedProcess[str]:
    """What a process of its own says that loads this file: a crash would be its end."""
    script = (
        "from meander import core\n"
        "try:\n"
        "    core.default_options('even')\n"
        "except core.MeanderError as error:\n"
        "    print(error)\n"
    )
    return subprocess.run(
        [sys.executable, "-c", script],
        env=os.environ | {core.LIBRARY_VARIABLE: str(library), "PYTHONPATH": str(PACKAGE.parent)},
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip


@pytest.fixture
def built(monkeypatch: pytest.MonkeyPatch) -> bytes:
    monkeypatch.delenv(core.LIBRARY_VARIABLE, raising=False)
    return core.library_path().read_bytes()


def with_record(path: Path, contents: bytes, packed: bytes) -> Path:
    path.write_bytes(contents)
    digest = hashlib.sha256(packed).hexdigest()
    library_file.record_file(path).write_text(f"{len(packed)} {digest}\n")
    return path


@pytest.mark.parametrize("name", DAMAGES)
def test_what_is_not_as_it_was_packed_is_one_sentence(
    name: str, built: bytes, tmp_path: Path
) -> None:
    path = with_record(tmp_path / "libmeander.so", DAMAGES[name](built), built)
    done = loaded_elsewhere(path)
    assert (done.returncode, done.stderr) == (0, "")
    assert_sentence(done.stdout.strip())
    assert str(path) in done.stdout and "install" in done.stdout


@pytest.mark.skipif(sys.platform != "linux", reason="of files that Linux maps")
@pytest.mark.parametrize("size", [100, 5000, 100_000, 1_000_000, -100_000])
def test_without_a_record_a_library_that_is_cut_off_is_one_sentence(
    size: int, built: bytes, tmp_path: Path
) -> None:
    path = tmp_path / "libmeander.so"
    path.write_bytes(built[:size])
    done = loaded_elsewhere(path)
    assert (done.returncode, done.stderr) == (0, "")
    assert_sentence(done.stdout.strip())
    assert "cut off" in done.stdout


def test_a_library_loads_with_its_record_and_as_it_was_built(built: bytes, tmp_path: Path) -> None:
    path = with_record(tmp_path / "libmeander.so", built, built)
    assert (loaded_elsewhere(path).stdout, library_file.damage(path)) == ("", "")
    library_file.record_file(path).unlink()
    assert (loaded_elsewhere(path).stdout, library_file.damage(path)) == ("", "")


@pytest.mark.parametrize("record", ["", "12", "many x", "1738904 abc def"])
def test_a_record_that_is_damaged_is_one_sentence(
    record: str, built: bytes, package: Path
) -> None:
    path = put(package, library_file.platform_tag(), built)
    library_file.record_file(path).write_text(record)
    assert library_file.record_file(path).name in complaint()
