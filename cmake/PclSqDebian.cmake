# SPDX-License-Identifier: BSD-3-Clause
# Debian packages: libpcl-sq-NAME with the ABI's version (the library) and libpcl-sq-NAME-dev
# (headers, package config, pkg-config) per component, pcl-sq-apps (the programs) and
# libpcl-sq-doc. A machine that only runs a program needs no development package.
# `cpack -G DEB` in the build folder makes them, see debian_build.cmake.in.
set(CPACK_PACKAGE_NAME pcl-sq)
set(CPACK_PACKAGE_VENDOR "pcl_sq contributors")
set(CPACK_PACKAGE_CONTACT "pcl_sq contributors <pcl-sq@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
configure_file("${CMAKE_CURRENT_LIST_DIR}/debian_build.cmake.in"
  "${generated}/debian_build.cmake" @ONLY)
set(CPACK_PROJECT_CONFIG_FILE "${generated}/debian_build.cmake")
set(CPACK_COMPONENTS_ALL "")

# the files that policy wants in every package
set(debian "${generated}/debian")
file(READ "${PROJECT_SOURCE_DIR}/LICENSE" license)
string(REGEX MATCH "Copyright \\(c\\) [^\n]*" copyright "${license}")
string(REPLACE "Copyright (c) " "" copyright "${copyright}")
string(REGEX REPLACE "^.*All rights reserved\\.\n+" "" license "${license}")
string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
string(REGEX REPLACE "\n$" "" license "${license}")
string(REPLACE "\n" "\n " license "${license}")
file(WRITE "${debian}/copyright"
  "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: ${PROJECT_NAME}

Files: *
Copyright: ${copyright}
License: BSD-3-Clause

License: BSD-3-Clause
 ${license}\n")
file(WRITE "${debian}/triggers" "activate-noawait ldconfig\n")
# the day of the newest release in CHANGELOG.md
file(STRINGS "${PROJECT_SOURCE_DIR}/CHANGELOG.md" release LIMIT_COUNT 1
  REGEX "^## \\[[0-9.]+\\] - [0-9-]+")
string(REGEX MATCH "[0-9]+-[0-9]+-[0-9]+" day "${release}")
find_program(GZIP gzip)
execute_process(COMMAND date -R -u -d "${day} 12:00 UTC" OUTPUT_VARIABLE day
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(changelog "")
if(GZIP AND day)
  set(changelog "${debian}/changelog.Debian.gz")
  file(WRITE "${debian}/changelog.Debian"
    "pcl-sq (${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * Release ${PROJECT_VERSION}: see CHANGELOG.md in libpcl-sq-doc.

 -- ${CPACK_PACKAGE_CONTACT}  ${day}\n")
  execute_process(COMMAND "${GZIP}" -9nf "${debian}/changelog.Debian")
endif()

# pcl_sq_debian(INSTALL_COMPONENT PACKAGE SECTION DESCRIPTION DEPENDS...)
macro(pcl_sq_debian install_component package section description)
  list(APPEND CPACK_COMPONENTS_ALL ${install_component})
  string(TOUPPER ${install_component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  # below the first line, which is the project's description
  set(CPACK_COMPONENT_${upper}_DESCRIPTION
    "A point cloud or a stereo pair in; a union of superquadrics, a closed mesh\nand \
points to grasp at out. This package holds the ${description}.")
  string(REPLACE ";" ", " CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${ARGN}")
  install(FILES "${debian}/copyright" ${changelog}
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}"
    COMPONENT ${install_component} EXCLUDE_FROM_ALL)
endmacro()

set(same_version "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(abi ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(libraries "")
set(all_recommended "")
foreach(name IN LISTS components)
  set(package libpcl-sq-${name})
  get_property(headers_need GLOBAL PROPERTY PCL_SQ_${name}_DEBIAN)
  set(core "")
  set(core_dev "")
  if(NOT name STREQUAL "core")
    set(core "libpcl-sq-core${abi} ${same_version}")
    set(core_dev "libpcl-sq-core-dev ${same_version}")
  endif()
  pcl_sq_debian(${name} ${package}${abi} libs "shared library of the\ncomponent ${name}" ${core})
  string(TOUPPER ${name} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA "${debian}/triggers")
  get_property(recommended GLOBAL PROPERTY PCL_SQ_${name}_RECOMMENDS)
  if(recommended)
    string(REPLACE ";" ", " CPACK_DEBIAN_${upper}_PACKAGE_RECOMMENDS "${recommended}")
    list(APPEND all_recommended ${recommended})
  endif()
  pcl_sq_debian(${name}_dev ${package}-dev libdevel "headers of the\ncomponent ${name}"
    "${package}${abi} ${same_version}" ${core_dev} ${headers_need})
  list(APPEND libraries "${package}${abi} ${same_version}")
endforeach()
if(PCL_SQ_BUILD_APPS)
  pcl_sq_debian(apps pcl-sq-apps science "programs" ${libraries})
endif()
if(PCL_SQ_BUILD_PYTHON)
  get_property(minor GLOBAL PROPERTY PCL_SQ_PYTHON_MINOR)
  math(EXPR next "${minor} + 1") # extensions are of one version of Python
  # it holds the libraries itself: one file to hand to someone who writes Python alone
  pcl_sq_debian(python python3-pcl-sq python "Python\nmodule pcl_sq"
    "python3 (>= 3.${minor})" "python3 (<< 3.${next})" python3-numpy)
  list(JOIN all_recommended ", " CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-distributed, python3-open3d")
endif()
pcl_sq_debian(doc libpcl-sq-doc doc "documentation, the\nexamples and the API reference")
set(CPACK_DEBIAN_DOC_PACKAGE_RECOMMENDS libjs-mathjax)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
include(CPack)
