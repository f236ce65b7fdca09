# Compiler settings shared by all our targets, and the one function that makes a room's library.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

# Places in backtraces cost little, full debug information a quarter of the compile time (the preset dev has it).
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1 -DNDEBUG")

find_program(INDUROP_CCACHE ccache)
if(INDUROP_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${INDUROP_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${INDUROP_CCACHE})
endif()

add_library(indurop_options INTERFACE)
target_compile_options(indurop_options INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion -Wformat=2 -Werror>)
target_include_directories(indurop_options INTERFACE ${PROJECT_SOURCE_DIR})

# address;undefined or thread
set(INDUROP_SANITIZE "" CACHE STRING "Sanitizers, separated by commas")
if(INDUROP_SANITIZE)
  add_compile_options(-fsanitize=${INDUROP_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${INDUROP_SANITIZE})
  if(INDUROP_SANITIZE MATCHES "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # It does not model fences; what our fences order is shown to it as relaxed atomics, so nothing is reported falsely.
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-tsan>)
  endif()
endif()

# A room: static library indurop_<name> of the given sources.
function(indurop_room name)
  add_library(indurop_${name} STATIC ${ARGN})
  target_link_libraries(indurop_${name} PRIVATE indurop_options PUBLIC indurop_headers)
  target_include_directories(indurop_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  set_target_properties(indurop_${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# A GoogleTest program: indurop_test(<name> LABEL unit SOURCES ... LIBRARIES ...)
function(indurop_test name)
  cmake_parse_arguments(arg "" "LABEL" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE indurop_options ${arg_LIBRARIES} GTest::gmock_main)
  # What is tested is optimized, the tests themselves need not be: half of all compile time.
  target_compile_options(${name} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O0>)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${arg_LABEL} TIMEOUT 120)
endfunction()
