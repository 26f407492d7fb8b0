# SPDX-License-Identifier: Apache-2.0
#
# Libraries of Debian 12; docs/architecture.md says what each is for.
find_package(tl-expected REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(draco REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(tinyobjloader REQUIRED)
find_package(tinyexr REQUIRED)
find_package(CLI11 REQUIRED)
find_package(embree 3 REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
find_path(XXHASH_INCLUDE xxhash.h REQUIRED)
find_path(STB_INCLUDE stb_image.h PATH_SUFFIXES stb REQUIRED)

if(LIGHTWELL_ASSIMP)
  find_package(assimp REQUIRED)
endif()

add_library(lightwell_expected INTERFACE)
target_link_libraries(lightwell_expected INTERFACE tl::expected)
add_library(lightwell_webp INTERFACE)
target_link_libraries(lightwell_webp INTERFACE PkgConfig::WEBP)
add_library(lightwell_stb INTERFACE)
target_include_directories(lightwell_stb SYSTEM INTERFACE ${STB_INCLUDE})
# draco's exported target of Debian 12 does not name its include folder's parent.
find_path(DRACO_INCLUDE draco/compression/decode.h REQUIRED)
target_include_directories(draco::draco INTERFACE ${DRACO_INCLUDE})
