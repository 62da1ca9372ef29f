# `cpack -G DEB` in the build folder of the release preset makes the packages yars, libyars-dev and python3-yars, each
# NAME_VERSION-REVISION_ARCHITECTURE.deb: docs/packaging.md.
# The revision names the suite as Debian's own backports do: 1~deb12u1 sorts before 1~deb13u1, so a package follows an
# upgrade of the system, and behind every revision of an earlier version.
function(suite_of_this_system result)
  set(ID)
  if(EXISTS /etc/os-release)
    file(STRINGS /etc/os-release lines REGEX "^(ID|VERSION_ID)=")
    foreach(line IN LISTS lines)
      string(REGEX MATCH "^([A-Z_]+)=\"?([^\"]*)" ignored "${line}")
      set(${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
    endforeach()
  endif()
  if(NOT ID OR NOT VERSION_ID MATCHES "^[0-9.]+$")
    set(${result} "" PARENT_SCOPE)  # testing and others without a number
  elseif(ID STREQUAL "debian")
    set(${result} "~deb${VERSION_ID}u1" PARENT_SCOPE)
  else()
    set(${result} "~${ID}${VERSION_ID}.1" PARENT_SCOPE)
  endif()
endfunction()
suite_of_this_system(suite)
set(YARS_DEBIAN_REVISION "1${suite}" CACHE STRING "revision of the Debian packages, behind the version and a hyphen")
set(YARS_MAINTAINER "The YARS developers <yars@localhost>" CACHE STRING
  "maintainer of the Debian packages: NAME <ADDRESS>")
set(YARS_HOMEPAGE "" CACHE STRING "address of the project's page in the Debian packages; empty: none")
if(NOT YARS_MAINTAINER MATCHES "^[^<>]+ <[^<> ]+@[^<> ]+>$")
  message(FATAL_ERROR "YARS_MAINTAINER: expected NAME <ADDRESS>, found '${YARS_MAINTAINER}'; "
    "give it as -DYARS_MAINTAINER=...")
endif()
set(full_version ${PROJECT_VERSION}-${YARS_DEBIAN_REVISION})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME yars)
set(CPACK_PACKAGE_CONTACT "${YARS_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${YARS_HOMEPAGE}")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${YARS_DEBIAN_REVISION})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# Each package has the components of a group.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL programs client display radar idl Unspecified headers development python)
get_property(has_python GLOBAL PROPERTY YARS_HAS_PYTHON)
if(has_python)
  list(APPEND CPACK_COMPONENTS_ALL python_core)
endif()

# What the programs are linked with, and what they open when the display draws, or when a raster is read.
get_property(raster_libraries GLOBAL PROPERTY YARS_GDAL_PACKAGES)
list(TRANSFORM raster_libraries PREPEND ", " OUTPUT_VARIABLE also_rasters)
string(CONCAT also_rasters ${also_rasters})
set(CPACK_DEBIAN_YARS_PACKAGE_NAME yars)
set(CPACK_DEBIAN_YARS_DESCRIPTION "air-to-ground radar simulation after the APG-70
YARS shows the ground map of an airborne radar as a pilot sees it: a real
beam map computed from digital terrain in real time, high resolution patch
maps with shadow and speckle, and a display with twenty bezel buttons. It is a
set of separate programs over lock-free shared memory: attach a flight model
or a panel, or read the sweeps, from C, Python or by UDP.")
set(CPACK_DEBIAN_YARS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_YARS_PACKAGE_DEPENDS "libegl1, libgl1, python3:any")
set(CPACK_DEBIAN_YARS_PACKAGE_RECOMMENDS "libgl1-mesa-dri${also_rasters}")
set(CPACK_DEBIAN_YARS_PACKAGE_SUGGESTS "libyars-dev, python3-yars")
# For the libraries: what a package that is linked with them depends on, and a run of ldconfig by dpkg's trigger.
file(WRITE ${PROJECT_BINARY_DIR}/install/shlibs
  "libyars-client ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} yars (>= ${PROJECT_VERSION})\n"
  "libyars-display ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} yars (>= ${PROJECT_VERSION})\n"
  "libyars-radar ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} yars (>= ${PROJECT_VERSION})\n")
file(WRITE ${PROJECT_BINARY_DIR}/install/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_YARS_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/install/shlibs ${PROJECT_BINARY_DIR}/install/triggers)

# In older versions the package yars has these files.
set(CPACK_DEBIAN_LIBYARS-DEV_PACKAGE_NAME libyars-dev)
set(CPACK_DEBIAN_LIBYARS-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBYARS-DEV_DESCRIPTION "air-to-ground radar simulation after the APG-70 (development files)
What a program of yours is built with: the headers of a running session in C,
of the display in an OpenGL context of yours, and of scans and patch maps in
C++20, with files for CMake and pkg-config, and a static library of the radar.")
set(CPACK_DEBIAN_LIBYARS-DEV_PACKAGE_DEPENDS "yars (= ${full_version})")
set(CPACK_DEBIAN_LIBYARS-DEV_PACKAGE_RECOMMENDS "libexpected-dev")
set(static_parts libgeographic-dev libspdlog-dev libfmt-dev libpng-dev libopenjp2-7-dev libzip-dev libzstd-dev
  zlib1g-dev libhwy-dev)
list(JOIN static_parts ", " static_parts)
set(CPACK_DEBIAN_LIBYARS-DEV_PACKAGE_SUGGESTS "${static_parts}")
set(CPACK_DEBIAN_LIBYARS-DEV_PACKAGE_BREAKS "yars (<< ${full_version})")
set(CPACK_DEBIAN_LIBYARS-DEV_PACKAGE_REPLACES "yars (<< ${full_version})")

# The session client needs libyars-client, which is in the package yars. The compiled part needs the Python that it is
# built for, and NumPy.
set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_NAME python3-yars)
set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON3-YARS_DESCRIPTION "air-to-ground radar simulation after the APG-70 (Python 3)
The module yars computes real beam maps and patch maps of an airborne radar
from digital terrain and scenes as NumPy arrays, with labels for training data.
yars.plot draws them by matplotlib. yars.session is the client of a running
session: ownship and events in, sweeps and pictures out.")
string(JOIN ", " recommended python3-matplotlib python3-xarray python3-zarr python3-numcodecs python3-yaml python3-dask
  python3-distributed)
set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_RECOMMENDS "${recommended}${also_rasters}")
set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_SUGGESTS "python3-rasterio, python3-pil")
# Compiles the module's sources when it is installed, as Debian's own packages do.
set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/packaging/debian/postinst ${PROJECT_SOURCE_DIR}/packaging/debian/prerm)
if(has_python)
  get_property(minor GLOBAL PROPERTY YARS_PYTHON_MINOR)
  math(EXPR next_minor "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_DEPENDS
    "yars (= ${full_version}), python3 (>= 3.${minor}), python3 (<< 3.${next_minor}), python3-numpy")
else()
  set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_DEPENDS "yars (= ${full_version}), python3:any")
  string(APPEND CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_RECOMMENDS ", python3-numpy")
endif()
set(CPACK_POST_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/debian/repack.cmake)
include(CPack)
cpack_add_component_group(yars)
cpack_add_component_group(libyars-dev)
cpack_add_component_group(python3-yars)
foreach(component programs client display radar idl Unspecified)
  cpack_add_component(${component} GROUP yars)
endforeach()
foreach(component headers development)
  cpack_add_component(${component} GROUP libyars-dev)
endforeach()
foreach(component python python_core)
  cpack_add_component(${component} GROUP python3-yars)
endforeach()

# The changes of each package, beside those of the program. The day is that of the build, or of SOURCE_DATE_EPOCH.
string(TIMESTAMP day "%a, %d %b %Y 00:00:00 +0000" UTC)
foreach(name yars libyars-dev python3-yars)
  file(WRITE ${PROJECT_BINARY_DIR}/install/changelog_of_${name}
    "${name} (${full_version}) unstable; urgency=medium\n\n"
    "  * Made by CPack from YARS ${PROJECT_VERSION}.\n\n"
    " -- ${CPACK_PACKAGE_CONTACT}  ${day}\n")
endforeach()
compressed(${PROJECT_BINARY_DIR}/install/changelog_of_yars changelog.Debian ${documents} Unspecified)
set(developer_documents ${CMAKE_INSTALL_DATADIR}/doc/libyars-dev)
compressed(${PROJECT_BINARY_DIR}/install/changelog_of_libyars-dev changelog.Debian ${developer_documents} headers)
compressed(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog ${developer_documents} headers)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${developer_documents} RENAME copyright COMPONENT headers)
set(python_documents ${CMAKE_INSTALL_DATADIR}/doc/python3-yars)
compressed(${PROJECT_BINARY_DIR}/install/changelog_of_python3-yars changelog.Debian ${python_documents} python)
compressed(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog ${python_documents} python)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${python_documents} RENAME copyright COMPONENT python)
