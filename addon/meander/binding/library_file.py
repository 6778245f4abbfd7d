# SPDX-License-Identifier: GPL-3.0-or-later
"""Which file is the native library of a platform, and which platform a file was built for.

A platform is called as in the manifest of a Blender extension: ``linux-x64``, ``macos-arm64``. Its
library lies in the folder of that name in ``native/``, so that one zip can hold several.
"""

from __future__ import annotations

import hashlib
import platform
import struct
import sys
import sysconfig
from pathlib import Path

from .abi import VERSION

_SYSTEMS = {"linux": "linux", "win32": "windows", "darwin": "macos"}
_MACHINES = {"x86_64": "x64", "amd64": "x64", "aarch64": "arm64", "arm64": "arm64"}
_FILES = {
    "linux": "libmeander-{}.so",
    "windows": "meander-{}.dll",
    "macos": "libmeander-{}.dylib",
}

# What the libraries of a release need; docs/platforms.md says how that was seen.
_NEEDED = {
    "linux": "glibc 2.28 or later",
    "windows": "Windows 10 or later",
    "macos": "macOS 11 or later",
}

# Only the add-on has one; the wheel is this package too.
_IS_ADDON = (Path(__file__).resolve().parents[1] / "blender_manifest.toml").is_file()

# The numbers that the formats of executables have for the processors.
_ELF_MACHINES = {0x3E: "x64", 0xB7: "arm64"}
_PE_MACHINES = {0x8664: "x64", 0xAA64: "arm64"}
_MACH_MACHINES = {0x01000007: "x64", 0x0100000C: "arm64"}


def running_machine() -> str:
    """The processor that the running Python is built for, as the system calls it.

    On Windows on ARM it may be another than the computer's: a Blender for x86-64 runs there too,
    and loads libraries for x86-64.
    """
    if sys.platform == "win32":
        return sysconfig.get_platform().rpartition("-")[2]
    return platform.machine()


def platform_tag(system: str | None = None, machine: str | None = None) -> str:
    """The platform's name; `system` is as in sys.platform, both default to the running Python's.

    Platforms without a library have one too, made of the words that they use themselves.
    """
    system = sys.platform if system is None else system
    machine = (running_machine() if machine is None else machine).lower()
    return f"{_SYSTEMS.get(system, system)}-{_MACHINES.get(machine, machine)}"


def library_file(tag: str) -> Path:
    """Where the library of a platform is, relative to the folder ``native/``."""
    system = tag.partition("-")[0]
    return Path(tag) / _FILES.get(system, _FILES["linux"]).format(VERSION)


def platforms_in(folder: Path) -> list[str]:
    """The platforms of which the folder ``native/`` has the library of this version, sorted."""
    if not folder.is_dir():
        return []
    tags = (path.name for path in folder.iterdir())
    return sorted(tag for tag in tags if (folder / library_file(tag)).is_file())


def built_for(path: Path) -> str | None:
    """The platform that a library was built for, read from its first bytes.

    None if it is no library for 64-bit processors. A processor without a name here is a number.
    Raises OSError when the file cannot be read.
    """
    with path.open("rb") as file:
        head = file.read(4096)
    if len(head) < 64:
        return None
    if head[:6] == b"\x7fELF\x02\x01":
        machine = struct.unpack_from("<H", head, 18)[0]
        return f"linux-{_ELF_MACHINES.get(machine, hex(machine))}"
    if head[:4] == b"\xcf\xfa\xed\xfe":
        machine = struct.unpack_from("<I", head, 4)[0]
        return f"macos-{_MACH_MACHINES.get(machine, hex(machine))}"
    if head[:2] == b"MZ":
        at = struct.unpack_from("<I", head, 60)[0]
        if head[at : at + 4] == b"PE\0\0" and at + 6 <= len(head):
            machine = struct.unpack_from("<H", head, at + 4)[0]
            return f"windows-{_PE_MACHINES.get(machine, hex(machine))}"
    return None


def record_file(library: Path) -> Path:
    """What is packed beside a library, with its size and its digest; a build leaves it out."""
    return library.with_name(f"{library.name}.record")


def damage(library: Path) -> str:
    """What has happened to a library since it was packed, to follow "is"; empty: nothing.

    Without a record beside it, whether all is there that its head names: the system maps pages
    behind the end of a file, and they are a crash of the process. Raises OSError when a file cannot
    be read.
    """
    record, data = record_file(library), library.read_bytes()
    if not record.is_file():
        wanted = _least_size(data)
        return f"cut off (it has {len(data)} of {wanted} bytes)" if len(data) < wanted else ""
    words = record.read_text("ascii", "replace").split()
    if len(words) != 2 or not words[0].isdigit():
        return f"beside a damaged {record.name}"
    if len(data) < int(words[0]):
        return f"cut off (it has {len(data)} of {words[0]} bytes)"
    if hashlib.sha256(data).hexdigest() != words[1]:
        return f"damaged (it does not have the digest in {record.name})"
    return ""


def _least_size(data: bytes) -> int:
    """How long an ELF file is at least, by its tables of segments and of sections; 0 for other
    formats, whose systems look for themselves."""
    if data[:6] != b"\x7fELF\x02\x01":
        return 0
    table, sections, step, count, section, section_count = struct.unpack_from("<32xQQ6x4H", data)
    ends = [table + step * count, sections + section * section_count]
    for at in range(table, min(ends[0], len(data) - 55), max(step, 56)):
        begin, size = struct.unpack_from("<8xQ16xQ", data, at)
        ends.append(begin + size)
    return max(ends)


def system_version() -> str:
    """The version of this system that decides what it can load, in words."""
    if sys.platform == "win32":
        return f"Windows {platform.version()}"
    if sys.platform == "darwin":
        return f"macOS {platform.mac_ver()[0]}"
    name, version = platform.libc_ver()
    return f"{name} {version}" if name else "a system without glibc"


def where_to_get(tag: str) -> str:
    """Names what to install for a platform, to end a sentence with."""
    if tag.partition("-")[0] not in _FILES or tag.partition("-")[2] not in _MACHINES.values():
        return f"there is no release for {tag}, so build the library from its sources"
    if not _IS_ADDON:
        return f"install the wheel of meander {VERSION} that is for {tag}"
    name = tag.replace("-", "_")
    return (
        f"install the add-on from meander-{VERSION}-{name}.zip, or from meander-{VERSION}.zip, "
        "which is for every platform"
    )


def needed(tag: str) -> str:
    """What a release's library of a platform needs of the system."""
    return _NEEDED.get(tag.partition("-")[0], "a system that there is no release for")


def again() -> str:
    """How to have the package whole again, to end a sentence with."""
    if _IS_ADDON:
        return "install the add-on again from its zip and restart Blender"
    return "install it again with pip install --force-reinstall and its wheel"


def host() -> str:
    """What loads the library, as its user calls it."""
    return "Blender" if _IS_ADDON else "this Python"
