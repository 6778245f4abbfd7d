#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test.sh [--all]
#
# Installs what is missing, builds, and runs the tests: native, Python without Blender, inside Debian's Blender,
# inside Blender 4.5 as a Python module, the installed zip in both, jobs of many surfaces, hard surfaces, UI tests in a
# window, the commands of the documents, the demo, the linter, and the rule which module may import which. Every suite
# runs, even if others fail. Logs stay in build/logs; the last line counts the tests, and the exit code is 0 only when
# nothing failed.
#
# With --all, every night or by hand, also what is compiled anew for it, which takes longer than all else: the native
# tests and a minute of fuzzing the C API under sanitizers, what runs in threads under ThreadSanitizer, whether curves
# have the same bytes however the library is compiled, the library and the page for browsers, what pip builds from the
# sources, the library of a release for Windows, and a program in C#.
#
# Two suites at a time share the processors, the longest first, and what compiles the native tests is one of them. Without
# --all Blender 3.4 runs as many of the tests for Blender as call every function of the add-on (tests/blender/calls.py).
#
# The summary names the slowest test of each suite with its processor seconds; all are in
# build/logs/SUITE.times. Where MEANDER_TEST_LIMIT is set, a test that takes more processor seconds
# than that has failed: continuous integration sets it, so that slower machines have time to spare.
set -euo pipefail
case "${1:-}" in
  "") all=false ;;
  --all) all=true ;;
  *) echo "usage: $0 [--all]" >&2
     exit 2 ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD

bpy_python=build/bpy-4.5/bin/python
logs=build/logs
rm -rf "$logs" build/profiles
mkdir -p "$logs" build/profiles

bash scripts/install_dependencies.sh --build
# The rest, Blender and much else, is fetched and unpacked while the first programs are built.
{
  bash scripts/install_dependencies.sh --bpy 4.5 --site --sanitizers $($all && echo --csharp)
  bash scripts/install_dependencies.sh --package --web --wasi --browser $($all && echo --emulators)
} >"$logs/install.log" 2>&1 &
installing=$!
trap 'wait $installing' EXIT # a package manager is not left behind halfway
# Without these two there is nothing to test; everything else is built below, as a test of its own.
bash scripts/build.sh stage addon
zip=$(ls -t build/meander-*.zip | head -n 1)
# Suites write no bytecode, so without this each of the hundreds of programs that they start would compile the add-on.
/usr/bin/python3 -m compileall -q addon/meander python/meander

# None of the user's Blender settings may be read or changed: every suite gets an empty home
# and an empty profile, 3.4 by three variables, 4.2 and later by BLENDER_USER_RESOURCES.
profile() { # NAME: sets in_profile, the beginning of a command that runs in that profile
  local profile=$root/build/profiles/$1
  mkdir -p "$profile/home" "$profile/config" "$profile/scripts" "$profile/datafiles"
  in_profile=(env HOME="$profile/home" BLENDER_USER_CONFIG="$profile/config"
    BLENDER_USER_SCRIPTS="$profile/scripts" BLENDER_USER_DATAFILES="$profile/datafiles"
    BLENDER_USER_RESOURCES="$profile" PYTHONDONTWRITEBYTECODE=1)
}

results=$logs/results # a line for each suite: how many passed, how many failed, and its row
: >"$results"

# The number before a word in the last line that has it: "12 passed, 1 failed in 3 s".
count_of() {
  grep -oE "[0-9]+ $1" "$2" | tail -n 1 | grep -oE '^[0-9]+' || echo 0
}

# by_time NAME - the lines "SECONDS TEST" of a suite, the slowest first
by_time() {
  [ ! -f "$logs/$1.times" ] || LC_ALL=C sort -rn "$logs/$1.times"
}

# too_slow NAME - those over the limit, if there is one
too_slow() {
  [ -n "${MEANDER_TEST_LIMIT:-}" ] || return 0
  # A suite that records no times would look fast.
  if [ ! -s "$logs/$1.times" ]; then echo "$1 has noted no times"; fi
  by_time "$1" | awk -v limit="$MEANDER_TEST_LIMIT" '$1 > limit'
}

# suite NAME SECONDS COMMAND... - a command that counts its tests
# check NAME SECONDS COMMAND... - a command that is one test by itself
suite() { run_counted 1 "$@"; }
check() { run_counted 0 "$@"; }

run_counted() {
  local counts=$1 name=$2 seconds=$3 log=$logs/$2.log status=0 passed failed begin=$SECONDS
  local slow="" slowest
  shift 3
  MEANDER_TEST_TIMES=$root/$logs/$name.times \
    timeout --kill-after=10 "$seconds" "$@" >"$log" 2>&1 </dev/null || status=$?
  if [ "$counts" -eq 0 ]; then
    passed=1 failed=0
  elif grep -qE '^[0-9]+% tests passed' "$log"; then # ctest
    failed=$(grep -oE '[0-9]+ tests? failed out of' "$log" | tail -n 1 | grep -oE '^[0-9]+')
    passed=$(($(grep -oE 'failed out of [0-9]+' "$log" | tail -n 1 | grep -oE '[0-9]+$') - failed))
  else
    passed=$(count_of passed "$log")
    failed=$(($(count_of failed "$log") + $(count_of 'errors?' "$log")))
  fi
  # Neither a crash nor a suite in which nothing ran may look like success.
  if [ "$status" -eq 0 ] && [ $((passed + failed)) -eq 0 ]; then status="0, but no test ran"; fi
  if [ "$status" != 0 ] && [ "$failed" -eq 0 ]; then failed=1 passed=$((counts * passed)); fi
  slowest=$(by_time "$name" | sed -n '1s/^\([^ ]*\) /; slowest \1 s /p')
  [ "$counts" -eq 0 ] || slow=$(too_slow "$name")
  if [ "$status" = 0 ] && [ -n "$slow" ]; then
    status=slow failed=$(wc -l <<<"$slow")
    passed=$((passed - failed))
  fi
  local verdict=ok row
  case "$status" in
    0) ;;
    slow) verdict="FAILED: tests over $MEANDER_TEST_LIMIT s of processor time" ;;
    124 | 137) verdict="FAILED: not done after $seconds s" ;;
    *) verdict="FAILED: exit code $status" ;;
  esac
  row=$(printf '%-14s %4d passed %3d failed %4d s  %s' \
    "$name" "$passed" "$failed" $((SECONDS - begin)) "$verdict$slowest")
  echo "$passed $failed $row" >>"$results"
  echo "$row"
  case "$status" in
    0) ;;
    slow) printf '%s\n' "$slow" ;;
    *) tail -n 60 "$log" ;;
  esac
}
# The time limits only end what hangs: they leave room for a machine a quarter as fast, on which
# nothing is built yet.
export LIBGL_ALWAYS_SOFTWARE=1 # the same picture whether or not the machine has a graphics card

# window NAME DISPLAY STORY... - stories in a window of Debian's Blender; two at once need two displays
window() {
  local name=$1 display=$2
  shift 2
  profile "$name"
  suite "$name" 900 "${in_profile[@]}" \
    xvfb-run -a -n "$display" -s "-screen 0 960x600x24 -nolisten tcp" \
    blender --factory-startup --enable-event-simulate --window-geometry 0 0 960 600 \
    --python-exit-code 1 --python tests/ui/tell.py -- "$@"
}

beside() { # COMMAND...: begins it as soon as fewer than two others run
  while [ "$(jobs -rp | wc -l)" -ge 2 ]; do wait -n || true; done
  "$@" &
}
# The programs of the native tests, with one of the two processors; the native tests themselves, and what else runs a
# program that is built here, begin when it is done.
beside check build 1800 env CMAKE_BUILD_PARALLEL_LEVEL=1 bash scripts/build.sh
building=$!
if ! wait $installing; then
  cat "$logs/install.log"
  exit 1
fi
trap - EXIT

profile blender-4.5
beside suite blender-4.5 900 "${in_profile[@]}" MEANDER_NOTE_CALLS="$root/$logs/calls.json" \
  "$bpy_python" tests/blender/run.py
in_new_blender=$!
wait $building || true

if $all; then
  # What compiles much, but often waits for the linker or for one test: Wine's, or the slowest sanitized
  # one. The library for Windows stands for all platforms that are not this one.
  suite platforms 1800 bash scripts/package.sh --test windows-x64 &
  suite sanitized 2400 bash scripts/test_sanitized.sh
  wait $!
fi

# What is written for machines, by readers from the Python index that /usr/bin/python3 does not have.
for_machines=(tests/core/test_arcs.py tests/core/test_gcode_tools.py tests/core/test_parts_by_length.py
  tests/core/test_what_machines_take.py tests/core/test_scene_files.py
  tests/core/test_other_libraries.py)

# These compile, with one of the two processors.
if $all; then
  beside suite threads 1800 env CMAKE_BUILD_PARALLEL_LEVEL=1 bash scripts/test_threads.sh
  beside check sources 2400 env CMAKE_BUILD_PARALLEL_LEVEL=1 bash scripts/test_source_package.sh
  beside suite bytes 2400 env CMAKE_BUILD_PARALLEL_LEVEL=1 bash scripts/test_same_bytes.sh
  beside suite web 2400 env CMAKE_BUILD_PARALLEL_LEVEL=1 bash scripts/test_web.sh
fi
$all || beside check page 900 env CMAKE_BUILD_PARALLEL_LEVEL=1 bash scripts/test_web.sh --story
profile core
beside suite core 900 "${in_profile[@]}" \
  /usr/bin/python3 -m pytest -q -p no:cacheprovider "${for_machines[@]/#/--ignore=}" tests/core
beside suite native 1200 ctest --test-dir build --output-on-failure --no-tests=error
beside window ui 100 run undo live follow look make mirror variations
beside window ui-more 200 nothing_lost calm_panel seeds first_try export camera picture
profile documents
beside suite documents 300 "${in_profile[@]}" /usr/bin/python3 scripts/run_documents.py $($all && echo --all)
wait $in_new_blender || true # what it has noted is read by the next
profile blender-3.4
enough=()
$all || enough=(MEANDER_ENOUGH_OF="$root/$logs/calls.json")
beside suite blender-3.4 900 "${in_profile[@]}" "${enough[@]}" \
  blender -b --factory-startup --python-exit-code 1 --python tests/blender/run.py
# This suite makes its own profiles.
beside suite package 600 env MEANDER_ZIP="$root/$zip" MEANDER_BPY_PYTHON="$root/$bpy_python" \
  /usr/bin/python3 -m pytest -q -p no:cacheprovider tests/package
beside check demo 600 env $($all || echo MEANDER_DEMO_SAMPLES=8) bash scripts/demo.sh
profile jobs
beside suite jobs 300 "${in_profile[@]}" /usr/bin/python3 -m pytest -q -p no:cacheprovider tests/jobs
profile sweep
beside suite sweep 600 "${in_profile[@]}" \
  /usr/bin/python3 -m pytest -q -p no:cacheprovider tests/sweep tests/mutation
profile readers
beside suite readers 300 "${in_profile[@]}" "$bpy_python" -m pytest -q -p no:cacheprovider "${for_machines[@]}"
beside check site 120 bash scripts/build_site.sh
beside check workflows 120 node --test tests/web/workflows.test.mjs
beside check lint 60 "$(dirname "$bpy_python")/ruff" check --no-cache .
beside check rooms 60 env PYTHONPATH=addon "$(dirname "$bpy_python")/lint-imports" --no-cache
wait

printf '\n'
cut -d ' ' -f 3- "$results"
awk -v seconds="$SECONDS" '{ passed += $1; failed += $2 }
  END { printf "\n%d s\n%d passed, %d failed\n", seconds, passed, failed; exit failed > 0 || !NR }' \
  "$results"
