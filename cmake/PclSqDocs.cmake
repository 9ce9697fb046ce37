# SPDX-License-Identifier: BSD-3-Clause
# What is to be read: README, docs and examples; manual pages and bash completion of the
# programs; with PCL_SQ_BUILD_DOCS the API reference.
set(doc_dir "${CMAKE_INSTALL_DATADIR}/doc/pcl_sq")
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff
  DESTINATION "${doc_dir}" COMPONENT doc)
install(DIRECTORY docs examples DESTINATION "${doc_dir}" COMPONENT doc
  PATTERN "Doxyfile" EXCLUDE PATTERN "*.dox" EXCLUDE PATTERN "conf.py" EXCLUDE)
install(FILES benchmarks/README.md DESTINATION "${doc_dir}/benchmarks" COMPONENT doc)

if(PCL_SQ_BUILD_DOCS)
  find_package(Doxygen REQUIRED)
  file(READ "${PROJECT_SOURCE_DIR}/docs/Doxyfile" doxyfile)
  string(APPEND doxyfile "
OUTPUT_DIRECTORY = \"${generated}/reference\"
PROJECT_NUMBER = ${PROJECT_VERSION}\n")
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr") # Debian's own, not one from the net
    string(APPEND doxyfile "MATHJAX_RELPATH = file:///usr/share/javascript/mathjax\n")
  endif()
  file(WRITE "${generated}/Doxyfile.new" "${doxyfile}")
  configure_file("${generated}/Doxyfile.new" "${generated}/Doxyfile" COPYONLY)
  file(GLOB_RECURSE described CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/include/*.h"
    "${PROJECT_SOURCE_DIR}/docs/*.md" "${PROJECT_SOURCE_DIR}/docs/*.dox")
  add_custom_command(OUTPUT "${generated}/reference/html/index.html"
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${generated}/reference"
    COMMAND Doxygen::doxygen "${generated}/Doxyfile"
    DEPENDS ${described} README.md CONTRIBUTING.md benchmarks/README.md "${generated}/Doxyfile"
    WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" COMMENT "API reference" VERBATIM)
  add_custom_target(pcl_sq_reference ALL DEPENDS "${generated}/reference/html/index.html")
  install(DIRECTORY "${generated}/reference/html" DESTINATION "${doc_dir}" COMPONENT doc)
endif()

get_property(programs GLOBAL PROPERTY PCL_SQ_PROGRAMS)
find_program(HELP2MAN help2man)
find_program(GZIP gzip)
if(programs AND HELP2MAN AND GZIP AND NOT CMAKE_CROSSCOMPILING)
  set(pages "")
  foreach(program IN LISTS programs)
    set(page "${generated}/man/${program}.1.gz")
    add_custom_command(OUTPUT "${page}"
      COMMAND "${CMAKE_COMMAND}" -E make_directory "${generated}/man"
      COMMAND "${PROJECT_SOURCE_DIR}/cmake/man_page.sh" $<TARGET_FILE:${program}> "${page}"
      DEPENDS ${program} cmake/man_page.sh VERBATIM)
    list(APPEND pages "${page}")
  endforeach()
  add_custom_target(pcl_sq_man ALL DEPENDS ${pages})
  install(FILES ${pages} DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT apps)
endif()

if(programs)
  set(completions "${generated}/completions")
  list(JOIN programs " " words)
  set(joined "${programs}")
  set(programs "${words}")
  configure_file("${CMAKE_CURRENT_LIST_DIR}/pcl_sq_completion.bash.in"
    "${completions}/pcl_sq_fit" @ONLY)
  set(programs "${joined}")
  # bash looks for a file with the command's name
  foreach(program IN LISTS programs)
    if(NOT program STREQUAL "pcl_sq_fit")
      file(CREATE_LINK pcl_sq_fit "${completions}/${program}" SYMBOLIC)
    endif()
  endforeach()
  install(DIRECTORY "${completions}" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion"
    COMPONENT apps)
endif()
