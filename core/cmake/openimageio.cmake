# SPDX-License-Identifier: Apache-2.0
# Debian's own CMake files for OpenImageIO insist on its command line tools and on the Python module
# of Imath; the library needs neither, so its target is made here.
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h REQUIRED)
find_path(IMATH_INCLUDE_DIR half.h PATH_SUFFIXES Imath REQUIRED)
find_library(OPENIMAGEIO_LIBRARY OpenImageIO REQUIRED)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)

add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
  IMPORTED_LOCATION ${OPENIMAGEIO_LIBRARY}
  INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${OPENIMAGEIO_INCLUDE_DIR};${IMATH_INCLUDE_DIR}"
  INTERFACE_INCLUDE_DIRECTORIES "${OPENIMAGEIO_INCLUDE_DIR};${IMATH_INCLUDE_DIR}"
  INTERFACE_LINK_LIBRARIES ${OPENIMAGEIO_UTIL_LIBRARY})
