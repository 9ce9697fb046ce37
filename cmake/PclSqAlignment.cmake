# The library's Eigen alignment, stored in config.h and asserted in the user's code: PCL
# crashes when its own and the user's alignment differ.
file(WRITE "${PROJECT_BINARY_DIR}/alignment.cpp"
  "#include <Eigen/Core>\n#include <cstdio>\n"
  "int main() { std::printf(\"%d\", EIGEN_MAX_ALIGN_BYTES); }\n")
if(NOT DEFINED PCL_SQ_EIGEN_ALIGNMENT)
  get_target_property(eigen_include Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  try_run(ran built "${PROJECT_BINARY_DIR}/alignment" "${PROJECT_BINARY_DIR}/alignment.cpp"
    CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${eigen_include}"
    RUN_OUTPUT_VARIABLE alignment)
  if(NOT built)
    message(FATAL_ERROR "Eigen's alignment could not be determined: is Eigen installed?")
  endif()
  set(PCL_SQ_EIGEN_ALIGNMENT "${alignment}" CACHE INTERNAL "EIGEN_MAX_ALIGN_BYTES")
endif()
