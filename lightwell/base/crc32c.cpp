// SPDX-License-Identifier: Apache-2.0
#include "lightwell/base/crc32c.h"

#include <array>

namespace lightwell {
namespace {

// Slicing by eight: tables[k][b] is the CRC of byte b followed by k zero bytes.
std::array<std::array<uint32_t, 256>, 8> make_tables() {
  std::array<std::array<uint32_t, 256>, 8> tables{};
  for (uint32_t b = 0; b < 256; b++) {
    uint32_t crc = b;
    for (int bit = 0; bit < 8; bit++) crc = crc & 1 ? crc >> 1 ^ 0x82f63b78u : crc >> 1;
    tables[0][b] = crc;
  }
  for (uint32_t b = 0; b < 256; b++)
    for (size_t k = 1; k < 8; k++) tables[k][b] = tables[k - 1][b] >> 8 ^ tables[0][tables[k - 1][b] & 255];
  return tables;
}

// Built at start-up: as constants they would add 8 KB to the page that no compression reduces.
const auto tables = make_tables();

}  // namespace

uint32_t crc32c(Bytes bytes, uint32_t seed) {
  uint32_t crc = ~seed;
  size_t at = 0;
  for (; bytes.size() - at >= 8; at += 8) {
    const uint8_t* p = bytes.data() + at;
    crc ^= uint32_t(p[0]) | uint32_t(p[1]) << 8 | uint32_t(p[2]) << 16 | uint32_t(p[3]) << 24;
    crc = tables[7][crc & 255] ^ tables[6][crc >> 8 & 255] ^ tables[5][crc >> 16 & 255] ^ tables[4][crc >> 24] ^
          tables[3][p[4]] ^ tables[2][p[5]] ^ tables[1][p[6]] ^ tables[0][p[7]];
  }
  for (; at < bytes.size(); at++) crc = crc >> 8 ^ tables[0][(crc ^ bytes[at]) & 255];
  return ~crc;
}

}  // namespace lightwell
