# SPDX-License-Identifier: GPL-3.0-or-later
#
# cmake "-DFILES=a;b" -DFOLDER=... -DVERSION=... -P stage.cmake
#
# Puts the files into the folder and takes libraries of other versions out of it. Every file is
# written aside and renamed: a Blender that has the old one loaded keeps it whole.

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

file(GLOB others RELATIVE "${FOLDER}" "${FOLDER}/libmeander-*")
list(REMOVE_ITEM others ${names})
foreach(name IN LISTS others)
  file(REMOVE "${FOLDER}/${name}")
endforeach()
