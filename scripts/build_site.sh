#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# build_site.sh [--web]
#
# Makes the site build/site from the pages in docs/, and fails when a page is missing from the
# menu of mkdocs.yml or a link leads nowhere. Open build/site/index.html to read it. With --web it
# builds the page that fills meshes first, or else takes the one that is in build/web, if any.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1:-}" in
  "") ;;
  --web) bash scripts/build_web.sh ;;
  *) echo "usage: $0 [--web]" >&2
     exit 2 ;;
esac
bash scripts/install_dependencies.sh --site
# Not --quiet: with it, mkdocs counts no warnings. The variable keeps a notice about its next version
# out of the log.
NO_MKDOCS_2_WARNING=1 build/site-tools/bin/mkdocs build --strict --clean
if grep -rnoE --include='*.html' '(src="|stylesheet" href=")https?:[^"]*' build/site; then
  echo "These pages load something from elsewhere; a reader may be without a network." >&2
  exit 1
fi
echo "build/site/index.html"
