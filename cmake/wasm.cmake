# SPDX-License-Identifier: Apache-2.0
#
# lightwell_client_wasm: the client's rooms as lib/lightwell.wasm, a WebAssembly module that imports nothing. CMake knows one
# C++ compiler a project, so this one is called by custom commands, an object a source file.
find_program(LIGHTWELL_WASM_CXX clang++-19 REQUIRED)

set(wasm_folder ${CMAKE_BINARY_DIR}/wasm)
set(wasm_module ${CMAKE_BINARY_DIR}/lib/lightwell.wasm)
# For size: docs/decisions/008-size-of-the-page.md. -O2 for base, mesh and light adds 7 KB in brotli; a pack of 400 k triangles is
# then decoded in 0.43 instead of 0.54 s of CPU time, in a worker, while its bytes take longer to come.
set(wasm_flags --target=wasm32-wasi -std=c++20 -Oz -flto -fwhole-program-vtables -fno-exceptions -fno-rtti -fvisibility=hidden -ffunction-sections
  -msimd128 -mbulk-memory -mnontrapping-fptoint -msign-ext -ffp-contract=off
  -DNDEBUG -Wall -Wextra -Wshadow -I${PROJECT_SOURCE_DIR} -isystem ${wasm_folder}/include)
if(LIGHTWELL_WERROR)
  list(APPEND wasm_flags -Werror)
endif()

# Of the system's headers the module needs tl::expected alone; the others are for another machine.
find_path(LIGHTWELL_EXPECTED_INCLUDE tl/expected.hpp REQUIRED)
file(MAKE_DIRECTORY ${wasm_folder}/include ${CMAKE_BINARY_DIR}/lib)
file(CREATE_LINK ${LIGHTWELL_EXPECTED_INCLUDE}/tl ${wasm_folder}/include/tl SYMBOLIC)

# lightwell_wasm_objects(OUT sources...): compiles these sources, each once in the project, and returns their objects.
function(lightwell_wasm_objects out)
  set(objects "")
  foreach(source ${ARGN})
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${source})
    string(REPLACE "/" "_" name ${name})
    set(object ${wasm_folder}/${name}.o)
    add_custom_command(OUTPUT ${object}
      COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} ${LIGHTWELL_WASM_CXX} ${wasm_flags} -MD -MF ${object}.d -c ${source} -o ${object}
      DEPENDS ${source} DEPFILE ${object}.d COMMENT "Building WebAssembly object ${name}.o" VERBATIM)
    list(APPEND objects ${object})
  endforeach()
  set(${out} ${objects} PARENT_SCOPE)
endfunction()

lightwell_client_sources(wasm_sources base mesh light texture pack asset client)
lightwell_wasm_objects(wasm_objects ${wasm_sources})

# Clang calls wasm-opt by itself where it is installed, but does not tell it that the linker keeps the first 1024 bytes of memory
# free, so that a pointer with a small offset cannot wrap round.
find_program(LIGHTWELL_WASM_OPT wasm-opt)
set(wasm_shorten "")
if(LIGHTWELL_WASM_OPT)
  set(wasm_shorten COMMAND ${LIGHTWELL_WASM_OPT} --strip-target-features -Oz --flatten --rereloop -Oz -Oz --low-memory-unused
                           ${wasm_module} -o ${wasm_module})
endif()
# What is inlined is what gets shorter by it (docs/decisions/008-size-of-the-page.md): -Oz alone inlines more at this point.
add_custom_command(OUTPUT ${wasm_module}
  COMMAND ${LIGHTWELL_WASM_CXX} --target=wasm32-wasi -mexec-model=reactor -Oz -flto -fwhole-program-vtables
          -Wl,--gc-sections -Wl,--strip-all -Wl,-mllvm,-inline-threshold=-20 ${wasm_objects} -o ${wasm_module}
  ${wasm_shorten}
  DEPENDS ${wasm_objects} COMMENT "Linking lib/lightwell.wasm" VERBATIM)
add_custom_target(lightwell_client_wasm ALL DEPENDS ${wasm_module})
