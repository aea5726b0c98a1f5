# SPDX-License-Identifier: MIT
# What CPack is told of the packages.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME plumbline)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The Plumbline authors <plumbline@users.noreply.github.com>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/deb)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_COMPONENTS_ALL ${COMPONENTS})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
# Else CPack takes that of the machine which builds.
if(CMAKE_CROSSCOMPILING AND CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
endif()
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(VERSION "${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")

set(CPACK_DEBIAN_CAPTURE_PACKAGE_NAME ${NAME_capture})
set(CPACK_DEBIAN_CAPTURE_DESCRIPTION "photographs the vertical climb of a drone
A daemon for the companion computer of a drone: it reads an RTK receiver, takes
a photo at every height of a plan, and stores photos and positions so that a
pulled battery loses nothing. It has no image processing in it.

The package plumbline measures what was photographed, here or elsewhere.")
set(CPACK_DEBIAN_CAPTURE_PACKAGE_DEPENDS "systemd (>= 252), init-system-helpers (>= 1.54)")
set(CPACK_DEBIAN_CAPTURE_PACKAGE_RECOMMENDS "udev")
set(CPACK_DEBIAN_CAPTURE_PACKAGE_SUGGESTS
    "${NAME_measure} (= ${VERSION}), ${NAME_libcamera} (= ${VERSION})")
set(CONTROL ${CMAKE_CURRENT_SOURCE_DIR}/capture)
set(CPACK_DEBIAN_CAPTURE_PACKAGE_CONTROL_EXTRA
    ${CONTROL}/conffiles ${CONTROL}/postinst ${CONTROL}/prerm ${CONTROL}/postrm)

set(CPACK_DEBIAN_MEASURE_PACKAGE_NAME ${NAME_measure})
set(CPACK_DEBIAN_MEASURE_DESCRIPTION "ground points with error bars from photos of a vertical climb
From photos of a drone's climb and their positions to coordinates of the
ground, each with a standard deviation, without control points. What a flight
did not fix is named.

Plans, simulates, replays and checks flights too, and shows what the daemon of
plumbline-capture is doing.")
set(CPACK_DEBIAN_MEASURE_PACKAGE_SUGGESTS
    "${NAME_capture} (= ${VERSION}), ${NAME_libcamera} (= ${VERSION})")

set(CPACK_DEBIAN_LIBCAMERA_PACKAGE_NAME ${NAME_libcamera})
set(CPACK_DEBIAN_LIBCAMERA_DESCRIPTION "cameras behind libcamera, for plumbline
A module that plumblined and plumbline load where it is installed; cameras
behind V4L2 work without it. It belongs to one version of libcamera, and is
built anew for another.")
set(CPACK_DEBIAN_LIBCAMERA_PACKAGE_DEPENDS
    "${NAME_capture} (= ${VERSION}) | ${NAME_measure} (= ${VERSION})")
set(CPACK_DEBIAN_LIBCAMERA_PACKAGE_RECOMMENDS "libcamera-ipa")
