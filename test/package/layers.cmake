# SPDX-License-Identifier: BSD-3-Clause
# Includes go downwards only: geometry and solver see Eigen and std, elements and pipeline
# PCL, stereo OpenCV; VTK is in no header, OpenMP and iostream in no public one.
set(failures "")

# forbid(WHAT REGEX FILES...): no file includes what matches the expression
function(forbid what regex)
  foreach(file IN LISTS ARGN)
    file(STRINGS "${file}" includes REGEX "^[ \t]*#[ \t]*include")
    list(FILTER includes INCLUDE REGEX "[<\"](${regex})")
    if(includes)
      file(RELATIVE_PATH name "${root}" "${file}")
      list(JOIN includes ", " includes)
      set(failures "${failures}\n${name} (${what}): ${includes}" PARENT_SCOPE)
      set(failures "${failures}\n${name} (${what}): ${includes}")
    endif()
  endforeach()
endfunction()

set(public "${root}/include/pcl_sq")
# layers 3 and 4: the class templates, and what else has a PCL base class
file(GLOB elements "${public}/impl/*.hpp")
list(TRANSFORM elements REPLACE ".*/(.*)\\.hpp$" "\\1")
list(APPEND elements exception point_grasp polygon_mesh)
list(JOIN elements "|" elements)

file(GLOB core_headers "${public}/*.h" "${public}/impl/*.hpp")
# from the lowest folder to the highest; each includes those before it only
set(folders util tuning kernels geometry union mesh solver fit paper sensor table observe
  view_problem families view_fit pieces outlines parts quality grasp io export elements patches scene)
set(core_files "")
set(above ${folders})
foreach(folder IN LISTS folders)
  list(REMOVE_ITEM above ${folder})
  list(JOIN above "|" higher)
  file(GLOB files "${root}/src/${folder}/*.h" "${root}/src/${folder}/*.cpp")
  if(NOT files)
    message(FATAL_ERROR "src/${folder} is empty: the check would be, too.")
  endif()
  list(LENGTH files count)
  if(count GREATER 14)
    set(failures "${failures}\nsrc/${folder} has ${count} files, more than a screen shows")
  endif()
  if(above)
    forbid("${folder} is below them" "(${higher})/" ${files})
  endif()
  list(APPEND core_files ${files})
endforeach()
file(GLOB present RELATIVE "${root}/src" "${root}/src/*")
list(REMOVE_ITEM present ${folders} stereo visualization CMakeLists.txt)
if(present)
  set(failures "${failures}\nnot in the order of folders: ${present}")
endif()
file(GLOB_RECURSE all_headers "${public}/*.h" "${public}/*.hpp")

set(mathematics ${core_headers})
list(FILTER mathematics EXCLUDE REGEX "/impl/|/(${elements})\\.h$")
forbid("layers 1-2 see Eigen and std only" "pcl/" ${mathematics})
forbid("layers 1-2 are below the elements" "pcl_sq/(impl/|(${elements})\\.h)" ${mathematics})

set(below_pipeline ${core_headers})
list(FILTER below_pipeline EXCLUDE REGEX "(object_surface|scene)_estimation")
forbid("the pipeline is the top of core" "pcl_sq/(object_surface|scene)_estimation" ${below_pipeline})

forbid("core is below stereo and visualization"
  "pcl_sq/stereo|pcl_sq/visualization|opencv|vtk" ${core_headers} ${core_files})
# but for the class that is one of PCL's segmentation, which has a header alone
set(without_segmentation ${core_headers} ${core_files})
list(FILTER without_segmentation EXCLUDE REGEX "/superquadric_segmentation\\.")
forbid("core never needs PCL's io or segmentation" "pcl/(io|segmentation|visualization)/"
  ${without_segmentation})
forbid("a user's own viewer has a header of its own"
  "pcl/visualization/|pcl_sq/visualization/pcl_visualizer" ${core_headers} ${core_files})
forbid("not in public headers" "vtk|omp\\.h|iostream|nlohmann" ${all_headers})

file(GLOB_RECURSE stereo "${public}/stereo/*" "${root}/src/stereo/*")
forbid("stereo and visualization stand side by side" "pcl_sq/visualization|vtk" ${stereo})
file(GLOB_RECURSE visualization "${public}/visualization/*" "${root}/src/visualization/*")
forbid("stereo and visualization stand side by side" "pcl_sq/stereo|opencv"
  ${visualization})

if(NOT core_headers OR NOT mathematics)
  message(FATAL_ERROR "No headers found below ${root}: the check would be empty.")
endif()
if(failures)
  message(FATAL_ERROR "Includes that go upwards:${failures}")
endif()
