# SPDX-License-Identifier: GPL-3.0-or-later
"""What is inside of every library: for whom it is, what it exports, needs, and gives away."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

from conftest import ROOT, library_of

# The oldest systems that a release supports.
GLIBC = (2, 28)
MACOS = (11, 0)


def output(*command: str | Path) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=60).stdout


def declared() -> set[str]:
    headers = (ROOT / "native/include/meander").glob("*.h")
    header = "\n".join(path.read_text() for path in headers)
    names = set(re.findall(r"MEANDER_API [^;(]*\b(meander_[a-z_0-9]+)\(", header))
    assert len(names) > 40
    return names


def test_is_for_its_platform(platform: str) -> None:
    # From a reader that is not ours.
    expected = {
        "linux-x64": "elf64-x86-64",
        "linux-arm64": "elf64-littleaarch64",
        "windows-x64": "COFF-x86-64",
        "windows-arm64": "COFF-ARM64",
        "macos-x64": "Mach-O 64-bit x86-64",
        "macos-arm64": "Mach-O arm64",
    }[platform]
    heads = output("llvm-readobj", "--file-headers", library_of(platform))
    assert re.search(r"^Format: (.*)$", heads, re.MULTILINE)[1] == expected


def test_names_no_folder_of_the_machine_that_built_it(platform: str) -> None:
    data = library_of(platform).read_bytes()
    for folder in {str(ROOT), str(Path.home()), "/usr/include", "package-tools"}:
        if len(folder) > 1:
            assert folder.encode() not in data, folder


def test_is_small(platform: str) -> None:
    # Debug information of the compiler's runtime would be fifty times that.
    assert 500_000 < library_of(platform).stat().st_size < 3_000_000


def test_linux_exports_the_c_api_alone(linux: str) -> None:
    lines = output("nm", "-D", "--defined-only", "--format=posix", library_of(linux)).splitlines()
    assert {line.split()[0] for line in lines} == declared()


def test_linux_asks_for_nothing_newer_than_promised(linux: str) -> None:
    versions = re.findall(r"GLIBC_([0-9.]+)", output("llvm-objdump", "-T", library_of(linux)))
    assert versions
    newest = max(tuple(map(int, version.split("."))) for version in versions)
    assert newest <= GLIBC


def test_linux_needs_only_the_c_library(linux: str) -> None:
    needed = re.findall(r"NEEDED\s+(\S+)", output("llvm-objdump", "-p", library_of(linux)))
    allowed = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "ld-linux-x86-64.so.2",
               "ld-linux-aarch64.so.1"}  # fmt: skip
    assert needed and set(needed) <= allowed


def test_windows_exports_the_c_api_alone(windows: str) -> None:
    text = output("llvm-readobj", "--coff-exports", library_of(windows))
    assert set(re.findall(r"Name: (\S+)", text)) == declared()


def test_windows_needs_only_windows(windows: str) -> None:
    text = output("llvm-readobj", "--coff-imports", library_of(windows))
    needed = {name.lower() for name in re.findall(r"Name: (\S+\.dll)", text, re.IGNORECASE)}
    others = {name for name in needed if not name.startswith("api-ms-win-crt-")}
    assert needed and others <= {"kernel32.dll", "ntdll.dll", "advapi32.dll", "ucrtbase.dll"}


def test_macos_exports_the_c_api_alone(macos: str) -> None:
    text = output("llvm-objdump", "--macho", "--exports-trie", library_of(macos))
    names = set(re.findall(r"^0x[0-9A-F]+ +_(\w+)", text, re.MULTILINE))
    # Zig's linker takes no list of exports: its own two words stay, and operators new and delete,
    # by their C++ names, which the system joins with those that it has.
    own = {"__dso_handle", "_mh_dylib_header"}
    operators = {name for name in names if re.match(r"_Z(n[aw]|d[al])", name)}
    assert names - operators - own == declared()


def test_macos_is_called_by_its_name_alone(macos: str) -> None:
    headers = output("llvm-objdump", "--macho", "--private-headers", library_of(macos))
    assert re.search(r"cmd LC_ID_DYLIB\n.*\n\s+name (\S+)", headers)[1] == (
        f"@rpath/{library_of(macos).name}"
    )


def test_macos_says_the_oldest_system(macos: str) -> None:
    headers = output("llvm-objdump", "--macho", "--private-headers", library_of(macos))
    assert re.search(r"minos (\d+)\.(\d+)", headers).groups() == tuple(map(str, MACOS))


def test_macos_needs_only_the_system(macos: str) -> None:
    headers = output("llvm-objdump", "--macho", "--private-headers", library_of(macos))
    loaded = re.findall(r"cmd LC_LOAD_DYLIB\n.*\n\s+name (\S+)", headers)
    assert loaded == ["/usr/lib/libSystem.B.dylib"]


def test_macos_on_arm_is_signed_ad_hoc(macos: str) -> None:
    # Apple's processors load nothing without a signature.
    headers = output("llvm-objdump", "--macho", "--private-headers", library_of(macos))
    if macos == "macos-arm64":
        at = re.search(r"cmd LC_CODE_SIGNATURE\n.*\n\s+dataoff (\d+)\n\s+datasize (\d+)", headers)
        data = library_of(macos).read_bytes()[int(at[1]) : int(at[1]) + int(at[2])]
        assert data[:4] == b"\xfa\xde\x0c\xc0"  # a signature with one part or more
        assert b"\xfa\xde\x0c\x02" in data  # the code directory: the hashes of the pages
