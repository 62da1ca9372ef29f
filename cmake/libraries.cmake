# What programs of others build with, below the prefix: headers, the libraries libyars-client, libyars-display and
# libyars-radar, find_package(yars), pkg-config. All of it may be moved with the prefix. docs/attach.md shows the use.
include(CMakePackageConfigHelpers)
set(packages ${CMAKE_INSTALL_LIBDIR}/cmake/yars)
set(made ${PROJECT_BINARY_DIR}/install)
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/yars)

# Component `headers` is there without a build: yars.h, which needs no library. Components client, display and radar
# have a library each, for programs that were linked with it. Component `development` is what one links with.
install(TARGETS yars_client EXPORT yars-client)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/databuffer/client/ DESTINATION ${headers} COMPONENT headers
  FILES_MATCHING PATTERN "*.h"
  PATTERN yars_client.h EXCLUDE)
install(EXPORT yars-client NAMESPACE yars:: DESTINATION ${packages} COMPONENT headers)
target_include_directories(yars_client INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
install(FILES ${PROJECT_SOURCE_DIR}/databuffer/client/yars_client.h ${PROJECT_SOURCE_DIR}/display/library/yars_display.h
  ${PROJECT_BINARY_DIR}/generated/yars/requests.hpp DESTINATION ${headers} COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/radar/yars/ ${PROJECT_SOURCE_DIR}/lib/error/yars/ DESTINATION ${headers}
  COMPONENT development)
# install_library(TARGET EXPORT COMPONENT): COMPONENT is that of the shared library.
function(install_library target export component)
  install(TARGETS ${target} EXPORT ${export} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component} NAMELINK_COMPONENT development)
  install(EXPORT ${export} NAMESPACE yars:: DESTINATION ${packages} COMPONENT development)
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()
install_library(yars_client_library yars-libclient client)
install_library(yars_display_library yars-display display)
install_library(yars_radar_shared yars-radar radar)
install_library(yars_radar_static yars-static radar)

configure_package_config_file(${PROJECT_SOURCE_DIR}/packaging/cmake/yars-config.cmake.in ${made}/yars-config.cmake
  INSTALL_DESTINATION ${packages})
write_basic_package_version_file(${made}/yars-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${made}/yars-config.cmake ${made}/yars-config-version.cmake DESTINATION ${packages} COMPONENT headers)

# Paths in a .pc file begin at its own folder.
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" to_prefix ${to_prefix})
foreach(part client display radar)
  configure_file(${PROJECT_SOURCE_DIR}/packaging/pkgconfig/yars-${part}.pc.in ${made}/yars-${part}.pc @ONLY)
endforeach()
install(FILES ${made}/yars-client.pc ${made}/yars-radar.pc ${made}/yars-display.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
  COMPONENT development)
