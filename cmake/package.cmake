# `cpack -G DEB` in the build folder of the release preset makes two packages, yars_VERSION-1_ARCHITECTURE.deb and
# python3-yars_VERSION-1_ARCHITECTURE.deb: docs/packaging.md.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME yars)
set(CPACK_PACKAGE_CONTACT "YARS <yars@users.noreply.example.org>")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# Each package has the components of a group.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL programs display idl Unspecified python)
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
set(CPACK_DEBIAN_YARS_PACKAGE_SUGGESTS "python3-yars")
# For libyars-display: what a package that is linked with it depends on, and a run of ldconfig.
file(WRITE ${PROJECT_BINARY_DIR}/install/shlibs
  "libyars-display ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} yars (>= ${PROJECT_VERSION})\n")
file(WRITE ${PROJECT_BINARY_DIR}/install/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_YARS_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/install/shlibs ${PROJECT_BINARY_DIR}/install/triggers)

# The session client needs Python alone. The compiled part needs the Python that it is built for, and NumPy.
set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_NAME python3-yars)
set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON3-YARS_DESCRIPTION "air-to-ground radar simulation after the APG-70 (Python 3)
The module yars computes real beam maps and patch maps of an airborne radar
from digital terrain and scenes as NumPy arrays, with labels for training data.
yars.plot draws them by matplotlib. yars.session is the client of a running
session: ownship and events in, sweeps and pictures out.")
set(recommended "python3-matplotlib, python3-xarray, python3-zarr, python3-numcodecs, python3-yaml, python3-dask, python3-distributed")
set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_RECOMMENDS "yars (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), ${recommended}${also_rasters}")
set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_SUGGESTS "python3-rasterio, python3-pil")
# Compiles the module's sources when it is installed, as Debian's own packages do.
set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/packaging/debian/postinst ${PROJECT_SOURCE_DIR}/packaging/debian/prerm)
if(has_python)
  get_property(minor GLOBAL PROPERTY YARS_PYTHON_MINOR)
  math(EXPR next_minor "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_DEPENDS
    "python3 (>= 3.${minor}), python3 (<< 3.${next_minor}), python3-numpy")
else()
  set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_DEPENDS "python3:any")
  string(APPEND CPACK_DEBIAN_PYTHON3-YARS_PACKAGE_RECOMMENDS ", python3-numpy")
endif()
include(CPack)
cpack_add_component_group(yars)
cpack_add_component_group(python3-yars)
foreach(component programs display idl Unspecified)
  cpack_add_component(${component} GROUP yars)
endforeach()
foreach(component python python_core)
  cpack_add_component(${component} GROUP python3-yars)
endforeach()

# The changes of each package, beside those of the program. The day is that of the build, or of SOURCE_DATE_EPOCH.
string(TIMESTAMP day "%a, %d %b %Y 00:00:00 +0000" UTC)
foreach(name yars python3-yars)
  file(WRITE ${PROJECT_BINARY_DIR}/install/changelog_of_${name}
    "${name} (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n  * Made by CPack from YARS ${PROJECT_VERSION}.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${day}\n")
endforeach()
compressed(${PROJECT_BINARY_DIR}/install/changelog_of_yars changelog.Debian ${documents} Unspecified)
set(python_documents ${CMAKE_INSTALL_DATADIR}/doc/python3-yars)
compressed(${PROJECT_BINARY_DIR}/install/changelog_of_python3-yars changelog.Debian ${python_documents} python)
compressed(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog ${python_documents} python)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${python_documents} RENAME copyright COMPONENT python)
