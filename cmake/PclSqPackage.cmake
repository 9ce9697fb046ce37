# SPDX-License-Identifier: BSD-3-Clause
# What a user's build needs to find the module: headers, package config and pkg-config
# files of each component that was built; documentation; Debian packages (cpack -G DEB).
include(CMakePackageConfigHelpers)

get_property(components GLOBAL PROPERTY PCL_SQ_COMPONENTS)
set(config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/pcl_sq")
set(generated "${PROJECT_BINARY_DIR}/package")

# pkg-config and CPack move the prefix, so the files find it from where they lie
file(RELATIVE_PATH PC_PREFIX
  "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
file(RELATIVE_PATH PC_LIBDIR "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_LIBDIR}")
file(RELATIVE_PATH PC_INCLUDEDIR
  "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_INCLUDEDIR}")

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/pcl_sqConfig.cmake.in"
  "${generated}/pcl_sqConfig.cmake" INSTALL_DESTINATION "${config_dir}"
  NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file("${generated}/pcl_sqConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${generated}/pcl_sqConfig.cmake" "${generated}/pcl_sqConfigVersion.cmake"
  DESTINATION "${config_dir}" COMPONENT core_dev)
install(FILES "${PROJECT_SOURCE_DIR}/package.xml"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/pcl_sq" COMPONENT core_dev)

foreach(name IN LISTS components)
  if(name STREQUAL "core")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/pcl_sq"
      DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT core_dev
      FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp"
      PATTERN "stereo" EXCLUDE PATTERN "visualization" EXCLUDE)
    install(FILES "${PROJECT_BINARY_DIR}/include/pcl_sq/config.h"
      DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/pcl_sq" COMPONENT core_dev)
  else()
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/pcl_sq/${name}"
      DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/pcl_sq" COMPONENT ${name}_dev
      FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
  endif()

  get_property(dependencies GLOBAL PROPERTY PCL_SQ_${name}_FIND)
  set(lines "")
  foreach(dependency IN LISTS dependencies)
    string(APPEND lines "find_dependency(${dependency})\n")
  endforeach()
  file(WRITE "${generated}/pcl_sq_${name}_dependencies.cmake" "${lines}")

  get_property(PC_REQUIRES GLOBAL PROPERTY PCL_SQ_${name}_PKGCONFIG)
  if(NOT name STREQUAL "core")
    list(PREPEND PC_REQUIRES "pcl_sq_core = ${PROJECT_VERSION}")
  endif()
  list(JOIN PC_REQUIRES ", " PC_REQUIRES)
  get_property(PC_LIBS_PRIVATE GLOBAL PROPERTY PCL_SQ_${name}_STATIC_LIBS)
  list(JOIN PC_LIBS_PRIVATE " " PC_LIBS_PRIVATE)
  configure_file("${CMAKE_CURRENT_LIST_DIR}/pcl_sq.pc.in"
    "${generated}/pcl_sq_${name}.pc" @ONLY)

  install(FILES "${generated}/pcl_sq_${name}_dependencies.cmake"
    DESTINATION "${config_dir}" COMPONENT ${name}_dev)
  install(FILES "${generated}/pcl_sq_${name}.pc"
    DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT ${name}_dev)
endforeach()

include(PclSqDocs)
if(top_level)
  include(PclSqDebian)
endif()
