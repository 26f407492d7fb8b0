# SPDX-License-Identifier: Apache-2.0
#
# lightwell_room(NAME [DEPENDS rooms...] [LIBRARIES targets...] [BAKER_ONLY files...] [PROGRAM])
#
# A room is the folder lightwell/NAME, the target lightwell_NAME and the includes "lightwell/NAME/...".
# DEPENDS are the arrows of docs/architecture.md; tests/arrows.sh reads them from here.
# BAKER_ONLY names files that the client's WebAssembly build leaves out (encoders, the simplifier).
set_property(GLOBAL PROPERTY lightwell_rooms "")

function(lightwell_room name)
  cmake_parse_arguments(ROOM "" "" "DEPENDS;LIBRARIES;BAKER_ONLY" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lightwell/${name}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/(main|wasm[a-z_]*)\\.cpp$")
  if(sources)
    add_library(lightwell_${name} STATIC ${sources})
    set(scope PUBLIC)
  else()
    add_library(lightwell_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(lightwell_${name} ${scope} ${PROJECT_SOURCE_DIR})
  target_compile_features(lightwell_${name} ${scope} cxx_std_20)
  list(TRANSFORM ROOM_DEPENDS PREPEND lightwell_ OUTPUT_VARIABLE room_targets)
  target_link_libraries(lightwell_${name} ${scope} ${room_targets} ${ROOM_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY lightwell_rooms ${name})
  set_property(GLOBAL PROPERTY lightwell_room_${name}_depends "${ROOM_DEPENDS}")
  set_property(GLOBAL PROPERTY lightwell_room_${name}_baker_only "${ROOM_BAKER_ONLY}")
endfunction()

# lightwell_client_sources(OUT rooms...): the sources of these rooms that the WebAssembly client is made of.
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
