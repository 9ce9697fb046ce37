# SPDX-License-Identifier: BSD-3-Clause
# pcl_sq_units(TARGET): compiles the files of a folder as one, which takes a third of the
# time of a build from nothing, for headers of PCL and Eigen are most of what a file costs.
# Files with compiler flags of their own stay by themselves, and those with CMake's
# SKIP_UNITY_BUILD_INCLUSION. CMAKE_UNITY_BUILD does the same by absolute paths, with which
# ccache finds nothing again in another clone.
function(pcl_sq_units target)
  if(NOT PCL_SQ_UNITS)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  set(kept "")
  set(groups "")
  foreach(source IN LISTS sources)
    get_source_file_property(options "${source}" COMPILE_OPTIONS)
    get_source_file_property(definitions "${source}" COMPILE_DEFINITIONS)
    get_source_file_property(alone "${source}" SKIP_UNITY_BUILD_INCLUSION)
    get_filename_component(path "${source}" ABSOLUTE)
    file(RELATIVE_PATH path "${PROJECT_SOURCE_DIR}" "${path}")
    string(FIND "${source}" "${PROJECT_BINARY_DIR}" generated)
    if(options OR definitions OR alone OR generated EQUAL 0 OR NOT path MATCHES "\\.cpp$")
      list(APPEND kept "${source}")
      continue()
    endif()
    get_filename_component(folder "${path}" DIRECTORY)
    string(MAKE_C_IDENTIFIER "${folder}" group)
    list(APPEND groups ${group})
    list(APPEND files_${group} "${path}")
  endforeach()
  list(REMOVE_DUPLICATES groups)
  foreach(group IN LISTS groups)
    list(TRANSFORM files_${group} REPLACE "(.+)" "#include \"\\1\"\n"
      OUTPUT_VARIABLE includes)
    string(CONCAT text ${includes})
    set(unit "${CMAKE_CURRENT_BINARY_DIR}/${target}_units/${group}.cpp")
    file(WRITE "${unit}.in" "${text}")
    configure_file("${unit}.in" "${unit}" COPYONLY) # written where it differs
    list(APPEND kept "${unit}")
  endforeach()
  set_target_properties(${target} PROPERTIES SOURCES "${kept}")
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}")
endfunction()
