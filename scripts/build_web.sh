#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# From a bare Debian 12: makes the library for browsers and Node in build/web:
#
#   meander.mjs     one ES module with the WebAssembly module inside, and meander.d.ts
#   meander-*.tgz   the same as a package for npm
#   index.html      a page that fills meshes, which works by itself from a folder
#
# With MEANDER_WASI_LIBC=debian the C library is that of Debian's packages, which install_dependencies.sh --wasi
# installs, and not one that Zig compiles first: for a test, sooner by a minute of a processor.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash scripts/install_dependencies.sh --package --web

log=build/package/web.log
mkdir -p build/package
wasi=(-DMEANDER_WASI_LIBC= -DMEANDER_WASI_BUILTINS=)
if [ "${MEANDER_WASI_LIBC:-}" = debian ]; then
  wasi=(-DMEANDER_WASI_LIBC=/usr/lib/wasm32-wasi
    "-DMEANDER_WASI_BUILTINS=$(dpkg -L libclang-rt-14-dev-wasm32 | grep '/libclang_rt.builtins-wasm32.a$')")
fi
if ! { cmake --preset web "${wasi[@]}" && cmake --build --preset web; } >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  echo "$0: the WebAssembly module was not built; the whole log is $log" >&2
  exit 1
fi
/usr/bin/python3 scripts/generate_abi.py --header native/include/meander/meander.h \
  --javascript build/package/web/abi.mjs
rm -rf build/web
node scripts/web/build.mjs build/package/web/meander.wasm build/package/web/abi.mjs build/web-tools build/web
cp web/meander.d.ts build/web/

# The package: what its users need, and none of what it is made with.
package=build/package/web/npm
version=$(sed -n 's/^project(Meander VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
rm -rf "$package"
mkdir -p "$package"
cp build/web/meander.mjs build/web/meander.d.ts LICENSE THIRD_PARTY_NOTICES.md "$package"
cp web/README.md "$package"
sed "s/\"0.0.0\"/\"$version\"/" web/npm/package.json >"$package/package.json"
npm pack --silent --pack-destination build/web "./$package" >/dev/null
ls -l build/web | awk 'NR > 1 { printf "%9d  %s\n", $5, $NF }'
