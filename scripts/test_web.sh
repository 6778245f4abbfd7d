#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_web.sh [--story]
#
# Makes build/web (scripts/build_web.sh) and tests it: every call in Node, the bytes of curves against those of the
# native library, and the page in Chromium. The last line counts the tests. Where MEANDER_PICTURES names a folder,
# pictures of the page are left there.
#
# With --story only the page's story and the bytes of one curve, of a module that is compiled with Debian's C library;
# the native library is that of addon/meander, and has to be there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${1:-}" in
  "")
    story=false
    bash scripts/install_dependencies.sh --build
    bash scripts/install_dependencies.sh --package --web --browser
    bash scripts/build.sh stage
    bash scripts/build_web.sh
    ;;
  --story)
    story=true
    bash scripts/install_dependencies.sh --package --web --wasi --browser
    MEANDER_WASI_LIBC=debian bash scripts/build_web.sh
    ;;
  *) echo "usage: $0 [--story]" >&2
     exit 2 ;;
esac

passed=0 failed=0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# node_tests FILE - adds up what it counts
node_tests() {
  local log=$folder/node.log
  node --test --test-reporter=tap "$1" 2>&1 | tee "$log" || true
  passed=$((passed + $(sed -n 's/^# pass //p' "$log")))
  failed=$((failed + $(sed -n 's/^# fail //p' "$log") + $(sed -n 's/^# cancelled //p' "$log")))
}
# same_bytes [CASES] - of curves whose names contain CASES
same_bytes() {
  local log=$folder/bytes.log
  MEANDER_CASES=${1:-} /usr/bin/python3 -m pytest -q -p no:cacheprovider tests/web 2>&1 | tee "$log" || true
  passed=$((passed + $(grep -oE '[0-9]+ passed' "$log" | grep -oE '^[0-9]+' || echo 0)))
  failed=$((failed + $(grep -oE '[0-9]+ (failed|errors?)' "$log" | grep -oE '^[0-9]+' || echo 0)))
}
# npm_package - by itself, in a folder of its own, as in its README
npm_package() {
  local root=$PWD
  mkdir "$folder/npm"
  if (cd "$folder/npm" && npm init -y >/dev/null &&
      npm install --silent --no-audit --no-fund "$root"/build/web/meander-*.tgz &&
      sed -n '/^```js$/,/^```$/p' "$root/web/README.md" | sed '/^```/d' >example.mjs && node example.mjs); then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
  fi
}

node_tests tests/web/story.test.mjs
if $story; then
  same_bytes tetrahedron
else
  node_tests tests/web/library.test.mjs
  node_tests tests/web/room.test.mjs
  node_tests tests/web/page.test.mjs
  npm_package
  same_bytes
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
