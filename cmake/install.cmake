# What `cmake --install` lays out below its prefix beside the programs (yars_program): examples, configurations, documents,
# man pages; cmake/libraries.cmake adds what programs of others build with. Everything is found from where a program lies,
# so the prefix may be moved.
set(share ${CMAKE_INSTALL_DATADIR}/yars)
set(documents ${CMAKE_INSTALL_DATADIR}/doc/yars)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/config/ DESTINATION ${share}/config
  FILES_MATCHING PATTERN "*.guf" PATTERN "*.route" PATTERN "*.script" PATTERN "*.scenes" PATTERN "*.tour")
# Structures of the topics, for programs of others that join by DDS: docs/network.md. A component of its own: the build makes one.
install(FILES ${PROJECT_SOURCE_DIR}/gateway/yars_network.idl ${PROJECT_BINARY_DIR}/generated/gateway/yars_records.idl
  DESTINATION ${share}/idl COMPONENT idl)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${documents} FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.webp")
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${documents})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${documents} RENAME copyright)

# The start script: installed it finds the programs beside it.
install(PROGRAMS ${PROJECT_SOURCE_DIR}/scripts/start DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME yars-start)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/scripts/supervise ${PROJECT_SOURCE_DIR}/scripts/nearest_word.py DESTINATION libexec/yars)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/scripts/network_identities DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME yars-network-identities)

# Completions of commands and options, where Debian's shells look for them.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/packaging/completion/bash/ DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/packaging/completion/zsh/ DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/packaging/completion/fish/ DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# Units of the user's systemd, for the installed start script.
foreach(unit yars.service yars@.service)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/packaging/systemd/${unit})
  file(READ ${PROJECT_SOURCE_DIR}/packaging/systemd/${unit} text)
  string(REPLACE "\"$$YARS_HOME/scripts/start\"" "yars-start" text "${text}")
  string(REPLACE "# Where the checkout lies, built once by scripts/start; with its default options.\nEnvironment=YARS_HOME=%h/yars YARS_OPTIONS=" "Environment=YARS_OPTIONS=" text "${text}")
  string(REPLACE "# Options, YARS_HOME and YARS_BIN_DIR of this machine." "# Options of this machine." text "${text}")
  string(REPLACE "scripts/start" "yars-start" text "${text}")
  file(WRITE ${PROJECT_BINARY_DIR}/install/systemd/${unit} "${text}")
endforeach()
install(DIRECTORY ${PROJECT_BINARY_DIR}/install/systemd/ DESTINATION lib/systemd/user)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${documents} PATTERN "__pycache__" EXCLUDE)

# compressed(SOURCE NAME DESTINATION COMPONENT): a file as man and Debian want it. Made while configuring: who builds the programs
# alone, as scripts/start does, can install them.
function(compressed source name destination component)
  get_filename_component(folder ${destination} NAME)
  set(packed ${PROJECT_BINARY_DIR}/install/${folder}/${name}.gz)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/install/${folder})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
  execute_process(COMMAND gzip --best --no-name --stdout ${source} OUTPUT_FILE ${packed} COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${packed} DESTINATION ${destination} COMPONENT ${component})
endfunction()
file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/packaging/man/*.[15])
foreach(page IN LISTS pages)
  get_filename_component(name ${page} NAME)
  string(REGEX MATCH "[0-9]$" section ${name})
  set(component Unspecified)
  if(name STREQUAL yars-plot-trade.1)
    set(component python)
  endif()
  compressed(${page} ${name} ${CMAKE_INSTALL_MANDIR}/man${section} ${component})
endforeach()
compressed(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog ${documents} Unspecified)

# What is installed names what is installed.
find_package(Python3 COMPONENTS Interpreter REQUIRED)
install(CODE "execute_process(COMMAND \"${Python3_EXECUTABLE}\" \"${PROJECT_SOURCE_DIR}/packaging/installed_paths.py\"
  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\" ${documents} ${share} ${PROJECT_VERSION} COMMAND_ERROR_IS_FATAL ANY)")
