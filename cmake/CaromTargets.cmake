# One library per folder of src/, linked with exactly the folders below it that it may include (docs/layers.md).

add_library(carom_options INTERFACE)
target_compile_options(carom_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wno-psabi -ffp-contract=on)
target_link_libraries(carom_options INTERFACE OpenMP::OpenMP_CXX)
target_include_directories(carom_options INTERFACE ${CMAKE_SOURCE_DIR}/src)
if(CAROM_WERROR)
  target_compile_options(carom_options INTERFACE -Werror)
endif()
if(CAROM_ASSERTIONS)
  target_compile_options(carom_options INTERFACE -UNDEBUG)
  target_compile_definitions(carom_options INTERFACE _GLIBCXX_ASSERTIONS)
endif()

# For text in, text out: two thirds of the time to compile code whose speed does not show.
function(carom_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Headers cost as much as the code behind them: files of a target are compiled together, sixteen at a time (in one run, two
# eights of tests took 24.5 s apart and 19.3 s as one sixteen).
function(carom_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${CAROM_UNITY} UNITY_BUILD_BATCH_SIZE 16)
endfunction()

# carom_library(folder DEPENDS folder...  LIBRARIES target...): every .cpp of the folder becomes carom_<folder>.
function(carom_library folder)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(TRANSFORM ARG_DEPENDS PREPEND carom_)
  if(sources)
    add_library(carom_${folder} STATIC ${sources})
    target_link_libraries(carom_${folder} PUBLIC carom_options fmt::fmt ${ARG_DEPENDS} PRIVATE ${ARG_LIBRARIES})
    carom_unity(carom_${folder})
  else()
    add_library(carom_${folder} INTERFACE)
    target_link_libraries(carom_${folder} INTERFACE carom_options fmt::fmt ${ARG_DEPENDS})
  endif()
endfunction()

# carom_tests(group folder...): the files <group>/*.cpp and <group>_*.cpp become the program <group>_tests, each of its gtest
# cases a ctest entry labelled with the name of this folder, <group>.<suite> for all cases of a parameterised suite. A file's
# tests stand in a namespace of its own.
function(carom_tests group)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${group}/*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/${group}_*.cpp)
  add_executable(${group}_tests ${sources})
  list(TRANSFORM ARGN PREPEND carom_ OUTPUT_VARIABLE folders)
  target_link_libraries(${group}_tests PRIVATE ${folders} carom_test_main)
  target_compile_definitions(${group}_tests PRIVATE CAROM_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  set_target_properties(${group}_tests PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  carom_unity(${group}_tests)
  target_compile_options(${group}_tests PRIVATE ${CAROM_TEST_OPTIMISATION})
  get_filename_component(kind ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  # ctest runs a process a core: a test has one thread unless it asks for more, and threads that wait do not spin. A program
  # that registers thousands of cases takes longer to start than most of them: those of a parameterised suite share a process.
  set(properties LABELS ${kind} ENVIRONMENT OMP_NUM_THREADS=1 ENVIRONMENT_MODIFICATION OMP_WAIT_POLICY=set:passive)
  gtest_discover_tests(${group}_tests DISCOVERY_MODE PRE_TEST TEST_FILTER "-*/*" PROPERTIES TIMEOUT 300 ${properties})
  foreach(source IN LISTS sources)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(STRINGS ${source} lines REGEX "INSTANTIATE_TEST_SUITE_P|TYPED_TEST_SUITE")
    foreach(line IN LISTS lines)
      if(NOT line MATCHES "^(INSTANTIATE_TEST_SUITE_P\\([A-Za-z]*, |TYPED_TEST_SUITE\\()([A-Za-z0-9]+),")
        message(FATAL_ERROR "${source}: the name of the suite is not on the line \"${line}\"")
      endif()
      set(suite ${CMAKE_MATCH_2})
      if(TEST ${group}.${suite})
        continue()
      endif()
      add_test(NAME ${group}.${suite} COMMAND ${group}_tests --gtest_brief=1
               "--gtest_filter=${suite}.*/*:*/${suite}.*/*:${suite}/*")
      set_tests_properties(${group}.${suite} PROPERTIES TIMEOUT 1800 COST 100 ${properties})
    endforeach()
  endforeach()
endfunction()
