# Tests: what several of them share, programs of GoogleTest files, and who has to give way to whom.

# What drives in real time needs a processor as soon as it wants one. On a machine that does nothing else, tests/run.sh lets
# all other tests run at the lowest of priorities and take what those leave, so both go on at once. (SCHED_IDLE; anybody may
# give up a priority. Beside other work they would hardly ever get a turn.)
option(HOMEWARD_TESTS_YIELD "Tests yield the processor to those that go in real time, and to everything else" OFF)
set(HOMEWARD_YIELDING "")
if(HOMEWARD_TESTS_YIELD)
  find_program(CHRT_PROGRAM chrt REQUIRED)
  set(HOMEWARD_YIELDING ${CHRT_PROGRAM} --idle 0)
endif()

# homeward_real_time(name ...): tests that go in real time, started without HOMEWARD_YIELDING. Where the others yield, one
# at a time beside them, and before them, as these take longest altogether; otherwise each alone.
function(homeward_real_time)
  if(HOMEWARD_TESTS_YIELD)
    set_tests_properties(${ARGN} PROPERTIES RESOURCE_LOCK real_time COST 1000)
  else()
    set_tests_properties(${ARGN} PROPERTIES RUN_SERIAL ON)
  endif()
endfunction()

# Every program of unit tests.
add_custom_target(unit_tests)

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

# homeward_add_tests(mapping FILES edges loops+closed_loops LINK targets [SLOW loops] [LABELS unit] [TIMEOUT seconds]
#                    [SOURCES helper.cpp] [REAL_TIME edges] [COMPUTES]): the GoogleTest program mapping_tests of this folder's
# edges_test.cpp, loops_test.cpp and closed_loops_test.cpp. Each of FILES is a ctest entry that runs that file's tests alone, here
# mapping/edges and mapping/loops, which runs two files. Unit tests that are not SLOW also have the label "fast".
# COMPUTES: the tests themselves work much out (pictures, scenes), so they are optimised under the sanitizers too.
function(homeward_add_tests module)
  cmake_parse_arguments(ARG "COMPUTES" "TIMEOUT" "FILES;LINK;SLOW;LABELS;SOURCES;REAL_TIME" ${ARGN})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 900)
  endif()
  set(target ${module}_tests)
  string(REPLACE "+" ";" files "${ARG_FILES}")
  foreach(named IN LISTS ARG_SLOW ARG_REAL_TIME)
    if(NOT named IN_LIST files)
      message(FATAL_ERROR "${target}: SLOW or REAL_TIME names ${named}, which is not among its FILES")
    endif()
  endforeach()

  # A file that nobody lists would be a test that nobody runs.
  file(GLOB tests_here CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
       ${CMAKE_CURRENT_SOURCE_DIR}/*_test.cpp)
  foreach(test IN LISTS tests_here)
    string(REPLACE "_test.cpp" "" test ${test})
    if(NOT test IN_LIST files)
      message(FATAL_ERROR "${target}: ${test}_test.cpp is not among its FILES")
    endif()
  endforeach()

  list(TRANSFORM files APPEND _test.cpp OUTPUT_VARIABLE sources)
  homeward_batches(batches ${target} 8 ${sources})
  add_executable(${target} ${batches} ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE ${ARG_LINK} homeward_test_folders homeward_test_main GTest::gtest
                                          GTest::gmock)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  if(ARG_COMPUTES OR NOT TARGET homeward_plain_options)
    _homeward_finish(${target} HEADERS homeward_test_pch)
  else()
    _homeward_finish(${target} HEADERS homeward_plain_test_pch)
    target_link_libraries(${target} PRIVATE homeward_plain_options)
  endif()
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  if("unit" IN_LIST ARG_LABELS)
    add_dependencies(unit_tests ${target})
  endif()

  foreach(entry IN LISTS ARG_FILES)
    string(REPLACE "+" ";" files ${entry})
    list(GET files 0 name)
    set(labels ${ARG_LABELS})
    if("unit" IN_LIST labels AND NOT name IN_LIST ARG_SLOW)
      list(APPEND labels fast)
    endif()
    list(TRANSFORM files REPLACE "(.+)" "--file=\\1_test.cpp")
    if(name IN_LIST ARG_REAL_TIME)
      add_test(NAME ${module}/${name} COMMAND ${target} ${files})
      homeward_real_time(${module}/${name})
    else()
      add_test(NAME ${module}/${name} COMMAND ${HOMEWARD_YIELDING} $<TARGET_FILE:${target}> ${files})
    endif()
    set_tests_properties(${module}/${name} PROPERTIES LABELS "${labels}" TIMEOUT ${ARG_TIMEOUT})
  endforeach()
endfunction()
