# Rules that turn OMG IDL into a library of DDS types. Part of the installed package.
include_guard(GLOBAL)

# Keeps the names of folders out of what a target builds: equal sources give equal files, wherever they lie.
function(indurop_without_folders target)
  target_compile_options(${target} PRIVATE
    -ffile-prefix-map=${PROJECT_SOURCE_DIR}=. -ffile-prefix-map=${PROJECT_BINARY_DIR}=./build)
  set_target_properties(${target} PROPERTIES BUILD_RPATH_USE_ORIGIN ON)
endfunction()

# indurop_idlc(<target> [STATIC] FILES a.idl ... [INCLUDES folder ...] [PREFIX folder])
# Runs Cyclone DDS's idlc on each file and builds the library <target> (shared, unless STATIC) of the C
# types and topic descriptors.
# For each <stem>.idl, users of the library include <stem.h>, with PREFIX <folder/stem.h>. The files may be
# generated in the same directory.
function(indurop_idlc target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "STATIC" "PREFIX" "FILES;INCLUDES")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_FILES)
    message(FATAL_ERROR "usage: indurop_idlc(<target> [STATIC] FILES a.idl ... [INCLUDES folder ...] [PREFIX folder])")
  endif()
  if(NOT CMAKE_C_COMPILER)
    message(FATAL_ERROR "indurop_idlc(${target}): idlc writes C, so enable it: project(... LANGUAGES C CXX)")
  endif()
  find_package(CycloneDDS QUIET)
  find_program(INDUROP_IDLC idlc)
  if(NOT TARGET CycloneDDS::ddsc OR NOT INDUROP_IDLC)
    message(FATAL_ERROR "indurop_idlc(${target}): Cyclone DDS is missing; install cyclonedds-dev and cyclonedds-tools")
  endif()
  set(root ${CMAKE_CURRENT_BINARY_DIR}/${target}.generated)
  set(folder ${root})
  if(arg_PREFIX)
    string(APPEND folder /${arg_PREFIX})
  endif()
  file(MAKE_DIRECTORY ${folder})
  list(TRANSFORM arg_INCLUDES PREPEND -I OUTPUT_VARIABLE includes)
  set(sources "")
  foreach(idl IN LISTS arg_FILES)
    cmake_path(ABSOLUTE_PATH idl NORMALIZE)
    cmake_path(GET idl STEM LAST_ONLY stem)
    add_custom_command(OUTPUT ${folder}/${stem}.c ${folder}/${stem}.h
      COMMAND ${INDUROP_IDLC} -o ${folder} ${includes} ${idl}
      DEPENDS ${arg_FILES}
      COMMENT "idlc ${stem}.idl" VERBATIM)
    list(APPEND sources ${folder}/${stem}.c)
  endforeach()
  set(kind SHARED)
  if(arg_STATIC)
    set(kind STATIC)
  endif()
  add_library(${target} ${kind} ${sources})
  set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_include_directories(${target} PUBLIC ${root})
  target_link_libraries(${target} PUBLIC CycloneDDS::ddsc)
  indurop_without_folders(${target})
endfunction()
