# One helper for every target: standard, warnings, precompiled header, sanitizers and clang-tidy are set here alone.

option(HOMEWARD_ASAN "Address and undefined behaviour sanitizers" OFF)
option(HOMEWARD_TSAN "Thread sanitizer" OFF)
option(HOMEWARD_FUZZ "Guide the fuzzing of tests/fuzz/targets by what is reached; needs Clang" OFF)
option(HOMEWARD_TIDY "Run clang-tidy on every source" OFF)
option(HOMEWARD_NATIVE "Use the instructions of this machine's processor" OFF)
option(HOMEWARD_BATCHES "Compile some sources of a folder at once" ON)

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

# With the usual linker, linking all the programs takes minutes.
find_program(MOLD_PROGRAM mold)
if(MOLD_PROGRAM)
  add_link_options(-fuse-ld=mold)
endif()

# Modules that the thread sanitizer does not watch. They compute from what they are given, start no thread, lock nothing
# and keep nothing that two threads could meet in (contract/unwatched holds that), and they take most of the time of every
# picture. A race on what they are given is seen where their callers touch it too. They are compiled just as in a release,
# so the compiler cache finds what was compiled for one in the other.
set(homeward_unwatched
    core
    geometry
    camera
    calibration
    imageio
    features
    tracking
    matching
    homing
    repeat)

# homeward_unwatched_options: all that every source is compiled with; homeward_options: and the thread sanitizer, for all
# but the modules above.
add_library(homeward_unwatched_options INTERFACE)
target_compile_features(homeward_unwatched_options INTERFACE cxx_std_20)
target_compile_options(
  homeward_unwatched_options
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
            -ffp-contract=off
            # Half a gigabyte before GCC looks for what it may forget: a tenth of its time otherwise.
            $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)
target_compile_definitions(homeward_unwatched_options INTERFACE BOOST_ASIO_SEPARATE_COMPILATION
                                                                BOOST_BEAST_SEPARATE_COMPILATION)
target_include_directories(homeward_unwatched_options INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
if(HOMEWARD_NATIVE)
  target_compile_options(homeward_unwatched_options INTERFACE -march=native)
endif()
if(HOMEWARD_ASAN)
  # Without checks that cost a third of the compiler's time where there are many templates: a null pointer, an overflown one and one
  # to too small an object are reported by the address sanitizer once they are used, and nothing in the sources points a
  # wider type at bytes (contract/casts holds that).
  target_compile_options(
    homeward_unwatched_options
    INTERFACE -fsanitize=address,undefined -fno-sanitize=null,object-size,pointer-overflow,alignment
              -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(homeward_unwatched_options INTERFACE -fsanitize=address,undefined)
  # Eigen allocates in another way under the sanitizer; what OpenGV's library allocated has to be freed as it was.
  target_compile_definitions(homeward_unwatched_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
if(HOMEWARD_FUZZ)
  # Clang warns of other things than the compiler that everything is made for.
  target_compile_options(homeward_unwatched_options INTERFACE -fsanitize=fuzzer-no-link -Wno-error)
endif()
add_library(homeward_options INTERFACE)
target_link_libraries(homeward_options INTERFACE homeward_unwatched_options)
if(HOMEWARD_TSAN)
  # Little optimised, with line numbers and assertions. GCC warns that atomic_thread_fence is not modelled; Asio uses it.
  set(homeward_watched_flags -O1 -g1 -UNDEBUG -fsanitize=thread -fno-omit-frame-pointer -Wno-tsan)
  target_compile_options(homeward_options INTERFACE ${homeward_watched_flags})
  target_link_options(homeward_options INTERFACE -fsanitize=thread)
endif()

# Headers that nearly every source reads, compiled once; once for the thread sanitizer, and once with what every test
# reads besides.
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
target_link_libraries(homeward_pch PRIVATE homeward_unwatched_options Eigen3::Eigen Threads::Threads)
target_precompile_headers(homeward_pch PRIVATE ${homeward_common_headers})
if(HOMEWARD_TSAN)
  add_library(homeward_watched_pch OBJECT ${PROJECT_BINARY_DIR}/pch.cpp)
  target_link_libraries(homeward_watched_pch PRIVATE homeward_options Eigen3::Eigen Threads::Threads)
  target_precompile_headers(homeward_watched_pch PRIVATE ${homeward_common_headers})
endif()
if(HOMEWARD_TESTS)
  add_library(homeward_test_pch OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/pch.cpp)
  target_link_libraries(homeward_test_pch PRIVATE homeward_options Eigen3::Eigen Threads::Threads GTest::gtest
                                                  GTest::gmock)
  set(homeward_test_headers ${homeward_common_headers} <gmock/gmock.h> <gtest/gtest.h> <nlohmann/json.hpp>)
  target_precompile_headers(homeward_test_pch PRIVATE ${homeward_test_headers})
  # The same for tests that compute little (homeward_add_tests): without optimising under the sanitizers.
  if(HOMEWARD_ASAN OR HOMEWARD_TSAN)
    add_library(homeward_plain_options INTERFACE)
    target_compile_options(homeward_plain_options INTERFACE -O0)
    add_library(homeward_plain_test_pch OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/pch.cpp)
    target_link_libraries(homeward_plain_test_pch PRIVATE homeward_options Eigen3::Eigen Threads::Threads GTest::gtest
                                                          GTest::gmock homeward_plain_options)
    target_precompile_headers(homeward_plain_test_pch PRIVATE ${homeward_test_headers})
  endif()
endif()

function(_homeward_finish target)
  cmake_parse_arguments(ARG "UNWATCHED" "HEADERS" "" ${ARGN})
  if(ARG_UNWATCHED)
    target_link_libraries(${target} PRIVATE homeward_unwatched_options)
  else()
    target_link_libraries(${target} PRIVATE homeward_options)
  endif()
  target_link_libraries(${target} PRIVATE Eigen3::Eigen Threads::Threads)
  if(NOT ARG_HEADERS)
    set(ARG_HEADERS homeward_pch)
    if(HOMEWARD_TSAN AND NOT ARG_UNWATCHED)
      set(ARG_HEADERS homeward_watched_pch)
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${ARG_HEADERS})
  if(HOMEWARD_TIDY)
    set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY ${PROJECT_SOURCE_DIR}/cmake/tidy.sh)
  endif()
endfunction()

# homeward_batches(result name size a.cpp ...): gives in `result` sources of the build that include `size` of these files of
# this folder each, so that headers that all of them read are compiled less often; all but what is generated, which is named
# by its whole path. Not CMake's own UNITY_BUILD: its sources name files by where they lie on this machine, so the compiler
# cache would find none of them in another folder.
function(homeward_batches result name size)
  set(files ${ARGN})
  if(NOT HOMEWARD_BATCHES OR size LESS 2)
    set(${result} ${files} PARENT_SCOPE)
    return()
  endif()
  set(sources ${files})
  list(FILTER sources INCLUDE REGEX "^/")
  list(FILTER files EXCLUDE REGEX "^/")
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(begin 0)
  list(LENGTH files count)
  while(begin LESS count)
    list(SUBLIST files ${begin} ${size} batch)
    list(TRANSFORM batch REPLACE "(.+)" "#include \"${folder}/\\1\"\n")
    string(JOIN "" text ${batch})
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}_${begin}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "${text}" @ONLY)
    list(APPEND sources ${source})
    math(EXPR begin "${begin} + ${size}")
  endwhile()
  set(${result} ${sources} PARENT_SCOPE)
endfunction()

# homeward_add_library(name SOURCES a.cpp ... [BATCH size] [ALONE b.cpp ...] [PUBLIC targets] [PRIVATE targets]): target
# homeward_<name>, alias homeward::<name>. BATCH: so many of SOURCES are compiled at once (homeward_batches), those of ALONE
# are not. Without sources it is headers only.
function(homeward_add_library name)
  cmake_parse_arguments(ARG "" "BATCH" "SOURCES;ALONE;PUBLIC;PRIVATE" ${ARGN})
  if(ARG_BATCH)
    homeward_batches(ARG_SOURCES homeward_${name} ${ARG_BATCH} ${ARG_SOURCES})
  endif()
  list(APPEND ARG_SOURCES ${ARG_ALONE})
  if(ARG_SOURCES)
    add_library(homeward_${name} STATIC ${ARG_SOURCES})
    target_include_directories(homeward_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
    target_link_libraries(homeward_${name} PUBLIC Eigen3::Eigen ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
    if(name IN_LIST homeward_unwatched)
      _homeward_finish(homeward_${name} UNWATCHED)
    else()
      _homeward_finish(homeward_${name})
    endif()
  else()
    add_library(homeward_${name} INTERFACE)
    target_include_directories(homeward_${name} INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
    target_link_libraries(homeward_${name} INTERFACE Eigen3::Eigen ${ARG_PUBLIC})
  endif()
  add_library(homeward::${name} ALIAS homeward_${name})
endfunction()

# homeward_watch(retrieval_index.cpp ...): sources of an unwatched module that the thread sanitizer watches all the same.
function(homeward_watch)
  if(HOMEWARD_TSAN)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${homeward_watched_flags}"
                                                   SKIP_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# homeward_add_program(homeward-server SOURCES main.cpp [BATCH size] LINK targets)
function(homeward_add_program name)
  cmake_parse_arguments(ARG "" "BATCH" "SOURCES;LINK" ${ARGN})
  if(ARG_BATCH)
    homeward_batches(ARG_SOURCES ${name} ${ARG_BATCH} ${ARG_SOURCES})
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  _homeward_finish(${name})
endfunction()
