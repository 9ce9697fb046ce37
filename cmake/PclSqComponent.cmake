# SPDX-License-Identifier: BSD-3-Clause
# pcl_sq_component(NAME SOURCES ... [PUBLIC libs...] [PRIVATE libs...]
#   [FIND args...] [PRIVATE_FIND args...] [STATIC_LIBS flags...] [PKGCONFIG modules...]
#   [DEBIAN packages...] [RECOMMENDS packages...])
# One library libpcl_sq_NAME, target pcl_sq::NAME, with an export set of its own (its
# target proper is pcl_sq_NAME_library: pcl_sq_stereo is a program). Its objects are a
# target too, pcl_sq_NAME_objects: unit tests link them and so see what the library hides.
# FIND, PKGCONFIG and DEBIAN name what a user of the component's headers needs: one quoted
# argument list of find_dependency() each, modules of pkg-config, packages of Debian.
# PRIVATE_FIND, STATIC_LIBS: what the library itself links, as a user of a static one finds
# it by find_dependency() and by pkg-config.
# RECOMMENDS: Debian packages that the library itself uses where they are installed.
function(pcl_sq_component name)
  cmake_parse_arguments(ARG "" ""
    "SOURCES;PUBLIC;PRIVATE;FIND;PRIVATE_FIND;STATIC_LIBS;PKGCONFIG;DEBIAN;RECOMMENDS"
    ${ARGN})
  set(target pcl_sq_${name}_library)
  set(objects pcl_sq_${name}_objects)
  add_library(${objects} OBJECT ${ARG_SOURCES})
  set_target_properties(${objects} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_definitions(${objects} PRIVATE PCL_SQ_BUILDING)
  target_include_directories(${objects} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${objects} PUBLIC ${ARG_PUBLIC} ${ARG_PRIVATE})
  pcl_sq_warnings(${objects})
  pcl_sq_units(${objects})

  add_library(${target} $<TARGET_OBJECTS:${objects}>)
  add_library(pcl_sq::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    OUTPUT_NAME pcl_sq_${name} EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} # the ABI's promise
    # a component finds core and its plug-ins beside it, whatever the prefix
    INSTALL_RPATH "$ORIGIN;$ORIGIN/${PCL_SQ_PLUG_IN_DIR}")
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  foreach(library ${target} ${objects})
    target_compile_features(${library} PUBLIC cxx_std_17)
    target_include_directories(${library} PUBLIC
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
      $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
      $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  endforeach()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    list(APPEND ARG_FIND ${ARG_PRIVATE_FIND})
  else()
    set(ARG_STATIC_LIBS "")
  endif()
  if(PCL_SQ_INSTALL)
    install(TARGETS ${target} EXPORT pcl_sq_${name}_targets
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        COMPONENT ${name} NAMELINK_COMPONENT ${name}_dev
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${name}_dev
      RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${name})
    install(EXPORT pcl_sq_${name}_targets NAMESPACE pcl_sq:: COMPONENT ${name}_dev
      DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/pcl_sq)
  endif()

  # read by PclSqPackage.cmake
  set_property(GLOBAL APPEND PROPERTY PCL_SQ_COMPONENTS ${name})
  foreach(property FIND STATIC_LIBS PKGCONFIG DEBIAN RECOMMENDS)
    set_property(GLOBAL PROPERTY PCL_SQ_${name}_${property} "${ARG_${property}}")
  endforeach()
endfunction()

# pcl_sq_plug_in(NAME COMPONENT USERS targets... SOURCES ... [COMMON ...] LIBS ...)
# What few runs of a shared library or a program need and takes long to load: a library
# pcl_sq_NAME.so that USERS load on first use (src/util/plug_in.h), installed with
# COMPONENT. Its objects are the target pcl_sq_NAME_objects, for tests.
# COMMON: sources of the component that the plug-in needs too, for libraries hide theirs.
function(pcl_sq_plug_in name component)
  cmake_parse_arguments(ARG "" "" "USERS;SOURCES;COMMON;LIBS" ${ARGN})
  set(objects pcl_sq_${name}_objects)
  add_library(${objects} OBJECT ${ARG_SOURCES})
  set_target_properties(${objects} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_definitions(${objects} PRIVATE PCL_SQ_BUILDING)
  target_include_directories(${objects} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${objects} PUBLIC ${ARG_LIBS})
  pcl_sq_warnings(${objects})
  pcl_sq_units(${objects})
  add_library(pcl_sq_${name} MODULE $<TARGET_OBJECTS:${objects}> ${ARG_COMMON})
  target_compile_definitions(pcl_sq_${name} PRIVATE PCL_SQ_BUILDING)
  target_include_directories(pcl_sq_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  pcl_sq_warnings(pcl_sq_${name})
  set_target_properties(pcl_sq_${name} PROPERTIES PREFIX ""
    LIBRARY_OUTPUT_DIRECTORY "${PCL_SQ_PLUG_IN_BUILD_DIR}" INSTALL_RPATH "$ORIGIN/..")
  target_link_libraries(pcl_sq_${name} PRIVATE ${ARG_LIBS})
  foreach(user ${ARG_USERS})
    target_compile_definitions(${user} PRIVATE PCL_SQ_PLUG_INS
      PCL_SQ_PLUG_IN_PATH="${CMAKE_INSTALL_FULL_LIBDIR}/${PCL_SQ_PLUG_IN_DIR}")
    add_dependencies(${user} pcl_sq_${name})
  endforeach()
  if(NOT component STREQUAL "apps")
    set_property(GLOBAL APPEND PROPERTY PCL_SQ_LIBRARY_PLUG_INS pcl_sq_${name})
  endif()
  if(PCL_SQ_INSTALL)
    install(TARGETS pcl_sq_${name} COMPONENT ${component}
      LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/${PCL_SQ_PLUG_IN_DIR}")
  endif()
endfunction()
