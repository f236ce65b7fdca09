# Compiler settings shared by all our targets, and the one function that makes a room's library.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

# Places in backtraces cost little, full debug information a quarter of the compile time (the preset dev has it). What a
# program does not use of a library is left out: a third of libindurop.so, which every process module has in memory.
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1 -DNDEBUG -ffunction-sections -fdata-sections")
add_link_options(-Wl,--gc-sections)

find_program(INDUROP_CCACHE ccache)
if(INDUROP_CCACHE)
  # The setting that ccache needs to cache files compiled with precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${INDUROP_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${INDUROP_CCACHE})
endif()

add_library(indurop_options INTERFACE)
# GCC decides which warnings are errors. Of Clang's, -Wshadow knows no batches (indurop_unity), and -Wdouble-promotion
# warns of double{value}, too.
target_compile_options(indurop_options INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion -Wformat=2 -Werror>
  $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-error -Wno-shadow -Wno-double-promotion>)
target_include_directories(indurop_options INTERFACE ${PROJECT_SOURCE_DIR})

# address;undefined or thread
set(INDUROP_SANITIZE "" CACHE STRING "Sanitizers, separated by commas")
if(INDUROP_SANITIZE)
  add_compile_options(-fsanitize=${INDUROP_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  # What sanitizers add hides from g++ that a value is set; the release build warns rightly.
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-maybe-uninitialized>)
  add_link_options(-fsanitize=${INDUROP_SANITIZE})
  if(INDUROP_SANITIZE MATCHES "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # It does not model fences; what our fences order is shown to it as relaxed atomics, so nothing is reported falsely.
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-tsan>)
  endif()
endif()

# Third-party headers that most files include, read once for all rooms that call indurop_precompile(<target>), and again
# with GoogleTest for all tests: a third of all compile time. Such a room links fmt::fmt and hides its symbols. Every file
# still includes what it uses (tests/lint/check_headers.py).
# GCC 14 rejects them where a target has other options (-O1, a definition of a library) and reads the headers themselves.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  set(CMAKE_PCH_WARN_INVALID OFF)
endif()
set(INDUROP_PRECOMPILED_STANDARD <algorithm> <array> <charconv> <chrono> <cstdint> <functional> <map> <memory>
  <optional> <span> <string> <string_view> <unordered_map> <utility> <variant> <vector>)
set(INDUROP_PRECOMPILED ${INDUROP_PRECOMPILED_STANDARD} <fmt/format.h>)
set(INDUROP_PRECOMPILED_SOURCE ${PROJECT_BINARY_DIR}/precompiled.cpp)  # a target needs one; only the headers count
file(CONFIGURE OUTPUT ${INDUROP_PRECOMPILED_SOURCE} CONTENT "")
add_library(indurop_precompiled OBJECT ${INDUROP_PRECOMPILED_SOURCE})
target_link_libraries(indurop_precompiled PRIVATE indurop_options fmt::fmt)
set_target_properties(indurop_precompiled PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
target_precompile_headers(indurop_precompiled PRIVATE ${INDUROP_PRECOMPILED})

function(indurop_precompile target)
  set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_precompile_headers(${target} REUSE_FROM indurop_precompiled)
endfunction()

# Compiles the files of a target 24 at a time, which takes half of the time; their names in anonymous namespaces have to
# differ then. -DINDUROP_UNITY=OFF compiles all files one by one: quicker when one file is changed again and again.
option(INDUROP_UNITY "Compile several files of a room at a time" ON)
function(indurop_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${INDUROP_UNITY} UNITY_BUILD_BATCH_SIZE 24)
  if(INDUROP_UNITY)  # it takes our files for headers
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# The same, but only files of one line meet: a program that needs one of them takes all of these, and the libraries that
# they need, and no others. indurop_unity_groups(<target> "a.cpp b.cpp" "c.cpp d.cpp")
function(indurop_unity_groups target)
  indurop_unity(${target})
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  foreach(line IN LISTS ARGN)
    string(REPLACE " " ";" files "${line}")
    list(GET files 0 group)
    cmake_path(GET group STEM group)
    set_source_files_properties(${files} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# Code that waits for people, files and other hosts more than for the processor, and is not called in ticks: -O1 takes
# 0.8 of the compile time of -O2.
function(indurop_not_timed target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O1>)
endfunction()

# A room: static library indurop_<name> of the given sources.
function(indurop_room name)
  add_library(indurop_${name} STATIC ${ARGN})
  target_link_libraries(indurop_${name} PRIVATE indurop_options PUBLIC indurop_headers)
  target_include_directories(indurop_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  set_target_properties(indurop_${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# A GoogleTest program: indurop_test(<name> LABEL unit SOURCES ... LIBRARIES ...)
# A folder may set INDUROP_TEST_HEADERS to an object library that made other precompiled headers.
set(INDUROP_TEST_HEADERS indurop_test_headers)
set(INDUROP_TEST_TIMEOUT 120)  # s
if(INDUROP_SANITIZE)
  set(INDUROP_TEST_TIMEOUT 900)
endif()
function(indurop_test name)
  cmake_parse_arguments(arg "" "LABEL" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE indurop_options ${arg_LIBRARIES} fmt::fmt GTest::gmock_main)
  # What is tested is optimized, the tests themselves need not be: half of all compile time.
  target_compile_options(${name} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O0>)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests INDUROP_LABEL ${arg_LABEL})
  target_precompile_headers(${name} REUSE_FROM ${INDUROP_TEST_HEADERS})
  indurop_unity(${name})
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${arg_LABEL} TIMEOUT ${INDUROP_TEST_TIMEOUT})
endfunction()

# The same programs above core/rt/posix/ instead of the system that was chosen: nothing but the linker has work to do.
function(indurop_tests_above_posix)
  foreach(name ${ARGN})
    get_target_property(libraries ${name} LINK_LIBRARIES)
    get_target_property(labels ${name} INDUROP_LABEL)
    add_executable(${name}_posix $<TARGET_OBJECTS:${name}>)
    target_link_libraries(${name}_posix PRIVATE $<LINK_LIBRARY:WHOLE_ARCHIVE,indurop_rt_posix> ${libraries})
    set_target_properties(${name}_posix PROPERTIES LINKER_LANGUAGE CXX RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
    gtest_discover_tests(${name}_posix TEST_PREFIX posix. DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
      PROPERTIES LABELS ${labels} TIMEOUT ${INDUROP_TEST_TIMEOUT})
  endforeach()
endfunction()
