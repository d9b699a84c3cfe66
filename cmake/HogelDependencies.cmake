# SPDX-License-Identifier: Apache-2.0
# Finds every third-party library that the library links. Each is included by one folder of src/hogel and by no public
# header, so a program that uses a shared hogel needs none of them. A static hogel passes them on: its package
# (hogelConfig.cmake) includes this file too.
find_package(PkgConfig REQUIRED)
find_package(TBB REQUIRED)
find_package(ZLIB REQUIRED)
find_package(assimp REQUIRED)
find_package(embree 3 REQUIRED)
find_package(fmt REQUIRED)
# FFTW is under the GPL, and so is a binary that is linked with it. Any library with its interface can be put in its place here
# (see math/fft_fftw.cpp). Without it, tests and benchmarks compare with it where it is installed.
if(HOGEL_FFT STREQUAL "fftw")
  pkg_check_modules(fftw3f REQUIRED IMPORTED_TARGET fftw3f)
  set(HOGEL_FFT_LIBRARY PkgConfig::fftw3f)
elseif(HOGEL_FFT STREQUAL "builtin")
  pkg_check_modules(fftw3f QUIET IMPORTED_TARGET fftw3f)
  set(HOGEL_FFT_LIBRARY)
else()
  message(FATAL_ERROR "HOGEL_FFT is builtin or fftw, not ${HOGEL_FFT}")
endif()
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
# Pictures. By pkg-config, which names the libraries alone that are needed.
pkg_check_modules(openexr REQUIRED IMPORTED_TARGET OpenEXR)
# OpenEXR's -pthread is an option of the compiler alone, which keeps tests from using their precompiled header.
set_property(TARGET PkgConfig::openexr PROPERTY INTERFACE_COMPILE_OPTIONS "")
pkg_check_modules(libpng REQUIRED IMPORTED_TARGET libpng)
pkg_check_modules(libjpeg REQUIRED IMPORTED_TARGET libjpeg)
set(HOGEL_OPTIONAL_PICTURES "")
if(HOGEL_TIFF)
  pkg_check_modules(libtiff REQUIRED IMPORTED_TARGET libtiff-4)
  list(APPEND HOGEL_OPTIONAL_PICTURES PkgConfig::libtiff)
endif()
if(HOGEL_WEBP)
  pkg_check_modules(libwebp REQUIRED IMPORTED_TARGET libwebp)
  list(APPEND HOGEL_OPTIONAL_PICTURES PkgConfig::libwebp)
endif()
# By pkg-config, because CMake's own search for HDF5 needs a C compiler and links HDF5's dependencies (curl, ssl).
pkg_search_module(hdf5 REQUIRED IMPORTED_TARGET hdf5-serial hdf5)
