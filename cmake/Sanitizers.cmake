# rtu_sanitize_less(TARGET OPTION...): adds OPTIONs to TARGET where the sanitizers are on. The compiler spends most of
# its time there on checks; these options leave out what a target can do without.
function(rtu_sanitize_less target)
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=address")
    target_compile_options(${target} PRIVATE ${ARGN})
  endif()
endfunction()
