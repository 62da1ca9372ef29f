# What programs of others build with, below the prefix: headers, the libraries libyars-client, libyars-display and libyars-radar,
# find_package(yars), pkg-config.
# All of it may be moved with the prefix. docs/attach.md shows the use.
include(CMakePackageConfigHelpers)
set(packages ${CMAKE_INSTALL_LIBDIR}/cmake/yars)
set(made ${PROJECT_BINARY_DIR}/install)
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/yars)

# yars.h is headers alone, and is there without a build. Each library is a component of its own: it must be built.
install(TARGETS yars_client EXPORT yars-client)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/databuffer/client/ DESTINATION ${headers} FILES_MATCHING PATTERN "*.h"
  PATTERN yars_client.h EXCLUDE)
install(EXPORT yars-client NAMESPACE yars:: DESTINATION ${packages})
install(TARGETS yars_client_library EXPORT yars-libclient COMPONENT client LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES ${PROJECT_SOURCE_DIR}/databuffer/client/yars_client.h DESTINATION ${headers} COMPONENT client)
install(EXPORT yars-libclient NAMESPACE yars:: DESTINATION ${packages} COMPONENT client)
install(TARGETS yars_display_library EXPORT yars-display COMPONENT display LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES ${PROJECT_SOURCE_DIR}/display/library/yars_display.h DESTINATION ${headers} COMPONENT display)
install(EXPORT yars-display NAMESPACE yars:: DESTINATION ${packages} COMPONENT display)
target_include_directories(yars_client INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_include_directories(yars_client_library INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_include_directories(yars_display_library INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

# The radar: libyars-radar with the headers that it came with; requests.hpp is made by the build.
install(TARGETS yars_radar_shared EXPORT yars-radar COMPONENT radar LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/radar/yars/ ${PROJECT_SOURCE_DIR}/lib/error/yars/ DESTINATION ${headers} COMPONENT radar)
install(FILES ${PROJECT_BINARY_DIR}/generated/yars/requests.hpp DESTINATION ${headers} COMPONENT radar)
install(EXPORT yars-radar NAMESPACE yars:: DESTINATION ${packages} COMPONENT radar)
target_include_directories(yars_radar_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

configure_package_config_file(${PROJECT_SOURCE_DIR}/packaging/cmake/yars-config.cmake.in ${made}/yars-config.cmake
  INSTALL_DESTINATION ${packages})
write_basic_package_version_file(${made}/yars-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${made}/yars-config.cmake ${made}/yars-config-version.cmake DESTINATION ${packages})

# Paths in a .pc file begin at its own folder.
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" to_prefix ${to_prefix})
foreach(part client display radar)
  configure_file(${PROJECT_SOURCE_DIR}/packaging/pkgconfig/yars-${part}.pc.in ${made}/yars-${part}.pc @ONLY)
endforeach()
install(FILES ${made}/yars-client.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES ${made}/yars-radar.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT radar)
install(FILES ${made}/yars-display.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT display)
