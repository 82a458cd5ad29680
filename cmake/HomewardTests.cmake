# Tests: what several of them share, programs of GoogleTest files, and who has to give way to whom.

# What drives in real time needs a processor as soon as it wants one. All other tests run at the lowest of priorities and
# take what those leave, so both go on at once. (SCHED_IDLE; anybody may give up a priority.)
find_program(CHRT_PROGRAM chrt)
set(HOMEWARD_YIELDING "")
if(CHRT_PROGRAM)
  set(HOMEWARD_YIELDING ${CHRT_PROGRAM} --idle 0)
endif()

# homeward_real_time(name ...): tests that go in real time, started without HOMEWARD_YIELDING: one at a time, and before all
# others, as they take longest altogether.
function(homeward_real_time)
  set_tests_properties(${ARGN} PROPERTIES RESOURCE_LOCK real_time COST 1000)
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

# Gives in `result` what to compile for the files a_test.cpp ... of this folder: sources that include HOMEWARD_TEST_BATCH of
# them each. Not CMake's own UNITY_BUILD: its sources name files by where they lie on this machine, so the compiler cache
# would find none of them in another folder.
function(_homeward_test_batches result target)
  set(files ${ARGN})
  list(TRANSFORM files APPEND _test.cpp)
  if(HOMEWARD_TEST_BATCH LESS 2)
    set(${result} ${files} PARENT_SCOPE)
    return()
  endif()
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR}/tests ${CMAKE_CURRENT_SOURCE_DIR})
  set(sources "")
  set(begin 0)
  list(LENGTH files count)
  while(begin LESS count)
    list(SUBLIST files ${begin} ${HOMEWARD_TEST_BATCH} batch)
    list(TRANSFORM batch REPLACE "(.+)" "#include \"${folder}/\\1\"\n")
    string(JOIN "" text ${batch})
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}_${begin}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "${text}" @ONLY)
    list(APPEND sources ${source})
    math(EXPR begin "${begin} + ${HOMEWARD_TEST_BATCH}")
  endwhile()
  set(${result} ${sources} PARENT_SCOPE)
endfunction()

# homeward_add_tests(mapping FILES edges loops+closed_loops LINK targets [SLOW loops] [LABELS unit] [TIMEOUT seconds]
#                    [SOURCES helper.cpp] [REAL_TIME edges]): the GoogleTest program mapping_tests of this folder's
# edges_test.cpp, loops_test.cpp and closed_loops_test.cpp. Each of FILES is a ctest entry that runs that file's tests alone, here
# mapping/edges and mapping/loops, which runs two files. Unit tests that are not SLOW also have the label "fast".
function(homeward_add_tests module)
  cmake_parse_arguments(ARG "" "TIMEOUT" "FILES;LINK;SLOW;LABELS;SOURCES;REAL_TIME" ${ARGN})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
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

  _homeward_test_batches(batches ${target} ${files})
  add_executable(${target} ${batches} ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE ${ARG_LINK} homeward_test_folders homeward_test_main GTest::gtest
                                          GTest::gmock)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  _homeward_finish(${target} HEADERS homeward_test_pch)
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
