# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints tables of a sweep from its rows, in Markdown: only what was run.

    python3 tests/sweep/summary.py build/sweep/rows.jsonl [--rows]

With --rows it prints a JSON object for each radius instead, which scripts/result_tables.py keeps
for docs/reliability.md.
"""

from __future__ import annotations

import argparse
import json
import re
import statistics
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from rows import EXPECTED, failed, read_rows

Row = dict[str, Any]

# Of runs with fewer nodes the time is not that of their nodes.
FEWEST_NODES = 200
NOMINAL = 1 / 20  # the nominal radius in roots of the area: see shapes.py
SLOW = 4.0


def cost(row: Row) -> float | None:
    """Seconds per node and iteration, where there are enough nodes to tell."""
    iterations, nodes = row.get("iterations", 0), row.get("node_iterations", 0.0)
    return row["flowing"] / nodes if iterations and nodes / iterations >= FEWEST_NODES else None


def relative_costs(rows: Iterable[Row]) -> dict[int, float]:
    """The cost of rows, by their place, in medians of those with the same preset and measure."""
    costs: dict[tuple[str, str], dict[int, float]] = defaultdict(dict)
    for place, row in enumerate(rows):
        seconds = cost(row)
        if seconds is not None:
            costs[row["preset"], row["measure"]][place] = seconds
    relative = {}
    for group in costs.values():
        median = statistics.median(group.values())
        relative |= {place: seconds / median for place, seconds in group.items()}
    return relative


def filled(row: Row) -> float:
    """How much of the surface the curve fills: 2 r L / A, near 1 where it is full."""
    area = (row["radius"] / row["factor"] / NOMINAL) ** 2
    return 2 * row["radius"] * row.get("length", 0.0) / area


def half_empty(rows: list[Row]) -> tuple[list[Row], int]:
    """Runs that ended with less than half of the surface filled, and of how many.

    Only of those that ought to fill it: not of the preset paper, which leaves a stroke as it is;
    not with distances through space, where a curve on one side of a thin sheet fills both sides;
    and not with a wider spacing than the nominal one.
    """
    ought = [
        row
        for row in rows
        if row["outcome"] in ("converged", "limit", "stalled")
        and row["preset"] != "paper"
        and row["measure"] == "geodesic"
        and row["factor"] <= 1
    ]
    return [row for row in ought if filled(row) < 0.5], len(ought)


def _table(head: list[str], lines: list[list[object]]) -> str:
    rows = [head, ["---"] * len(head), *lines]
    return "\n".join("| " + " | ".join(str(cell) for cell in row) + " |" for row in rows)


def counts(rows: list[Row]) -> dict[str, int]:
    """What became of runs: what HEAD names, by its name."""
    outcomes = Counter(row["outcome"] for row in rows)
    return {
        "runs": len(rows),
        **{name: outcomes[name] for name in EXPECTED},
        "broken": sum(count for name, count in outcomes.items() if name not in EXPECTED),
        "checked": sum(row.get("checked", 0) for row in rows),
        "crossings": sum(row.get("crossings", 0) for row in rows),
        "faults": sum(1 for row in rows if row.get("faults")),
    }


HEAD = ["runs", *EXPECTED, "crash, hang, error", "curves checked", "crossings", "runs with a fault"]


def grouped(rows: list[Row], key: Callable[[Row], Any]) -> list[tuple[Any, dict[str, int]]]:
    """The counts of the rows with each value of `key`."""
    groups: dict[Any, list[Row]] = defaultdict(list)
    for row in rows:
        groups[key(row)].append(row)
    return [(value, counts(groups[value])) for value in sorted(groups)]


def by(rows: list[Row], name: str, key: Callable[[Row], Any]) -> str:
    """A table with a line for each value of `key`."""
    lines = [[value, *(f"{n:,}" for n in c.values())] for value, c in grouped(rows, key)]
    return _table([name, *HEAD], lines)


def of_models(rows: list[Row]) -> str:
    """A line for each model: outcomes, largest curve, longest set-up, slowest run, failures."""
    relative = relative_costs(rows)
    groups: dict[str, list[int]] = defaultdict(list)
    for place, row in enumerate(rows):
        groups[row["model"]].append(place)
    lines = []
    for model, places in sorted(groups.items()):
        mine = [rows[place] for place in places]
        outcomes = Counter(row["outcome"] for row in mine)
        said = ", ".join(f"{outcomes[name]} {name}" for name in sorted(outcomes))
        costs = [relative[place] for place in places if place in relative]
        lines.append(
            [
                model.replace("_", " "),
                said,
                f"{max(row.get('nodes', 0) for row in mine):,}",
                f"{max(row.get('creating', 0) for row in mine):.2f}",
                f"{max(costs):.1f}" if costs else "",
                sum(failed(row) for row in mine),
            ]
        )
    head = ["model", "outcomes", "most nodes", "longest set-up, s", "slowest", "failed"]
    return _table(head, lines)


def refusals(rows: list[Row]) -> str:
    """The sentences with which runs were refused, numbers left out."""
    sentences = Counter(
        re.sub(r"\d[\d.e+-]*", "…", row["reason"]) for row in rows if row["outcome"] == "refused"
    )
    return _table(["runs", "refused because"], [[n, text] for text, n in sentences.most_common()])


def failures(rows: list[Row]) -> str:
    """What is wrong, run by run."""
    lines = [
        f"* {row['model']}, {row['factor']:g} r, {row['preset']}, {row['measure']}, seed "
        f"{row['seed']}: {row['outcome']} {row.get('reason', '')} {row.get('first_fault', '')}"
        for row in rows
        if failed(row)
    ]
    return "\n".join(lines) if lines else "No run failed."


def _names(rows: list[Row]) -> str:
    """The models of rows, each once, with the number of its rows where there are several."""
    counts = Counter(row["model"].replace("_", " ") for row in rows)
    return ", ".join(
        f"{name} {count} times" if count > 1 else name for name, count in sorted(counts.items())
    )


def tables(rows: list[Row]) -> str:
    """All that is said of a sweep, in Markdown."""
    relative = relative_costs(rows)
    slow = [rows[place] for place, value in relative.items() if value > SLOW]
    sparse, ought = half_empty(rows)
    checked = sum(row.get("checked", 0) for row in rows)
    nodes = sum(row.get("node_iterations", 0) for row in rows)
    parts = [
        f"{len(rows):,} runs on {len({row['model'] for row in rows})} models, with {checked:,} "
        f"curves checked and {nodes / 1e6:,.0f} million nodes in them.",
        by(rows, "radius", lambda row: row["factor"]),
        by(rows, "preset and measure", lambda row: f"{row['preset']}, {row['measure']}"),
        by(rows, "seed", lambda row: row["seed"]),
        f"Time per node and iteration, where there are at least {FEWEST_NODES} nodes: "
        f"{len(slow)} of {len(relative):,} runs take more than {SLOW:g} times the median of their "
        "preset and measure" + (f" (on {_names(slow)})." if slow else "."),
        f"Of {ought} runs along the surface that ended by themselves, with the presets even and "
        f"finest and radii up to the nominal one, {len(sparse)} leave more than half of it empty"
        + (f" (on {_names(sparse)})." if sparse else "."),
        refusals(rows),
        failures(rows),
        of_models(rows),
    ]
    return "\n\n".join(parts)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n\n")[0])
    parser.add_argument("rows", type=Path, nargs="+", help="files of rows")
    parser.add_argument("--rows", action="store_true", dest="as_rows", help="JSON, by radius")
    arguments = parser.parse_args()
    rows = [row for path in arguments.rows for row in read_rows(path)]
    if not rows:
        sys.exit("summary.py: there are no rows; run sweep.py first")
    if arguments.as_rows:
        for radius, found in grouped(rows, lambda row: row["factor"]):
            print(json.dumps({"row": "sweep", "radius": radius, **found}))
    else:
        print(tables(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
