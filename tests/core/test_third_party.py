# SPDX-License-Identifier: GPL-3.0-or-later
"""The sources of others in the tree are as they were published."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OPENMESH = ROOT / "native" / "third_party" / "openmesh"
OURS = {"README.md", "SHA256SUMS"}


def test_openmesh_is_unchanged() -> None:
    listed = dict(
        reversed(line.split("  ", 1))
        for line in (OPENMESH / "SHA256SUMS").read_text("utf-8").splitlines()
    )
    found = {
        str(path.relative_to(OPENMESH).as_posix()): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in OPENMESH.rglob("*")
        if path.is_file() and path.name not in OURS
    }
    assert found == listed


def test_the_notices_have_its_licence() -> None:
    def words(text: str) -> str:
        return " ".join(re.sub(r"[*/\\=_-]", " ", text).split())

    licence = words((OPENMESH / "LICENSE").read_text("utf-8"))
    notices = words((ROOT / "THIRD_PARTY_NOTICES.md").read_text("utf-8"))
    assert licence[licence.index("Redistribution and use") :] in notices
