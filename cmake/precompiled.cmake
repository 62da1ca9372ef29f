# Headers that most units read are compiled once. Saves a quarter of the processor time of a first build.
# ccache keeps no unit that uses a precompiled header of another tree, so where it is found there are none.
if(CCACHE)
  set(default OFF)
else()
  set(default ON)
endif()
option(YARS_PRECOMPILED "precompile headers of the standard library and googletest" ${default})

set(yars_precompiled_standard <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory>
  <optional> <span> <string> <string_view> <utility> <variant> <vector>)

# yars_precompiled(NAME [FLAGS ...] [HEADERS ...] [DEPENDS ...]): a target whose precompiled headers those compiled with
# the same flags use.
function(yars_precompiled name)
  cmake_parse_arguments(ARG "" "" "FLAGS;HEADERS;DEPENDS" ${ARGN})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/precompiled.cpp CONTENT "")  # written once
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/generated/precompiled.cpp)
  target_compile_options(${name} PRIVATE ${ARG_FLAGS})
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS})
  target_precompile_headers(${name} PRIVATE ${yars_precompiled_standard} ${ARG_HEADERS})
endfunction()

# Flags of LIGHT targets in release. They compute little: text, options, JSON, single pictures. Their templates take a
# third less time to compile.
set(yars_light_flags)
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  set(yars_light_flags -O1)
endif()
if(YARS_PRECOMPILED)
  yars_precompiled(yars_precompiled)
  if(yars_light_flags)
    yars_precompiled(yars_precompiled_light FLAGS ${yars_light_flags})
  endif()
endif()

# yars_use_precompiled(TARGET NAME): compiles TARGET with the headers of NAME where there are any.
function(yars_use_precompiled target name)
  if(TARGET ${name})
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

# yars_set_weight(TARGET LIGHT [NAME]): LIGHT true: TARGET is compiled with yars_light_flags. The precompiled headers of
# that weight, or of NAME.
function(yars_set_weight target light)
  set(headers yars_precompiled)
  if(light AND yars_light_flags)
    target_compile_options(${target} PRIVATE ${yars_light_flags})
    set(headers yars_precompiled_light)
  endif()
  if(ARGN)
    set(headers ${ARGN})
  endif()
  yars_use_precompiled(${target} ${headers})
endfunction()

# yars_unite(TARGET): with YARS_UNITY, compiles eight sources of TARGET as one unit, so that their headers are read
# once. Sources that Highway compiles once for each instruction set stay units of their own.
option(YARS_UNITY "compile several sources as one unit: a faster first build, slower later ones" OFF)
function(yars_unite target)
  if(NOT YARS_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  # A local name may equal a file-scope name of another source of the same unit: only locals are held against each
  # other, which Clang cannot.
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-shadow$<SEMICOLON>-Wshadow=local>
    $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-shadow>)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE path)
    if(EXISTS ${path})
      file(STRINGS ${path} vectors REGEX "foreach_target\\.h")
      if(vectors)
        set_source_files_properties(${path} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endif()
  endforeach()
endfunction()
