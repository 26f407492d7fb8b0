# SPDX-License-Identifier: Apache-2.0
#
# Libraries of Debian 12; docs/architecture.md says what each is for. The package that
# `cmake --install` makes finds them by this file, too.
find_package(Threads REQUIRED)
find_package(tl-expected REQUIRED)
find_package(Boost 1.74 REQUIRED)
if(LIGHTWELL_CLIENT_ONLY)
  return()
endif()

find_package(nlohmann_json REQUIRED)
find_package(draco REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(tinyobjloader REQUIRED)
find_package(tinyexr REQUIRED)
find_package(embree 3 REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET GLOBAL libwebp)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET GLOBAL libzstd)
find_path(STB_INCLUDE stb_image.h PATH_SUFFIXES stb REQUIRED)
if(LIGHTWELL_ASSIMP)
  find_package(assimp REQUIRED)
endif()
# draco's exported target of Debian 12 does not name its include folder's parent.
find_path(DRACO_INCLUDE draco/compression/decode.h REQUIRED)
target_include_directories(draco::draco INTERFACE ${DRACO_INCLUDE})
