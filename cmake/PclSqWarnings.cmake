# Warnings for our own targets only; never exported to users.
function(pcl_sq_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast
    # PCL's macros of point types hold what clang's -Wpedantic tells of
    $<$<CXX_COMPILER_ID:Clang>:-Wno-gnu-anonymous-struct -Wno-nested-anon-types>
    $<$<BOOL:${PCL_SQ_WERROR}>:-Werror>)
endfunction()
