# SPDX-License-Identifier: Apache-2.0
#
# lightwell_room(NAME [DEPENDS rooms...] [LIBRARIES targets...] [BAKER_ONLY files...] [BAKER_LIBRARIES targets...])
#
# A room is the folder lightwell/NAME, the target lightwell_NAME and the includes "lightwell/NAME/..."; other projects
# call it Lightwell::NAME. DEPENDS are the arrows of docs/architecture.md; tests/arrows.sh reads them from here.
# BAKER_ONLY names files that a client is built without (encoders, the simplifier), natively (LIGHTWELL_CLIENT_ONLY) and as
# WebAssembly; BAKER_LIBRARIES is what these alone need.
set_property(GLOBAL PROPERTY lightwell_rooms "")

function(lightwell_room name)
  cmake_parse_arguments(ROOM "" "" "DEPENDS;LIBRARIES;BAKER_ONLY;BAKER_LIBRARIES" ${ARGN})
  set_property(GLOBAL APPEND PROPERTY lightwell_rooms ${name})
  set_property(GLOBAL PROPERTY lightwell_room_${name}_depends "${ROOM_DEPENDS}")
  set_property(GLOBAL PROPERTY lightwell_room_${name}_baker_only "${ROOM_BAKER_ONLY}")
  if(LIGHTWELL_CLIENT_ONLY)
    lightwell_client_sources(sources ${name})
  else()
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lightwell/${name}/*.cpp)
    list(APPEND ROOM_LIBRARIES ${ROOM_BAKER_LIBRARIES})
  endif()
  list(FILTER sources EXCLUDE REGEX "/(main|wasm[a-z_]*)\\.cpp$")
  if(sources)
    add_library(lightwell_${name} STATIC ${sources})
    set(scope PUBLIC)
  else()
    add_library(lightwell_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(Lightwell::${name} ALIAS lightwell_${name})
  set_target_properties(lightwell_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(lightwell_${name} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(lightwell_${name} ${scope} cxx_std_20)
  list(TRANSFORM ROOM_DEPENDS PREPEND lightwell_ OUTPUT_VARIABLE room_targets)
  target_link_libraries(lightwell_${name} ${scope} ${room_targets} ${ROOM_LIBRARIES})
endfunction()

# lightwell_client_sources(OUT rooms...): the sources of these rooms that a client is made of.
function(lightwell_client_sources out)
  set(all "")
  foreach(name ${ARGN})
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lightwell/${name}/*.cpp)
    get_property(baker_only GLOBAL PROPERTY lightwell_room_${name}_baker_only)
    foreach(file ${baker_only})
      list(REMOVE_ITEM sources ${PROJECT_SOURCE_DIR}/lightwell/${name}/${file})
    endforeach()
    list(APPEND all ${sources})
  endforeach()
  set(${out} ${all} PARENT_SCOPE)
endfunction()
