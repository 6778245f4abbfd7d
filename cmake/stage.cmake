# SPDX-License-Identifier: GPL-3.0-or-later
#
# cmake "-DFILES=a;b" -DFOLDER=... -DVERSION=... -P stage.cmake
#
# Copies the files into the folder and removes libraries of other versions from it, and the records
# of packed ones. Every file is written under a temporary name and renamed, so that a Blender that
# has the old one loaded keeps it whole.

file(MAKE_DIRECTORY "${FOLDER}")
set(names "")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  list(APPEND names "${name}")
  set(target "${FOLDER}/${name}")
  set(present "")
  if(EXISTS "${target}")
    file(SHA256 "${target}" present)
  endif()
  file(SHA256 "${file}" fresh)
  if(NOT present STREQUAL fresh)
    file(COPY_FILE "${file}" "${target}.part")
    file(RENAME "${target}.part" "${target}")
  endif()
endforeach()

file(GLOB others RELATIVE "${FOLDER}" "${FOLDER}/libmeander-*" "${FOLDER}/meander-*")
list(REMOVE_ITEM others ${names})
foreach(name IN LISTS others)
  file(REMOVE "${FOLDER}/${name}")
endforeach()
