# yars_module(NAME [SUBFOLDERS ... | FOLDERS ...] [SHELLS] [LIGHT] [SOURCES ...] [DEPENDS ...]): a library from the
# sources of this folder and of the subfolders named, or of FOLDERS alone. Left out are *_main.cpp and *_command.cpp,
# which belong to programs, and *_shell.cpp, which see segment, log and clock, unless SHELLS is said.
# LIGHT: it computes little (cmake/precompiled.cmake).
function(yars_module name)
  cmake_parse_arguments(ARG "SHELLS;LIGHT" "" "DEPENDS;SOURCES;SUBFOLDERS;FOLDERS" ${ARGN})
  set(folders ${ARG_FOLDERS})
  if(NOT folders)
    set(folders . ${ARG_SUBFOLDERS})
  endif()
  set(sources)
  foreach(folder IN LISTS folders)
    file(GLOB more CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
    list(APPEND sources ${more})
  endforeach()
  list(FILTER sources EXCLUDE REGEX "_(main|command)\\.cpp$")
  if(NOT ARG_SHELLS)
    list(FILTER sources EXCLUDE REGEX "_shell\\.cpp$")
  endif()
  if(sources OR ARG_SOURCES)
    add_library(${name} STATIC ${sources} ${ARG_SOURCES})
    target_compile_features(${name} PUBLIC cxx_std_20)  # also for a host whose default is older
    target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} PUBLIC ${ARG_DEPENDS})
    yars_set_weight(${name} ${ARG_LIGHT})
    yars_unite(${name})
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} INTERFACE ${ARG_DEPENDS})
  endif()
endfunction()

# yars_folder_module(NAME FOLDER ...): a module from one subfolder.
macro(yars_folder_module name folder)
  yars_module(${name} FOLDERS ${folder} ${ARGN})
endmacro()

# yars_app(NAME DEPENDS ...): a role's program from the sources in its folder app/. An embedded checkout may lack them.
function(yars_app name)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/app/*.cpp)
  if(sources)
    yars_program(${name} SOURCES ${sources} ${ARGN})
  endif()
endfunction()

# yars_program(NAME [LIGHT] [PRECOMPILED NAME] SOURCES ... DEPENDS ...): an executable in build/PRESET/bin, installed
# with the others. PRECOMPILED: headers of its own (yars_precompiled), for other flags than those of the build.
function(yars_program name)
  cmake_parse_arguments(ARG "LIGHT" "PRECOMPILED" "DEPENDS;SOURCES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_compile_definitions(${name} PRIVATE YARS_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS})
  yars_set_weight(${name} ${ARG_LIGHT} ${ARG_PRECOMPILED})
  yars_unite(${name})
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
endfunction()

# yars_test(FOLDER [SUBFOLDERS ...] [ALONE] [SUITES] [LOCK name] [LONG filter] [COMPUTES] [OPENGL] [SEPARATE]
#   [SUPPORT sources] [PROGRAMS it runs] DEPENDS ...): one gtest binary from tests/FOLDER/*_test.cpp, those of its
# subfolders named, and its support sources. ctest runs it as one test named FOLDER; with SUITES as one test
# FOLDER.SUITE for each suite. ALONE: it has the machine to itself. LOCK: one at a time of the tests with this lock,
# beside others: those that run sets. LONG: tests that only scripts/test --full runs, as FOLDER.long with the label
# long; a filter of gtest, which knows * and ? but no sets of letters.
# COMPUTES: its own code takes long to run, so it is compiled with YARS_COMPUTING_TEST_FLAGS. SEPARATE: each source
# stays a unit of its own with YARS_UNITY, because names in its sources are the same. OPENGL: it draws, so leaks are not
# looked for (the search crashes now and then beside the threads of llvmpipe).
function(yars_test folder)
  cmake_parse_arguments(ARG "ALONE;SUITES;COMPUTES;OPENGL;SEPARATE" "TIMEOUT;LOCK;LONG"
    "DEPENDS;LABELS;SUBFOLDERS;SUPPORT;PROGRAMS" ${ARGN})
  set(patterns ${PROJECT_SOURCE_DIR}/tests/${folder}/*_test.cpp)
  foreach(subfolder IN LISTS ARG_SUBFOLDERS)
    list(APPEND patterns ${PROJECT_SOURCE_DIR}/tests/${folder}/${subfolder}/*_test.cpp)
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  if(NOT sources)
    return()
  endif()
  string(REPLACE "/" "_" target "test_${folder}")
  add_executable(${target} ${sources} ${ARG_SUPPORT})
  add_dependencies(unit_tests ${target})
  foreach(program IN LISTS ARG_PROGRAMS)
    if(TARGET ${program})
      add_dependencies(${target} ${program})
    endif()
  endforeach()
  target_link_libraries(${target} PRIVATE ${ARG_DEPENDS} GTest::gmock GTest::gtest_main)
  if(ARG_COMPUTES)
    target_compile_options(${target} PRIVATE ${yars_computing_test_flags})
    yars_use_precompiled(${target} yars_precompiled_computing_tests)
  else()
    target_compile_options(${target} PRIVATE ${yars_test_flags})
    yars_use_precompiled(${target} yars_precompiled_tests)
  endif()
  if(NOT ARG_SEPARATE)
    yars_unite(${target})
  endif()
  target_compile_definitions(${target} PRIVATE YARS_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    YARS_BIN_DIR="${PROJECT_BINARY_DIR}/bin")
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 900)  # a hang, also on a machine that is four times overloaded
  endif()
  if(NOT ARG_LABELS)
    set(ARG_LABELS ${folder})
  endif()
  # A filter that selects nothing is a mistake.
  set(properties TIMEOUT ${ARG_TIMEOUT} RUN_SERIAL ${ARG_ALONE}
    FAIL_REGULAR_EXPRESSION "0 tests from 0 test suites ran")
  if(ARG_OPENGL)
    list(APPEND properties ENVIRONMENT ASAN_OPTIONS=detect_leaks=0)
  endif()
  if(ARG_LOCK)
    # They begin first: one after the other they take longest.
    list(APPEND properties RESOURCE_LOCK ${ARG_LOCK} COST 1000)
  endif()
  # One run of the program, or of each suite: a process for each of three thousand tests takes longer than the tests.
  set(runs)
  if(ARG_SUITES)
    foreach(source IN LISTS sources)
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
      file(STRINGS ${source} lines REGEX "^TEST(_F|_P)?\\(")
      list(TRANSFORM lines REPLACE "^TEST(_F|_P)?\\(([A-Za-z0-9_]+),.*" "\\2")
      list(APPEND runs ${lines})
    endforeach()
    list(REMOVE_DUPLICATES runs)
    string(REPLACE ".*" "" long_suites "${ARG_LONG}")
    string(REPLACE ":" ";" long_suites "${long_suites}")
    list(REMOVE_ITEM runs ${long_suites})  # those that are long as a whole
  endif()
  if(NOT runs)
    set(runs "*")
  endif()
  foreach(run IN LISTS runs)
    set(name ${folder})
    set(filter "*")
    if(NOT run STREQUAL "*")
      set(name ${folder}.${run})
      set(filter "${run}.*:*/${run}.*")
    endif()
    add_test(NAME ${name} COMMAND ${target} --gtest_brief=1 "--gtest_filter=${filter}-${ARG_LONG}")
    set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" ${properties})
  endforeach()
  if(ARG_LONG)
    add_test(NAME ${folder}.long COMMAND ${target} --gtest_brief=1 --gtest_filter=${ARG_LONG})
    set_tests_properties(${folder}.long PROPERTIES LABELS "${ARG_LABELS};long" ${properties})
  endif()
endfunction()
