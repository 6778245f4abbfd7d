# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the tables of docs/options.md, export.md and settings.md from those in the code.

    python3 scripts/write_option_table.py [--check]

Defaults are the library's. --check writes nothing, and fails when a page is not what would be
written.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "addon"))

from meander import core  # noqa: E402
from meander.model.options import export  # noqa: E402
from meander.model.options.option import Option  # noqa: E402
from meander.model.options.table import TABLE  # noqa: E402

DOCS = ROOT / "docs"
# From top to bottom, as in the sidebar.
PANELS = (
    "Meander", "Look", "Guidance", "Density", "Seed and Strands", "Direction", "Region",
    "Mesh Repair", "Motion", "Make", "Advanced", "Strand Shape", "Preferences",
)
BEGIN, END = "<!-- written by scripts/write_option_table.py -->", "<!-- to here -->"
# Where 0 stands for the preset's own value: the field that has it, in the same unit.
OF_THE_PRESET = {"max_radius": "max_radius_factor"}
UNITS = {"length": "scene", "r": "r", "spacing": "spacings", "share": "", "": ""}


def number(value: float) -> str:
    return f"{value:.12g}"


def shown(option: Option, value: object) -> str:
    """A default as a reader knows it."""
    if option.kind is bool:
        return "on" if value else "off"
    if option.kind is str:
        return getattr(value, "name", str(value)).lower()
    if option.zero_is_preset and value == 0:
        return "its own"
    return number(value)


def defaults(option: Option) -> list[str]:
    """Of the presets: what the library has, else what the setting has."""
    if option.field in ("", "preset"):
        return [shown(option, option.default)] * len(core.PRESETS)
    field = OF_THE_PRESET.get(option.field, option.field)
    found = (getattr(core.default_options(preset), field) for preset in core.PRESETS)
    return [shown(option, value) for value in found]


def name_in_panel(option: Option) -> str:
    return option.row or option.label


def span(option: Option) -> str:
    if option.choices:
        return ", ".join(name for name, _label, _tip in option.choices)
    if option.least is None and option.greatest is None:
        return ""
    if option.greatest is None:
        return f"{number(option.least)} or more"
    return f"{number(option.least)} to {number(option.greatest)}"


def flag_text(option: Option) -> str:
    flag = option.flag
    if flag is None:
        return ""
    text = f"`{flag.name}{' ' + flag.metavar if flag.metavar else ''}`"
    return text + ", in scene units" if flag.in_scene_units else text


def default_text(option: Option) -> str:
    """The default, or those of the presets where they differ."""
    of_presets = defaults(option)
    if len(set(of_presets)) == 1:
        return of_presets[0]
    pairs = zip(core.PRESETS, of_presets, strict=True)
    return ", ".join(f"{value} ({preset})" for preset, value in pairs)


# Head of a column -> its cell. More than seven columns are wider than a page of the site.
CELLS = {
    "option": lambda option: f"*{name_in_panel(option)}*",
    "setting": lambda option: f"`{option.setting}`",
    "flag": flag_text,
    "unit": lambda option: UNITS[option.unit],
    "range": span,
    "default": default_text,
    "what it does": lambda option: option.tip,
}
# settings.md says in which panel each is, and what it does.
OF_OPTIONS = ("option", "setting", "flag", "unit", "range", "default")
OF_EXPORT = ("option", "setting", "flag", "range", "default", "what it does")


def table(options: tuple[Option, ...], heads: tuple[str, ...]) -> str:
    lines = [heads, ("---",) * len(heads)]
    lines += [tuple(CELLS[head](option) for head in heads) for option in options]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def sentence(text: str) -> str:
    return text[:1].upper() + text[1:]


def artists_table() -> str:
    """Every setting with what low and high do, panel by panel."""
    lines = []
    unplaced = {option.panel for option in TABLE}.difference(PANELS)
    if unplaced:
        raise SystemExit(f"PANELS of this script lacks {', '.join(sorted(unplaced))}")
    for panel in (panel for panel in PANELS if any(option.panel == panel for option in TABLE)):
        lines += [f"### {panel}", "", "| setting | what it does | low | high |"]
        lines.append("|---|---|---|---|")
        for option in (option for option in TABLE if option.panel == panel):
            what = option.tip
            if option.choices:
                what += ". " + "; ".join(f"*{label}*: {tip}" for _, label, tip in option.choices)
            name = f"*{name_in_panel(option)}*"
            cells = (name, what, sentence(option.low), sentence(option.high))
            lines.append("| " + " | ".join(cells) + " |")
        lines.append("")
    return "\n".join(lines).strip()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; fail if out of date")
    arguments = parser.parse_args()
    pages = {
        "options": table(TABLE, OF_OPTIONS),
        "export": table(export.ROWS, OF_EXPORT),
        "settings": artists_table(),
    }
    return max(
        write(DOCS / f"{name}.md", lines, arguments.check) for name, lines in pages.items()
    )


def write(page: Path, lines: str, check: bool) -> int:
    """Puts a table into its place in a page. The exit code: 1 if it should have been there."""
    text = page.read_text(encoding="utf-8")
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    wanted = f"{before}{BEGIN}\n\n{lines}\n\n{END}{after}"
    if text == wanted:
        return 0
    if check:
        print(f"{page} is out of date; run python3 scripts/write_option_table.py")
        return 1
    page.write_text(wanted, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
