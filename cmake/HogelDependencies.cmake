# Every third-party library, found once. Each is included by one file or one small folder of src/hogel,
# and by no public header, so a program that uses the installed library needs none of their headers.
find_package(PkgConfig REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(assimp REQUIRED)
find_package(embree 3 REQUIRED)
find_package(fmt REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
# libfftw3f is GPL; any library with the same interface can be put in its place here (see math/fft.cpp).
pkg_check_modules(fftw3f REQUIRED IMPORTED_TARGET fftw3f)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
add_library(hwy::hwy ALIAS PkgConfig::hwy)
if(HOGEL_TESTS)
  find_package(GTest REQUIRED)
endif()
