# SPDX-License-Identifier: Apache-2.0
# Instruction-set levels: what is built (TENNIEL_ISA_LEVELS) and how one level is compiled.

# v2 has no registers of 256 bits and v3 none of 512, so how functions pass the sampler's vectors
# depends on the level: no matter, as a level calls only what was compiled for it.
set(TENNIEL_ISA_FLAGS_v2 -march=x86-64-v2 -Wno-psabi)
set(TENNIEL_ISA_FLAGS_v3 -march=x86-64-v3 -Wno-psabi)
# 256-bit vectors on v4 too: the wide ones lower the clock and scalar shading gains nothing.
set(TENNIEL_ISA_FLAGS_v4 -march=x86-64-v4 -mprefer-vector-width=256)

if(TENNIEL_ISA STREQUAL "native")
  file(READ /proc/cpuinfo cpuinfo LIMIT 8000)
  if(cpuinfo MATCHES " avx512f.* avx512bw.* avx512vl")
    set(TENNIEL_ISA_LEVELS v4)
  elseif(cpuinfo MATCHES " fma " AND cpuinfo MATCHES " avx2 " AND cpuinfo MATCHES " bmi2 ")
    set(TENNIEL_ISA_LEVELS v3)
  else()
    set(TENNIEL_ISA_LEVELS v2)
  endif()
else()
  set(TENNIEL_ISA_LEVELS ${TENNIEL_ISA})
endif()

# Names of modules become those of their libraries on this level; other names pass through.
function(tenniel_libraries out level)
  set(libraries "")
  foreach(name IN LISTS ARGN)
    if(name IN_LIST TENNIEL_MODULES)
      set(name tenniel_${name}_${level})
    endif()
    list(APPEND libraries ${name})
  endforeach()
  set(${out} ${libraries} PARENT_SCOPE)
endfunction()

function(tenniel_add_core level)
  foreach(module IN LISTS TENNIEL_MODULES)
    set(library tenniel_${module}_${level})
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${module}/*.cpp)
    list(FILTER sources EXCLUDE REGEX "_(test|bench)\\.cpp$")
    tenniel_libraries(links ${level} ${TENNIEL_LINKS_${module}})
    if(sources)
      add_library(${library} STATIC ${sources})
      set(scope PUBLIC)
    else()
      add_library(${library} INTERFACE)
      set(scope INTERFACE)
    endif()
    target_include_directories(${library} ${scope} ${CMAKE_CURRENT_SOURCE_DIR})
    target_compile_options(${library} ${scope} ${TENNIEL_ISA_FLAGS_${level}})
    target_link_libraries(${library} ${scope} tenniel_flags ${links})
  endforeach()

  file(GLOB bindings CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/bindings/*.cpp)
  if(bindings)
    pybind11_add_module(_core_${level} MODULE NO_EXTRAS ${bindings})
    target_compile_definitions(_core_${level} PRIVATE
      TENNIEL_MODULE=_core_${level} TENNIEL_ISA_LEVEL="${level}" TENNIEL_VERSION="${PROJECT_VERSION}")
    target_link_libraries(_core_${level} PRIVATE tenniel_render_${level})
  endif()
endfunction()

# One executable a module, so that a change in one is tested without linking the rest again.
function(tenniel_add_tests level)
  add_custom_target(unit_tests)
  foreach(module IN LISTS TENNIEL_MODULES)
    file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${module}/*_test.cpp)
    if(tests)
      add_executable(${module}_test ${tests})
      target_link_libraries(${module}_test PRIVATE tenniel_${module}_${level} GTest::gtest_main)
      add_dependencies(unit_tests ${module}_test)
      # Suites named *Statistics* draw many samples; everything else is quick.
      gtest_discover_tests(${module}_test DISCOVERY_TIMEOUT 60
        TEST_FILTER "-*Statistics*" PROPERTIES LABELS unit)
      gtest_discover_tests(${module}_test DISCOVERY_TIMEOUT 60
        TEST_FILTER "*Statistics*" PROPERTIES LABELS statistics TEST_LIST ${module}_statistics)
    endif()
  endforeach()
  add_executable(compile_bench EXCLUDE_FROM_ALL ${CMAKE_CURRENT_SOURCE_DIR}/scene/compile_bench.cpp)
  target_link_libraries(compile_bench PRIVATE tenniel_scene_${level})
  add_executable(path_bench EXCLUDE_FROM_ALL ${CMAKE_CURRENT_SOURCE_DIR}/render/path_bench.cpp)
  target_link_libraries(path_bench PRIVATE tenniel_render_${level})
endfunction()
