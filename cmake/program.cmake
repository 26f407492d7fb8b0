# SPDX-License-Identifier: Apache-2.0
#
# The program with what it comes with, in the build folder as where it is installed: bin/, and in share/ the page, the manual page
# and the completion for bash. And the Debian package of it, which `cpack` makes.
set(share ${PROJECT_BINARY_DIR}/share)
set(manual_folder ${share}/man/man1)
set(completion_folder ${share}/bash-completion/completions)
file(MAKE_DIRECTORY ${share}/lightwell ${manual_folder} ${completion_folder})
# web/build.mjs makes the page.
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/web/dist ${share}/lightwell/page SYMBOLIC)
add_custom_command(TARGET lightwell POST_BUILD
  COMMAND lightwell help --man > ${manual_folder}/lightwell.1
  COMMAND gzip --best --no-name --force ${manual_folder}/lightwell.1
  COMMAND lightwell help --completion > ${completion_folder}/lightwell)

if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
# The program is packed before the tests are built.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
install(TARGETS lightwell COMPONENT program)
install(DIRECTORY ${share}/man ${share}/bash-completion TYPE DATA COMPONENT program)
install(DIRECTORY web/dist/ DESTINATION ${CMAKE_INSTALL_DATADIR}/lightwell/page COMPONENT program FILES_MATCHING
        PATTERN index.html PATTERN page*.js PATTERN worker.js PATTERN style.css PATTERN lightwell.wasm PATTERN LICENSE PATTERN types EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/lightwell RENAME copyright COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME lightwell)
set(CPACK_DEBIAN_PROGRAM_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS xdg-utils)
set(CPACK_PACKAGE_CONTACT "The maintainers of Lightwell <lightwell@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "bakes the light of 3D scenes and streams them to browsers")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
include(CPack)
