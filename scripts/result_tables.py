# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the tables of measurements in docs/ from the rows in docs/results/, and keeps those rows.

    python3 scripts/result_tables.py [--check]
    COMMAND | python3 scripts/result_tables.py --store docs/results/models.json

A file of docs/results/ is one table: its columns, its rows, and what measured them, at which
revision, when and on what machine. A page has the table between `<!-- results: NAME -->` and
`<!-- end of results -->`. --check writes nothing, and fails when a page is not what would be
written.

--store takes the JSON objects, one a line, that a command such as benchmarks/bench.py prints, keeps
those whose keys have the values of `only`, and of each what the columns show. The revision is that
of the checkout; the machine is the one at hand.
"""

from __future__ import annotations

import argparse
import datetime
import json
import os
import platform
import re
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

DOCS = Path(__file__).resolve().parents[1] / "docs"
END = "<!-- end of results -->"
PLACE = re.compile(r"<!-- results: (?P<name>\w+) -->.*?" + re.escape(END), re.DOTALL)

Row = dict[str, Any]


def of_key(row: Row, key: str) -> Any:
    """The value at a dotted key, such as new.cpu_seconds; None where there is none."""
    value: Any = row
    for part in key.split("."):
        value = value.get(part) if isinstance(value, dict) else None
    return value


def shown(value: Any, column: Row) -> str:
    if value is None:
        return ""
    if isinstance(value, (int, float)):
        return format(value * column.get("times", 1), column.get("format", ""))
    return str(value)


def table(results: Row) -> str:
    """The rows in Markdown, and below them what is known of their making."""
    columns = results["columns"]
    lines = [[column["head"] for column in columns], ["---"] * len(columns)]
    lines += [[shown(row.get(c["key"]), c) for c in columns] for row in results["rows"]]
    text = "\n".join("| " + " | ".join(line) + " |" for line in lines)
    made = f"*Measured by {results['measured_by']}; revision {results['revision']}; "
    made += f"{results['machine']}.*"
    return f"{text}\n\n{made}"


def page_with_tables(text: str, folder: Path) -> str:
    """A page whose tables are those of the files in `folder`."""

    def written(place: re.Match[str]) -> str:
        path = folder / f"{place['name']}.json"
        if not path.is_file():
            sys.exit(f"result_tables.py: a page names {path}, which is not there")
        lines = table(json.loads(path.read_text(encoding="utf-8")))
        return f"<!-- results: {place['name']} -->\n\n{lines}\n\n{END}"

    return PLACE.sub(written, text)


def kept(lines: Iterable[str], results: Row) -> list[Row]:
    """What the columns show of the JSON objects among `lines` that are rows of this table."""
    rows = [json.loads(line) for line in lines if line.startswith("{")]
    only = results.get("only", {})
    fitting = [row for row in rows if all(of_key(row, key) == only[key] for key in only)]
    keys = [column["key"] for column in results["columns"]]
    return [{key: of_key(row, key) for key in keys} for row in fitting]


def revision() -> str:
    command = ["git", "describe", "--always", "--dirty", "--exclude=*"]
    done = subprocess.run(command, cwd=DOCS, capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else "not recorded"


def machine() -> str:
    names = [platform.machine()]
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.is_file():
        names = re.findall(r"^model name\s*: (.+)$", cpuinfo.read_text(), re.MULTILINE) or names
    return f"{names[0]}, {os.cpu_count()} processors"


def store(path: Path, lines: Iterable[str]) -> None:
    """Replaces the rows of a table by those of a new measurement."""
    results = json.loads(path.read_text(encoding="utf-8"))
    rows = kept(lines, results)
    if not rows:
        sys.exit(f"result_tables.py: no row on standard input belongs to {path}")
    results |= {"revision": revision(), "date": datetime.date.today().isoformat()}
    results |= {"machine": machine(), "rows": rows}
    path.write_text(as_text(results), encoding="utf-8")


def as_text(results: Row) -> str:
    """JSON with a line for each column and each row, so that a change of one shows as one."""
    parts = []
    for key, value in results.items():
        if key in ("columns", "rows"):
            lines = ",\n".join("    " + json.dumps(item, ensure_ascii=False) for item in value)
            parts.append(f"  {json.dumps(key)}: [\n{lines}\n  ]")
        else:
            parts.append(f"  {json.dumps(key)}: {json.dumps(value, ensure_ascii=False)}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("--check", action="store_true", help="write nothing; fail if out of date")
    parser.add_argument("--store", type=Path, metavar="FILE", help="rows from standard input")
    arguments = parser.parse_args()
    if arguments.store:
        store(arguments.store, sys.stdin)
    wrong = 0
    for page in sorted(DOCS.rglob("*.md")):
        text = page.read_text(encoding="utf-8")
        wanted = page_with_tables(text, DOCS / "results")
        if text == wanted:
            continue
        if arguments.check:
            print(f"{page} is out of date; run python3 scripts/result_tables.py")
            wrong = 1
        else:
            page.write_text(wanted, encoding="utf-8")
    return wrong


if __name__ == "__main__":
    sys.exit(main())
