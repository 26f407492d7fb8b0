// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/draco_counts.h"

#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

namespace lightwell {
namespace {

/// Scans take more than a byte for four faces; regular grids of one plane reach some hundreds a byte.
constexpr uint64_t most_a_byte = 512;
constexpr uint64_t always_allowed = 1 << 16;

constexpr uint16_t version_2_2 = DRACO_BITSTREAM_VERSION(2, 2);

/// Reads the two counts with which connectivity begins (Draco bitstream specification 2.2, "Connectivity Data").
bool read_counts(draco::DecoderBuffer& buffer, uint8_t method, uint32_t& first, uint32_t& second) {
  uint8_t traversal;
  if (method == draco::MESH_EDGEBREAKER_ENCODING && !buffer.Decode(&traversal)) return false;
  return draco::DecodeVarint(&first, &buffer) && draco::DecodeVarint(&second, &buffer);
}

}  // namespace

Result<void> check_draco_counts(Bytes stream, const std::string& name) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) return fail(name, "damaged Draco data");
  if (header.encoder_type != draco::TRIANGULAR_MESH)
    return fail(ErrorKind::unsupported, name, "its Draco data are no mesh");
  const auto version = static_cast<uint16_t>(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
  if (version < version_2_2)
    return fail(ErrorKind::unsupported, name, "its Draco data are older than version 2.2 of the bitstream");
  buffer.set_bitstream_version(version);
  draco::GeometryMetadata metadata;
  if ((header.flags & METADATA_FLAG_MASK) && !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
    return fail(name, "damaged Draco data");
  uint32_t vertices = 0, faces = 0;
  if (!read_counts(buffer, header.encoder_method, vertices, faces)) return fail(name, "damaged Draco data");
  if (std::max(vertices, faces) > always_allowed + most_a_byte * stream.size())
    return fail(ErrorKind::limit, name,
                "announces " + std::to_string(std::max(vertices, faces)) + " faces or vertices in " +
                    std::to_string(stream.size()) + " bytes");
  return {};
}

}  // namespace lightwell
