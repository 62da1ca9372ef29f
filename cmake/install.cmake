# What `cmake --install` lays out below its prefix beside the programs (yars_program): examples, configurations,
# documents, man pages, completions; cmake/libraries.cmake adds what programs of others build with. Everything is found
# from where a program lies, so the prefix may be moved.
set(share ${CMAKE_INSTALL_DATADIR}/yars)
set(documents ${CMAKE_INSTALL_DATADIR}/doc/yars)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/config/ DESTINATION ${share}/config
  FILES_MATCHING PATTERN "*.guf" PATTERN "*.route" PATTERN "*.script" PATTERN "*.scenes" PATTERN "*.tour"
  PATTERN "*.csv")
# Structures of the topics, for programs of others that join by DDS: docs/network.md.
# A component of its own: the build makes one.
install(FILES ${PROJECT_SOURCE_DIR}/gateway/yars_network.idl ${PROJECT_BINARY_DIR}/generated/gateway/yars_records.idl
  DESTINATION ${share}/idl COMPONENT idl)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${documents} FILES_MATCHING PATTERN "*.md" PATTERN "*.png"
  PATTERN "*.webp")
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${documents})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${documents} RENAME copyright)

# Tables of the segment's records, a document of the installation. No target of its own is needed to install it.
find_package(Python3 COMPONENTS Interpreter REQUIRED)
set(generator ${PROJECT_SOURCE_DIR}/lib/values/generate.py)
set(records ${PROJECT_BINARY_DIR}/install/doc/records.md)
file(GLOB chapters CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lib/values/*.idl
  ${PROJECT_SOURCE_DIR}/lib/values/generator/*.py)
add_custom_command(OUTPUT ${records} COMMAND Python3::Interpreter ${generator} --tables ${records}
  DEPENDS ${chapters} ${generator} ${PROJECT_SOURCE_DIR}/lib/values/layout.tsv COMMENT "Tables of the records" VERBATIM)
if(NOT EXISTS ${records})
  execute_process(COMMAND ${Python3_EXECUTABLE} ${generator} --tables ${records} COMMAND_ERROR_IS_FATAL ANY)
endif()
add_custom_target(yars_records_page ALL DEPENDS ${records})
install(FILES ${records} DESTINATION ${documents}/docs)

# The keys of data sets, likewise. Made while configuring.
set(keys ${PROJECT_SOURCE_DIR}/python/yars/dataset/keys.py)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${keys})
execute_process(COMMAND ${Python3_EXECUTABLE} ${keys} OUTPUT_FILE ${PROJECT_BINARY_DIR}/install/doc/dataset_keys.md
  COMMAND_ERROR_IS_FATAL ANY)
install(FILES ${PROJECT_BINARY_DIR}/install/doc/dataset_keys.md DESTINATION ${documents}/docs)

# The start script: installed it finds the programs beside it.
install(PROGRAMS ${PROJECT_SOURCE_DIR}/scripts/start DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME yars-start)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scripts/starting DESTINATION libexec/yars FILES_MATCHING PATTERN "*.py")
install(PROGRAMS ${PROJECT_SOURCE_DIR}/scripts/network_identities DESTINATION ${CMAKE_INSTALL_BINDIR}
  RENAME yars-network-identities)

# Man pages and completions, with the options that --help of the programs prints. Python's page is of another package.
set(help ${PROJECT_BINARY_DIR}/install/help)
set(programs)
foreach(program radar-model radar-display state-machine input-monitor flight-model yars yars-station gateway)
  if(TARGET ${program})
    list(APPEND programs ${program})
  endif()
endforeach()
set(folder_of_programs ${PROJECT_BINARY_DIR}/bin)
if(CMAKE_CROSSCOMPILING)
  set(folder_of_programs -)
endif()
file(GLOB writers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/packaging/help/*.py
  ${PROJECT_SOURCE_DIR}/scripts/starting/*.py)
file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/packaging/man/*.[15])
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/install/help.stamp
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/packaging/help/write.py ${folder_of_programs} ${help}
  COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/install/help.stamp
  DEPENDS ${programs} ${writers} ${pages} COMMENT "Man pages and completions" VERBATIM)
# Until then, and in a cross build, the pages are without options.
if(NOT EXISTS ${help})
  execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/packaging/help/write.py - ${help}
    COMMAND_ERROR_IS_FATAL ANY)
endif()
add_custom_target(yars_help ALL DEPENDS ${PROJECT_BINARY_DIR}/install/help.stamp)
install(DIRECTORY ${help}/ DESTINATION ${CMAKE_INSTALL_DATADIR} PATTERN yars-plot-trade.1.gz EXCLUDE)
install(FILES ${help}/man/man1/yars-plot-trade.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT python)

# Units of the user's systemd, from one template. write_units(FOLDER): two units, for session default and for the
# session that an instance names, with the variables start, command and environment.
function(write_units folder)
  set(session default)
  set(session_words "\"default\"")
  set(options_file service.conf)
  configure_file(${PROJECT_SOURCE_DIR}/packaging/systemd/yars.service.in ${folder}/yars.service @ONLY)
  set(session %i)
  set(session_words "that the instance names (yars@cockpit2: cockpit2)")
  set(options_file service-%i.conf)
  configure_file(${PROJECT_SOURCE_DIR}/packaging/systemd/yars.service.in ${folder}/yars@.service @ONLY)
endfunction()
set(start yars-start)
set(command yars-start)
set(environment "# Options of this machine.\nEnvironment=YARS_OPTIONS=")
write_units(${PROJECT_BINARY_DIR}/install/systemd)
set(start scripts/start)
set(command "\"$$YARS_HOME/scripts/start\"")
string(JOIN "\n" environment "# Where the checkout lies, built once by scripts/start."
  "# The file has options, YARS_HOME and YARS_BIN_DIR of this machine."
  "Environment=YARS_HOME=%h/yars YARS_OPTIONS=")
write_units(${PROJECT_BINARY_DIR}/systemd)
install(DIRECTORY ${PROJECT_BINARY_DIR}/install/systemd/ DESTINATION lib/systemd/user)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${documents} PATTERN "__pycache__" EXCLUDE)

# compressed(SOURCE NAME DESTINATION COMPONENT): a file as Debian wants it. Made while configuring: who builds the
# programs alone, as scripts/start does, can install them.
function(compressed source name destination component)
  get_filename_component(folder ${destination} NAME)
  set(packed ${PROJECT_BINARY_DIR}/install/${folder}/${name}.gz)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/install/${folder})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
  execute_process(COMMAND gzip --best --no-name --stdout ${source} OUTPUT_FILE ${packed} COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${packed} DESTINATION ${destination} COMPONENT ${component})
endfunction()
compressed(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog ${documents} Unspecified)

# What is installed names what is installed.
install(CODE "execute_process(COMMAND \"${Python3_EXECUTABLE}\" \"${PROJECT_SOURCE_DIR}/packaging/installed_paths.py\"
  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\" ${documents} ${share} ${PROJECT_VERSION} COMMAND_ERROR_IS_FATAL ANY)")
