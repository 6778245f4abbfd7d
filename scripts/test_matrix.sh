#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# test_matrix.sh [VERSION]...
#
# Runs the tests of core, of the add-on and of the installed zip in several Blenders, one after the
# other: Debian's 3.4, and bpy of the Python index as 4.2, 4.5, 5.0 and 5.2, or only those named.
# Versions after 5.0 need Python 3.13 (install_dependencies.sh says where it looks); without one
# they are named as left out. What is missing is installed, a gigabyte for each version. Takes about
# five minutes a version: by hand, before a release. Logs stay in build/logs/matrix; the last lines
# are a table, and the exit code is 0 only when nothing failed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD
versions=("$@")
[ ${#versions[@]} -gt 0 ] || versions=(3.4 4.2 4.5 5.0 5.2)

# 4.5 for the linter that a test of the package uses.
bash scripts/install_dependencies.sh --bpy 4.5
bash scripts/build.sh stage addon
zip=$(ls -t build/meander-*.zip | head -n 1)
logs=build/logs/matrix
rm -rf "$logs" build/profiles/matrix
mkdir -p "$logs"
table=$logs/table
printf '%-10s %-10s %8s %8s %8s  %s\n' Blender suite passed failed skipped seconds >"$table"
failures=0

count_of() { # WORD LOG: the number before a word in the last line that has it
  grep -oE "[0-9]+ $1" "$2" | tail -n 1 | grep -oE '^[0-9]+' || echo 0
}

# run VERSION SUITE COMMAND... - one suite in an empty profile
run() {
  local version=$1 suite=$2 log=$logs/$1-$2.log status=0 begin=$SECONDS passed failed
  local profile=$root/build/profiles/matrix/$1-$2
  shift 2
  mkdir -p "$profile/home" "$profile/config" "$profile/scripts" "$profile/datafiles"
  env HOME="$profile/home" BLENDER_USER_CONFIG="$profile/config" PYTHONDONTWRITEBYTECODE=1 \
    BLENDER_USER_SCRIPTS="$profile/scripts" BLENDER_USER_DATAFILES="$profile/datafiles" \
    BLENDER_USER_RESOURCES="$profile" LIBGL_ALWAYS_SOFTWARE=1 \
    timeout --kill-after=10 1800 "$@" >"$log" 2>&1 </dev/null || status=$?
  passed=$(count_of passed "$log")
  failed=$(($(count_of failed "$log") + $(count_of 'errors?' "$log")))
  # A crash, and a suite in which nothing ran, may not look like success.
  if [ "$failed" -eq 0 ] && { [ "$status" -ne 0 ] || [ "$passed" -eq 0 ]; }; then failed=1; fi
  [ "$failed" -eq 0 ] || { failures=$((failures + failed)); tail -n 40 "$log"; }
  printf '%-10s %-10s %8d %8d %8d  %d\n' "$version" "$suite" "$passed" "$failed" \
    "$(count_of skipped "$log")" $((SECONDS - begin)) | tee -a "$table"
}

pytest_options=(-q -p no:cacheprovider)
for version in "${versions[@]}"; do
  if [ "$version" = 3.4 ]; then
    run 3.4 core /usr/bin/python3 -m pytest "${pytest_options[@]}" tests/core
    run 3.4 add-on blender -b --factory-startup --python-exit-code 1 \
      --python tests/blender/run.py
    run 3.4 package env MEANDER_ZIP="$root/$zip" \
      MEANDER_BPY_PYTHON="$root/build/bpy-4.5/bin/python" \
      /usr/bin/python3 -m pytest "${pytest_options[@]}" tests/package -k 'blender-3.4 or zip'
    continue
  fi
  if ! bash scripts/install_dependencies.sh --bpy "$version"; then
    printf '%-10s left out: see above\n' "$version" | tee -a "$table"
    continue
  fi
  python=$root/build/bpy-$version/bin/python
  run "$version" core "$python" -m pytest "${pytest_options[@]}" tests/core
  run "$version" add-on "$python" tests/blender/run.py
  run "$version" package env MEANDER_ZIP="$root/$zip" MEANDER_BPY_PYTHON="$python" \
    /usr/bin/python3 -m pytest "${pytest_options[@]}" tests/package -k 'not blender-3.4'
done

printf '\n'
cat "$table"
exit $((failures > 0))
