# Warnings for our own targets only; never exported to users.
function(pcl_sq_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast
    $<$<BOOL:${PCL_SQ_WERROR}>:-Werror>)
endfunction()
