# One interface target carries the language level, the warnings and the floating-point rules of every target.
add_library(rtu_options INTERFACE)
target_compile_features(rtu_options INTERFACE cxx_std_20)
set(CMAKE_CXX_EXTENSIONS OFF)
target_compile_options(rtu_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Wold-style-cast
  $<$<BOOL:${RTUSIM_WERROR}>:-Werror>
  # Contraction into fused multiply-add breaks watertightness and equality between machines.
  -ffp-contract=off)
target_include_directories(rtu_options INTERFACE ${CMAKE_SOURCE_DIR})

# rtu_compile_together(TARGET): compiles the sources of a folder several at a time. What they include costs the compiler
# more than what they say, so a whole build takes half the time. Names must be unique within a folder.
function(rtu_compile_together target)
  if(NOT RTUSIM_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  foreach(source IN LISTS sources)
    get_filename_component(folder "${source}" DIRECTORY)
    string(MAKE_C_IDENTIFIER "in_${folder}" folder)
    math(EXPR group "0${${folder}_count} / 8")
    math(EXPR ${folder}_count "0${${folder}_count} + 1")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP ${folder}_${group})
  endforeach()
endfunction()

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
