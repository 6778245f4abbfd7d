# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of docs/ as HTML, for the help that comes with the add-on.

Each opens in a browser by itself, without a network. Pictures are left out, since they are larger
than the add-on, and so are links to what is not among the pages. The same pages give the same
bytes. Needs Python-Markdown (Debian: python3-markdown), whose extensions are those of mkdocs.yml.
"""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from pathlib import Path

try:
    from markdown import Markdown
except ImportError:
    raise SystemExit(
        "The pages of the add-on are made by Python-Markdown, which is not there; run "
        "scripts/install_dependencies.sh --build, or install python3-markdown"
    ) from None

_EXTENSIONS = ["attr_list", "md_in_html", "tables", "toc", "fenced_code"]
_PICTURE = re.compile(r"!\[[^\]]*\]\([^)]*\)(\{[^}]*\})?\n*")
_LINK = re.compile(r'<a href="([^"]*)">(.*?)</a>', re.DOTALL)
_TITLE = re.compile(r"^# (.+)$", re.MULTILINE)

_STYLE = """\
body { margin: 0 auto; max-width: 56rem; padding: 1rem; font: 1rem/1.5 sans-serif; }
nav { border-bottom: 1px solid; padding-bottom: .5rem; }
nav a { margin-right: .8rem; white-space: nowrap; }
table { border-collapse: collapse; display: block; overflow-x: auto; }
td, th { border: 1px solid #8888; padding: .2rem .5rem; text-align: left; vertical-align: top; }
code, pre { background: #8882; }
pre { overflow-x: auto; padding: .5rem; }
@media (prefers-color-scheme: dark) {
  body { background: #222; color: #ddd; }
  a { color: #fa8; }
}
"""

_PAGE = """\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
{style}</style>
</head>
<body>
<nav>
{menu}
</nav>
<main>
{body}
</main>
</body>
</html>
"""


def help_pages(folder: Path, menu: list[tuple[str, str]]) -> dict[str, bytes]:
    """Path from `folder`, with .html, -> HTML, of every Markdown file in it.

    menu   pages that every page leads to: the name without its suffix, and a label
    """
    texts = {
        path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8")
        for path in sorted(folder.rglob("*.md"))
    }
    return {_html_name(name): _page(name, text, texts, menu) for name, text in texts.items()}


def _html_name(name: str) -> str:
    return name.removesuffix(".md") + ".html"


def _page(name: str, text: str, pages: dict[str, str], menu: list[tuple[str, str]]) -> bytes:
    body = Markdown(extensions=_EXTENSIONS).convert(_PICTURE.sub("", text))
    found = _TITLE.search(text)
    up = "../" * name.count("/")
    return _PAGE.format(
        title=html.escape(f"{found[1]} - Meander" if found else "Meander"),
        style=_STYLE,
        menu="\n".join(_menu(up, menu)),
        body=_LINK.sub(lambda link: _link(link, name, pages), body),
    ).encode()


def _menu(up: str, menu: list[tuple[str, str]]) -> Iterator[str]:
    for page, label in menu:
        yield f'<a href="{up}{page}.html">{html.escape(label)}</a>'


def _link(link: re.Match[str], name: str, pages: dict[str, str]) -> str:
    """A link to another page, to a heading or to the web; else its text alone."""
    address, text = link[1], link[2]
    if re.match(r"[a-z]+:|#", address):
        return link[0]
    path, mark, heading = address.partition("#")
    parts: list[str] = name.split("/")[:-1]
    for part in path.split("/"):
        if part == ".." and not parts:
            return text  # outside of the pages
        if part == "..":
            parts.pop()
        else:
            parts.append(part)
    if "/".join(parts) not in pages:
        return text
    return f'<a href="{_html_name(path)}{mark}{heading}">{text}</a>'
