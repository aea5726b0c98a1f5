# SPDX-License-Identifier: MIT
# Debian packages only; scripts/setup installs them.
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
pkg_check_modules(GEOGRAPHICLIB REQUIRED IMPORTED_TARGET geographiclib)
pkg_check_modules(JPEG REQUIRED IMPORTED_TARGET libjpeg)
pkg_check_modules(EXIV2 REQUIRED IMPORTED_TARGET exiv2)
pkg_check_modules(GPIOD REQUIRED IMPORTED_TARGET libgpiod)
pkg_check_modules(LIBCAMERA IMPORTED_TARGET libcamera)  # its module is built where it is there
pkg_check_modules(SYSTEMD REQUIRED IMPORTED_TARGET libsystemd)
pkg_check_modules(SPDLOG REQUIRED IMPORTED_TARGET spdlog)
find_package(ZLIB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)

# OpenCV's own package file wants every OpenCV module, imgcodecs and with it GDAL among them;
# the measuring side links just these four.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
foreach(MODULE core imgproc features2d video calib3d)
  find_library(OPENCV_${MODULE}_LIBRARY opencv_${MODULE})
  if(OPENCV_${MODULE}_LIBRARY)
    add_library(opencv_${MODULE} UNKNOWN IMPORTED)
    set_target_properties(opencv_${MODULE} PROPERTIES IMPORTED_LOCATION ${OPENCV_${MODULE}_LIBRARY})
    target_include_directories(opencv_${MODULE} SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
    add_library(opencv::${MODULE} ALIAS opencv_${MODULE})
  endif()
endforeach()

if(PLUMBLINE_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
  pkg_check_modules(LIBRAW REQUIRED IMPORTED_TARGET libraw)
endif()
if(PLUMBLINE_TESTS OR PLUMBLINE_BENCH)
  find_package(Ceres REQUIRED)
endif()
