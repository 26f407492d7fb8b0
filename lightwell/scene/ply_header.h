// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"

namespace lightwell {

enum class PlyFormat { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a number in a binary file.
size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  ///< of the value, or of each of the list's
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// The header of a PLY file: the format of its data and the elements that follow (Turk, "The PLY Polygon File Format",
/// 1994).
struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> textures;  ///< of "comment TextureFile NAME", as MeshLab and others write
  size_t size = 0;                    ///< length of the header in bytes: the data begin there
};

/// Reads a header whose lines end in LF, CRLF or CR. Fails when a line is not understood, or when the file is too short
/// to hold as many elements as are announced.
Result<PlyHeader> read_ply_header(Bytes file);

}  // namespace lightwell
