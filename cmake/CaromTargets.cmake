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

# carom_library(folder DEPENDS folder...  LIBRARIES target...): every .cpp of the folder becomes carom_<folder>.
function(carom_library folder)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(TRANSFORM ARG_DEPENDS PREPEND carom_)
  if(sources)
    add_library(carom_${folder} STATIC ${sources})
    target_link_libraries(carom_${folder} PUBLIC carom_options fmt::fmt ${ARG_DEPENDS} PRIVATE ${ARG_LIBRARIES})
  else()
    add_library(carom_${folder} INTERFACE)
    target_link_libraries(carom_${folder} INTERFACE carom_options fmt::fmt ${ARG_DEPENDS})
  endif()
endfunction()

# carom_test(name folder... ): tests/<kind>/<name>.cpp becomes a ctest entry per gtest case, labelled <kind>.
function(carom_test name)
  add_executable(${name} ${CMAKE_CURRENT_SOURCE_DIR}/${name}.cpp)
  list(TRANSFORM ARGN PREPEND carom_ OUTPUT_VARIABLE folders)
  target_link_libraries(${name} PRIVATE ${folders} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE CAROM_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  get_filename_component(kind ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  # Threads that wait by spinning starve each other where other work shares the cores.
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 300 LABELS ${kind} ENVIRONMENT OMP_WAIT_POLICY=passive)
endfunction()
