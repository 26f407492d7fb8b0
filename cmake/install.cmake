# SPDX-License-Identifier: Apache-2.0
#
# What `cmake --install` puts there for programs in C++: the rooms but the command line as Lightwell::ROOM of find_package(Lightwell),
# and the client as `pkg-config lightwell`.
include(CMakePackageConfigHelpers)

get_property(rooms GLOBAL PROPERTY lightwell_rooms)
list(REMOVE_ITEM rooms cli)
foreach(room ${rooms})
  install(TARGETS lightwell_${room} EXPORT LightwellTargets COMPONENT development)
  install(DIRECTORY lightwell/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lightwell COMPONENT development
          FILES_MATCHING PATTERN "*.h")
endforeach()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Lightwell)
file(CONFIGURE OUTPUT LightwellConfig.cmake @ONLY CONTENT [[
set(LIGHTWELL_CLIENT_ONLY @LIGHTWELL_CLIENT_ONLY@)
set(LIGHTWELL_ASSIMP @LIGHTWELL_ASSIMP@)
include(${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/LightwellTargets.cmake)
]])
write_basic_package_version_file(LightwellConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT LightwellTargets NAMESPACE Lightwell:: DESTINATION ${package_folder} COMPONENT development)
install(FILES ${PROJECT_BINARY_DIR}/LightwellConfig.cmake ${PROJECT_BINARY_DIR}/LightwellConfigVersion.cmake cmake/dependencies.cmake
        DESTINATION ${package_folder} COMPONENT development)

# A linker takes from these archives what the ones before them have asked for: what a client never calls is left out, and with it
# what only a baker needs.
set(archives -llightwell_transport -llightwell_client -llightwell_asset -llightwell_pack -llightwell_light -llightwell_texture
  -llightwell_mesh -llightwell_base -pthread)
list(JOIN archives " " archives)
file(RELATIVE_PATH to_prefix /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
file(CONFIGURE OUTPUT lightwell.pc @ONLY CONTENT [[
prefix=${pcfiledir}/@to_prefix@
Name: lightwell
Description: Streams packs of Lightwell: 3D scenes with their baked light
Version: @PROJECT_VERSION@
Cflags: -I${prefix}/@CMAKE_INSTALL_INCLUDEDIR@
Libs: -L${prefix}/@CMAKE_INSTALL_LIBDIR@ @archives@
]])
install(FILES ${PROJECT_BINARY_DIR}/lightwell.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
