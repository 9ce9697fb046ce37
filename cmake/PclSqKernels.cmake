# Inner loops on plain floats, one file per instruction set. Only these files get flags
# for wide registers: they see neither Eigen nor PCL, whose layout depends on such flags.
set(kernel_dir "${PROJECT_SOURCE_DIR}/src/kernels")
set(kernel_sources "${kernel_dir}/dispatch.cpp" "${kernel_dir}/kernel_portable.cpp")
set(kernel_flags -O3 -ffp-contract=fast -fno-math-errno -fno-trapping-math
  -fno-signed-zeros -ffinite-math-only)
set(kernel_portable_flags)
set(kernel_sse2_flags)
set(kernel_avx2_flags -mavx2 -mfma)
set(kernel_avx512_flags -mavx512f -mavx512dq -mavx512vl -mavx512bw -mfma
  -mprefer-vector-width=512)
set(kernel_names portable)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64")
  list(APPEND kernel_names sse2 avx2 avx512)
endif()
foreach(name IN LISTS kernel_names)
  set(kernel_file "${kernel_dir}/kernel_${name}.cpp")
  list(APPEND kernel_sources "${kernel_file}")
  set_source_files_properties("${kernel_file}" PROPERTIES
    COMPILE_OPTIONS "${kernel_flags};${kernel_${name}_flags}")
endforeach()
list(REMOVE_DUPLICATES kernel_sources)
