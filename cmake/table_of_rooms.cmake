# SPDX-License-Identifier: Apache-2.0
#
# The rooms and their arrows, once. docs/architecture.md says what each room knows; the test
# "arrows" fails when an include runs against this table.
lightwell_room(base LIBRARIES Threads::Threads tl::expected
               BAKER_ONLY parallel_threads.cpp gzip.cpp file.cpp fingerprint.cpp BAKER_LIBRARIES ZLIB::ZLIB)
lightwell_room(mesh DEPENDS base BAKER_ONLY connected_faces.cpp part_table.cpp winding.cpp quantize.cpp collapse.cpp collapse_state.cpp progressive.cpp stream_encode.cpp)
lightwell_room(texture DEPENDS base
               BAKER_ONLY bmp_tga_file.cpp image_file.cpp orientation.cpp png_file.cpp jpeg_file.cpp webp_file.cpp ktx2_file.cpp etc1s_decode.cpp
               uastc_decode.cpp radiance_hdr.cpp mip.cpp stream_encode.cpp
               BAKER_LIBRARIES PNG::PNG JPEG::JPEG PkgConfig::WEBP PkgConfig::ZSTD)
lightwell_room(light DEPENDS base BAKER_ONLY stream_encode.cpp lattice_encode.cpp record_encode.cpp)
lightwell_room(pack DEPENDS base BAKER_ONLY content_hash.cpp reader.cpp writer.cpp)
lightwell_room(asset DEPENDS pack light mesh texture base)
lightwell_room(client DEPENDS asset pack light base)
lightwell_room(transport DEPENDS client base LIBRARIES Boost::headers)
if(LIGHTWELL_CLIENT_ONLY)
  return()
endif()

target_include_directories(lightwell_texture SYSTEM PRIVATE ${STB_INCLUDE})
lightwell_room(gltf DEPENDS mesh texture base LIBRARIES nlohmann_json::nlohmann_json draco::draco meshoptimizer::meshoptimizer)
lightwell_room(scene DEPENDS gltf mesh texture base LIBRARIES tinyobjloader::tinyobjloader)
if(LIGHTWELL_ASSIMP)
  target_link_libraries(lightwell_scene PUBLIC assimp::assimp)
  target_compile_definitions(lightwell_scene PUBLIC LIGHTWELL_ASSIMP)
else()
  set_source_files_properties(${PROJECT_SOURCE_DIR}/lightwell/scene/import_assimp.cpp PROPERTIES HEADER_FILE_ONLY ON)
endif()
lightwell_room(trace DEPENDS scene mesh texture base LIBRARIES embree)
lightwell_room(render DEPENDS trace light scene texture base LIBRARIES tinyexr::tinyexr)
lightwell_room(bake DEPENDS trace light scene mesh base)
lightwell_room(packing DEPENDS asset pack light mesh texture gltf scene base)
lightwell_room(server DEPENDS pack base LIBRARIES Boost::headers)
find_package(CLI11 REQUIRED)
lightwell_room(cli DEPENDS base mesh texture gltf light pack asset scene trace bake packing render client transport server
               LIBRARIES CLI11::CLI11)
