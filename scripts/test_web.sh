#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_web.sh [--story]
#
# Makes build/web (scripts/build_web.sh) and tests it: every call in Node, the bytes of curves against those of the
# native library, and the page's story in Chromium. The last line counts the tests. Where MEANDER_PICTURES names a
# folder, pictures of the page are left there.
#
# With --story only the page's story, of a module that is compiled with Debian's C library.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1:-}" in
  "") ;;
  --story)
    bash scripts/install_dependencies.sh --package --web --wasi --browser
    MEANDER_WASI_LIBC=debian bash scripts/build_web.sh
    exec node --test --test-reporter=tap tests/web/story.test.mjs
    ;;
  *) echo "usage: $0 [--story]" >&2
     exit 2 ;;
esac

bash scripts/install_dependencies.sh --package --web --browser
bash scripts/build.sh stage
bash scripts/build_web.sh

passed=0 failed=0
# node_tests FILE - adds up what it counts
node_tests() {
  local log
  log=$(mktemp)
  node --test --test-reporter=tap "$1" 2>&1 | tee "$log" || true
  passed=$((passed + $(sed -n 's/^# pass //p' "$log")))
  failed=$((failed + $(sed -n 's/^# fail //p' "$log") + $(sed -n 's/^# cancelled //p' "$log")))
  rm -f "$log"
}
node_tests tests/web/library.test.mjs
node_tests tests/web/room.test.mjs
node_tests tests/web/story.test.mjs
node_tests tests/web/page.test.mjs

# The package by itself, in a folder of its own, as in the README.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
if (cd "$folder" && npm init -y >/dev/null && npm install --silent --no-audit --no-fund "$OLDPWD"/build/web/meander-*.tgz &&
    sed -n '/^```js$/,/^```$/p' "$OLDPWD/web/README.md" | sed '/^```/d' >example.mjs && node example.mjs); then
  passed=$((passed + 1))
else
  failed=$((failed + 1))
fi

log=$folder/bytes.log
/usr/bin/python3 -m pytest -q -p no:cacheprovider tests/web 2>&1 | tee "$log" || true
passed=$((passed + $(grep -oE '[0-9]+ passed' "$log" | grep -oE '^[0-9]+' || echo 0)))
failed=$((failed + $(grep -oE '[0-9]+ (failed|errors?)' "$log" | grep -oE '^[0-9]+' || echo 0)))

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
