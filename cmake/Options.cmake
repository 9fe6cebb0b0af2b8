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

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
