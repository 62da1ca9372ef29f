# `cpack -G DEB` in the build folder of the release preset makes yars_VERSION-1_ARCHITECTURE.deb: docs/packaging.md.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME yars)
set(CPACK_PACKAGE_CONTACT "YARS <yars@users.noreply.example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "air-to-ground radar simulation after the APG-70")
set(CPACK_PACKAGE_DESCRIPTION "YARS shows the ground map of an airborne radar as a pilot sees it: a real
beam map computed from digital terrain in real time, high resolution patch
maps with shadow and speckle, and a display with twenty bezel buttons. It is a
set of separate programs over lock-free shared memory: attach a flight model
or a panel, or read the sweeps, from C, Python or by UDP.")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
# What the programs are linked with, and what they open when the display draws.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For libyars-display: what a package that is linked with it depends on, and a run of ldconfig.
file(WRITE ${PROJECT_BINARY_DIR}/install/shlibs
  "libyars-display ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} yars (>= ${PROJECT_VERSION})\n")
file(WRITE ${PROJECT_BINARY_DIR}/install/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/install/shlibs ${PROJECT_BINARY_DIR}/install/triggers)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1, libgl1, python3:any")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)

# The changes of the package, beside those of the program. The day is that of the build, or of SOURCE_DATE_EPOCH.
string(TIMESTAMP day "%a, %d %b %Y 00:00:00 +0000" UTC)
file(WRITE ${PROJECT_BINARY_DIR}/install/changelog_of_package
  "yars (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n  * Made by CPack from YARS ${PROJECT_VERSION}.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${day}\n")
compressed(${PROJECT_BINARY_DIR}/install/changelog_of_package changelog.Debian ${documents})
