# SPDX-License-Identifier: MIT
# One room of the house is one static library: its sources are those of its folder.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
# Where several files are compiled as one (scripts/test, with CMAKE_UNITY_BUILD), so many.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)

add_library(plumbline_options INTERFACE)
target_compile_options(plumbline_options INTERFACE -Wall -Wextra -Wconversion -Werror)
# GCC 12 sees overlaps in "text" + std::string where there are none (GCC bug 105651).
target_compile_options(plumbline_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
# And later ones take the inside of an empty std::optional for a value that is used (bug 80635).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  target_compile_options(plumbline_options INTERFACE -Wno-maybe-uninitialized)
endif()
# The same recording gives the same result on every machine: no fused multiply-add by chance.
target_compile_options(plumbline_options INTERFACE -ffp-contract=off)
target_include_directories(plumbline_options INTERFACE ${PROJECT_SOURCE_DIR})
if(PLUMBLINE_SANITIZE OR PLUMBLINE_FUZZ)
  target_compile_options(plumbline_options INTERFACE -fsanitize=address,undefined
                                                    -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(plumbline_options INTERFACE -fsanitize=address,undefined)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_compile_options(plumbline_options INTERFACE
      -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/sanitize-ignore.txt)
  endif()
endif()
if(PLUMBLINE_FUZZ)
  target_compile_options(plumbline_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# plumbline_module(NAME [LINK library...]) makes plumbline::NAME from the folder's *.cpp files.
function(plumbline_module NAME)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  file(GLOB SOURCES CONFIGURE_DEPENDS *.cpp)
  if(SOURCES)
    add_library(plumbline_${NAME} STATIC ${SOURCES})
    target_link_libraries(plumbline_${NAME} PUBLIC plumbline_options ${ARG_LINK})
  else()
    add_library(plumbline_${NAME} INTERFACE)
    target_link_libraries(plumbline_${NAME} INTERFACE plumbline_options ${ARG_LINK})
  endif()
  add_library(plumbline::${NAME} ALIAS plumbline_${NAME})
endfunction()

# plumbline_test(NAME [ALONE] [LINK library...]) makes one GoogleTest program from the folder's
# *_test.cpp. ALONE: its files are never compiled as one, for their helpers share names. TOGETHER:
# one process for all its tests, which share what takes long to make. EARLY: started before others,
# for it takes so long that all would wait for it at the end.
function(plumbline_test NAME)
  cmake_parse_arguments(ARG "ALONE;TOGETHER;EARLY" "" "LINK" ${ARGN})
  file(GLOB SOURCES CONFIGURE_DEPENDS *.cpp)
  if(NOT SOURCES)
    return()
  endif()
  add_executable(${NAME}_test ${SOURCES})
  if(ARG_ALONE)
    set_target_properties(${NAME}_test PROPERTIES UNITY_BUILD OFF)
  endif()
  target_link_libraries(${NAME}_test PRIVATE plumbline_options ${ARG_LINK} GTest::gtest GTest::gmock
                                             GTest::gtest_main)
  # What is tested keeps its optimisation; the tests themselves compile in two thirds of the time.
  target_compile_options(${NAME}_test PRIVATE $<$<CONFIG:Release>:-O1>)
  # For tests that leave to the release build what would take too long here.
  target_compile_definitions(${NAME}_test PRIVATE
                             PLUMBLINE_SANITIZED=$<BOOL:${PLUMBLINE_SANITIZE}>)
  if(PLUMBLINE_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 takes std::regex's own state for uninitialised where sanitizers instrument it.
    target_compile_options(${NAME}_test PRIVATE -Wno-maybe-uninitialized)
  endif()
  # What touches devices or their libraries, to be built and run by itself: ctest -L devices.
  set(LABELS "")
  set(COST "")
  if(ARG_EARLY)
    set(COST COST 100)
  endif()
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "/tests/(contract|drivers)")
    set(LABELS LABELS devices)
    add_dependencies(device_tests ${NAME}_test)
  endif()
  set(SECONDS 900)
  if(CMAKE_CROSSCOMPILING)  # and emulated: some tens of times slower
    set(SECONDS 14400)
  endif()
  if(ARG_TOGETHER)
    add_test(NAME ${NAME}_test COMMAND ${NAME}_test)
    set_tests_properties(${NAME}_test PROPERTIES TIMEOUT ${SECONDS} ${LABELS} ${COST})
  else()
    gtest_discover_tests(${NAME}_test DISCOVERY_TIMEOUT 60
                         PROPERTIES TIMEOUT ${SECONDS} ${LABELS} ${COST})
  endif()
endfunction()
