# One helper for every target: standard, warnings, precompiled header, sanitizers and clang-tidy are set here alone.

option(HOMEWARD_ASAN "Address and undefined behaviour sanitizers" OFF)
option(HOMEWARD_TSAN "Thread sanitizer" OFF)
option(HOMEWARD_TIDY "Run clang-tidy on every source" OFF)
option(HOMEWARD_NATIVE "Use the instructions of this machine's processor" OFF)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env
      # The same sources in another folder are the same: a fresh clone finds what was compiled before.
      CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}
      CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      ${CCACHE_PROGRAM})
endif()

# Each test is a program of its own: with the usual linker, linking them takes minutes.
find_program(MOLD_PROGRAM mold)
if(MOLD_PROGRAM)
  add_link_options(-fuse-ld=mold)
endif()

add_library(homeward_options INTERFACE)
target_compile_features(homeward_options INTERFACE cxx_std_20)
target_compile_options(
  homeward_options
  INTERFACE -Wall
            -Wextra
            -Wpedantic
            -Wshadow
            -Wnon-virtual-dtor
            -Wold-style-cast
            -Woverloaded-virtual
            -Werror
            # False alarms of GCC 12's optimiser inside the standard library's string and Eigen (GCC PR 105329, 105651).
            $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-maybe-uninitialized>
            -fno-math-errno
            -ffp-contract=off)
target_compile_definitions(homeward_options INTERFACE BOOST_ASIO_SEPARATE_COMPILATION
                                                      BOOST_BEAST_SEPARATE_COMPILATION)
target_include_directories(homeward_options INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
if(HOMEWARD_NATIVE)
  target_compile_options(homeward_options INTERFACE -march=native)
endif()
if(HOMEWARD_ASAN)
  target_compile_options(homeward_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                                    -fno-omit-frame-pointer)
  target_link_options(homeward_options INTERFACE -fsanitize=address,undefined)
  # Eigen allocates in another way under the sanitizer; what OpenGV's library allocated has to be freed as it was.
  target_compile_definitions(homeward_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
if(HOMEWARD_TSAN)
  # GCC warns that atomic_thread_fence is not modelled; Asio uses it.
  target_compile_options(homeward_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer -Wno-tsan)
  target_link_options(homeward_options INTERFACE -fsanitize=thread)
endif()

# Headers that nearly every source reads, compiled once; and once with what every test reads besides.
file(WRITE ${PROJECT_BINARY_DIR}/pch.cpp "// only a carrier of the precompiled header\n")
set(homeward_common_headers
  <algorithm>
  <array>
  <cmath>
  <cstdint>
  <functional>
  <map>
  <memory>
  <optional>
  <span>
  <string>
  <unordered_map>
  <utility>
  <variant>
  <vector>
  <tl/expected.hpp>
  <Eigen/Core>
  <Eigen/Geometry>)
add_library(homeward_pch OBJECT ${PROJECT_BINARY_DIR}/pch.cpp)
target_link_libraries(homeward_pch PRIVATE homeward_options Eigen3::Eigen Threads::Threads)
target_precompile_headers(homeward_pch PRIVATE ${homeward_common_headers})
if(HOMEWARD_TESTS)
  add_library(homeward_test_pch OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/pch.cpp)
  target_link_libraries(homeward_test_pch PRIVATE homeward_options Eigen3::Eigen Threads::Threads GTest::gtest
                                                  GTest::gmock)
  target_precompile_headers(homeward_test_pch PRIVATE ${homeward_common_headers} <gmock/gmock.h> <gtest/gtest.h>
                            <nlohmann/json.hpp>)
endif()

function(_homeward_finish target)
  cmake_parse_arguments(ARG "" "HEADERS" "" ${ARGN})
  if(NOT ARG_HEADERS)
    set(ARG_HEADERS homeward_pch)
  endif()
  target_link_libraries(${target} PRIVATE homeward_options Eigen3::Eigen Threads::Threads)
  target_precompile_headers(${target} REUSE_FROM ${ARG_HEADERS})
  if(HOMEWARD_TIDY)
    set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY ${PROJECT_SOURCE_DIR}/cmake/tidy.sh)
  endif()
endfunction()

# homeward_add_library(name SOURCES a.cpp ... [PUBLIC targets] [PRIVATE targets]): target homeward_<name>, alias
# homeward::<name>. Without sources it is headers only.
function(homeward_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  if(ARG_SOURCES)
    add_library(homeward_${name} STATIC ${ARG_SOURCES})
    target_include_directories(homeward_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
    target_link_libraries(homeward_${name} PUBLIC Eigen3::Eigen ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
    _homeward_finish(homeward_${name})
  else()
    add_library(homeward_${name} INTERFACE)
    target_include_directories(homeward_${name} INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
    target_link_libraries(homeward_${name} INTERFACE Eigen3::Eigen ${ARG_PUBLIC})
  endif()
  add_library(homeward::${name} ALIAS homeward_${name})
endfunction()

# homeward_without_thread_sanitizer(kernel.cpp ...): sources of this folder that only compute from what they are given,
# share nothing, and take most of the time of every picture: watching each of their reads makes the server's tests
# four times slower. A race on what they are given is seen only where their callers touch it too.
function(homeward_without_thread_sanitizer)
  if(HOMEWARD_TSAN)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -fno-sanitize=thread SKIP_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# homeward_add_program(homeward-server SOURCES main.cpp LINK targets)
function(homeward_add_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  _homeward_finish(${name})
endfunction()

# What the sanitizer builds need: all unit tests, or the server's alone.
add_custom_target(unit_tests)
add_custom_target(server_tests)

# homeward_add_test_support(http SOURCES a.cpp ... LINK targets): a library that several test programs share, target
# homeward_test_<name>: what is dear to compile is compiled once.
function(homeward_add_test_support name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  set(target homeward_test_${name})
  add_library(${target} STATIC EXCLUDE_FROM_ALL ${ARG_SOURCES})
  target_link_libraries(${target} PUBLIC ${ARG_LINK})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/tests)
  _homeward_finish(${target})
endfunction()

# homeward_add_test(camera/mirror SOURCES mirror_test.cpp LINK targets [LABELS unit]): a GoogleTest program that is one
# ctest entry named "camera/mirror".
function(homeward_add_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LINK;LABELS" ${ARGN})
  string(REPLACE "/" "_" target "test_${name}")
  add_executable(${target} ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE ${ARG_LINK} homeward_test_folders GTest::gtest GTest::gmock GTest::gtest_main)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  _homeward_finish(${target} HEADERS homeward_test_pch)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  add_test(NAME ${name} COMMAND ${target})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT})
  if("unit" IN_LIST ARG_LABELS)
    add_dependencies(unit_tests ${target})
  endif()
  if(name MATCHES "^server/")
    add_dependencies(server_tests ${target})
  endif()
endfunction()
