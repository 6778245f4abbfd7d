# SPDX-License-Identifier: GPL-3.0-or-later
"""How much memory this process may still use before the system ends it; no bpy.

Where memory runs out, Linux seldom says so: it gives addresses to everybody, and ends a process
when they are used. Nobody hears a sentence then, so what is known to be too much is refused before.
"""

from __future__ import annotations

import os
from pathlib import Path, PurePosixPath

_PROC = Path("/proc")
_GROUPS = Path("/sys/fs/cgroup")


def available_memory(proc: Path = _PROC, groups: Path = _GROUPS) -> int | None:
    """Bytes: what is free on the machine, or less in a container or a job with a limit of its own.

    On Linux what the kernel calls available, and the limits of the control groups (version 2) that
    the process is in; elsewhere all memory of the machine; None: it cannot be known.

    proc, groups   where the kernel tells of processes and of control groups
    """
    found = [_of_machine(proc), *_of_groups(proc, groups)]
    known = [size for size in found if size is not None]
    return min(known) if known else None


def _of_machine(proc: Path) -> int | None:
    for line in _lines(proc / "meminfo"):
        if line.startswith("MemAvailable:"):
            return 1024 * int(line.split()[1])
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):  # Windows
        return None


def _of_groups(proc: Path, groups: Path) -> list[int]:
    """What is left in the process's group, and in each that holds it."""
    left = []
    for line in _lines(proc / "self" / "cgroup"):
        number, _controllers, name = line.split(":", 2)
        if number != "0":  # of version 1
            continue
        inside = PurePosixPath(name.strip().lstrip("/"))
        for part in (inside, *inside.parents):
            folder = groups / part
            limit, used = _number(folder / "memory.max"), _number(folder / "memory.current")
            if limit is not None and used is not None:
                # Files that are kept in memory make room.
                left.append(max(0, limit - used + _kept_files(folder)))
    return left


def _kept_files(folder: Path) -> int:
    for line in _lines(folder / "memory.stat"):
        if line.startswith("inactive_file "):
            return int(line.split()[1])
    return 0


def _number(path: Path) -> int | None:
    """The number in a file; None: there is none, or no limit."""
    text = "".join(_lines(path)).strip()
    return int(text) if text.isdigit() else None


def _lines(path: Path) -> list[str]:
    try:
        return path.read_text(encoding="ascii", errors="replace").splitlines()
    except OSError:
        return []
