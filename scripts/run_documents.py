# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the commands of the *.md files of the root and of docs, so that they stay correct.

    run_documents.py [--all]

In each document the fenced blocks marked `sh` are run from the project's root, one after the
other. A comment on the line before a block says otherwise:

    <!-- not run here: REASON -->     the block is left out
    <!-- run every night: REASON -->  the block is left out unless --all is given
    <!-- file: PATH -->               the block, of any language, is written to PATH instead

The last line is a count such as "5 passed, 0 failed".
"""

import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT / "tests"))

from processor_time import note, spent  # noqa: E402

FENCE = re.compile(
    r"(?:<!-- (?P<remark>not run here|run every night|file): (?P<value>.+?) -->\n)?"
    r"^```(?P<language>\w*)\n(?P<body>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)


class Block(NamedTuple):
    place: str  # "README.md:12"
    language: str
    remark: str | None
    value: str | None
    body: str


def blocks_of(document: Path) -> list[Block]:
    text = document.read_text(encoding="utf-8")
    return [
        Block(
            f"{document.relative_to(ROOT)}:{text.count(chr(10), 0, match.start()) + 1}",
            match["language"], match["remark"], match["value"], match["body"],
        )
        for match in FENCE.finditer(text)
    ]


def run(block: Block) -> bool:
    print(f"--- {block.place}", flush=True)
    begin = spent()
    done = subprocess.run(["bash", "-euo", "pipefail", "-x", "-c", block.body], cwd=ROOT)
    note(block.place, spent() - begin)
    if done.returncode != 0:
        print(f"--- {block.place}: exit code {done.returncode}", flush=True)
    return done.returncode == 0


def main() -> int:
    run_remarks = {None, "run every night"} if "--all" in sys.argv[1:] else {None}
    passed = failed = 0
    for document in [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md"))]:
        for block in blocks_of(document):
            if block.remark == "file":
                path = ROOT / block.value
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(block.body, encoding="utf-8")
            elif block.language == "sh" and block.remark in run_remarks:
                if run(block):
                    passed += 1
                else:
                    failed += 1
    print(f"{passed} passed, {failed} failed")
    return 0 if failed == 0 and passed > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
