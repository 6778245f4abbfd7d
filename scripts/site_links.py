# SPDX-License-Identifier: GPL-3.0-or-later
"""Hook of mkdocs: a link from docs/ to another folder of the sources becomes plain text.

A reader of the sources follows it; the site has only the pages. The page of build/web, where
scripts/build_web.sh has made it, becomes try.html; where it has not, links to it are plain text.
"""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

_TRY = Path(__file__).resolve().parents[1] / "build" / "web" / "index.html"
_LINK_TO_TRY = re.compile(r'<a href="try\.html">(.*?)</a>')
_OUTSIDE = re.compile(r"\[([^\]]+)\]\(\.\./[^)]*\)")


def on_page_markdown(markdown: str, page: Any, **_others: object) -> str:
    """Takes the links out of a page that leave docs/; a page in a folder may name its parent's."""
    if not _TRY.is_file():
        markdown = _LINK_TO_TRY.sub(r"\1", markdown)
    if "/" in page.file.src_uri:
        return markdown
    return _OUTSIDE.sub(r"\1", markdown)


def on_post_build(config: Any) -> None:
    """Puts the page beside those of the site."""
    if _TRY.is_file():
        shutil.copyfile(_TRY, Path(config["site_dir"]) / "try.html")
