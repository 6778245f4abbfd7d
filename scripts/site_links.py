# SPDX-License-Identifier: GPL-3.0-or-later
"""Hook of mkdocs: a link from docs/ to another folder of the sources becomes plain text.

A reader of the sources follows it; the site has only the pages.
"""

from __future__ import annotations

import re
from typing import Any

_OUTSIDE = re.compile(r"\[([^\]]+)\]\(\.\./[^)]*\)")


def on_page_markdown(markdown: str, page: Any, **_others: object) -> str:
    """Takes the links out of a page that leave docs/; a page in a folder may name its parent's."""
    if "/" in page.file.src_uri:
        return markdown
    return _OUTSIDE.sub(r"\1", markdown)
