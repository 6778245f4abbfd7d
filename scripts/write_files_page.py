# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the tables of docs/files.md from the cases that the tests read, tests/core/file_cases.py.

    python3 scripts/write_files_page.py [--check]

--check writes nothing, and fails when the page is not what would be written.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "core"))

from file_cases import CASES  # noqa: E402

PAGE = ROOT / "docs" / "files.md"
BEGIN, END = "<!-- written by scripts/write_files_page.py -->", "<!-- to here -->"
KINDS = {"obj": "OBJ", "ply": "PLY", "stl": "STL"}


def tables() -> str:
    """What is read in silence as one sentence; a line for each case of which something is said."""
    lines = []
    for kind, name in KINDS.items():
        cases = [case for case in CASES if case.kind == kind]
        silent = "; ".join(case.title for case in cases if case.area and not case.said)
        lines += [f"### {name}", "", f"Read: {silent}.", ""]
        for becomes in ("repaired", "refused"):
            lines += [f"| {becomes} | what is said |", "|---|---|"]
            for case in (c for c in cases if c.said and (c.area > 0) == (becomes == "repaired")):
                said = case.said if not case.said.startswith((" ", ",")) else f"FILE{case.said}"
                lines.append(f"| {case.title} | {said.replace('|', '&#124;')} |")
            lines.append("")
    return "\n".join(lines).strip()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; fail if out of date")
    check = parser.parse_args().check
    text = PAGE.read_text(encoding="utf-8")
    before, _, rest = text.partition(BEGIN)
    wanted = f"{before}{BEGIN}\n\n{tables()}\n\n{END}{rest.partition(END)[2]}"
    if text == wanted:
        return 0
    if check:
        print(f"{PAGE} is out of date; run python3 scripts/write_files_page.py")
        return 1
    PAGE.write_text(wanted, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
