// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/meshopt_vertices.h"

#include <algorithm>
#include <array>

namespace lightwell {
namespace {

constexpr size_t group_size = 16;
constexpr size_t least_tail = 24;

size_t block_size(size_t stride) { return std::min<size_t>(8192 / stride / group_size * group_size, 256); }

/// How the deltas of one byte column of a block are stored.
enum class Control { narrow, wide, zero, literal };

/// Bits per delta in a group, by control mode and the two header bits of the group.
constexpr int bits_of[2][4] = {{0, 1, 2, 4}, {1, 2, 4, 8}};

template <typename T>
T unzigzag(T value) {
  return static_cast<T>((value >> 1) ^ static_cast<T>(-static_cast<T>(value & 1)));
}

/// Decodes block by block. Each element is coded as its difference from the one before it, the first from that in the
/// tail.
class VertexDecoder {
 public:
  VertexDecoder(Bytes body, Bytes last, Bytes channels, size_t stride)
      : reader_(body), last_(last.begin(), last.end()), channels_(channels), stride_(stride) {}

  bool decode_block(std::span<uint8_t> elements) {
    const size_t count = elements.size() / stride_;
    const Bytes control = reader_.take(stride_ / 4);
    if (!reader_.ok()) return false;
    for (size_t column = 0; column < stride_; column++)
      read_column(static_cast<Control>(control[column / 4] >> (2 * (column % 4)) & 3), count, deltas_[column % 4],
                  column, elements);
    return reader_.ok();
  }

  bool finished() const { return reader_.ok() && reader_.remaining() == 0; }

 private:
  using Column = std::array<uint8_t, 256>;

  /// Reads one byte column. Every four columns form a channel, whose deltas are added up once all four are read.
  void read_column(Control control, size_t count, Column& deltas, size_t column, std::span<uint8_t> elements) {
    deltas.fill(0);
    if (control == Control::literal) {
      const Bytes bytes = reader_.take(count);
      std::copy(bytes.begin(), bytes.end(), deltas.begin());
    } else if (control != Control::zero) {
      read_groups(bits_of[control == Control::wide], count, deltas);
    }
    if (column % 4 == 3) add_up(column - 3, count, elements);
  }

  void read_groups(const int (&bits)[4], size_t count, Column& deltas) {
    const size_t groups = (count + group_size - 1) / group_size;
    const Bytes header = reader_.take((groups + 3) / 4);
    if (!reader_.ok()) return;
    for (size_t g = 0; g < groups; g++) read_group(bits[header[g / 4] >> (2 * (g % 4)) & 3], &deltas[g * group_size]);
  }

  /// Reads sixteen deltas of 0, 1, 2, 4 or 8 bits each. With 1, 2 or 4 bits, a delta with all bits set is an escape for
  /// a whole byte that follows the group.
  void read_group(int bits, uint8_t* deltas) {
    const Bytes packed = reader_.take(group_size * static_cast<size_t>(bits) / 8);
    if (bits == 0 || !reader_.ok()) return;
    const int sentinel = (1 << bits) - 1;
    const size_t per_byte = 8 / static_cast<size_t>(bits);
    for (size_t i = 0; i < group_size; i++) {
      const size_t place = i % per_byte;
      const size_t shift = static_cast<size_t>(bits) * (bits == 1 ? place : per_byte - 1 - place);
      deltas[i] = static_cast<uint8_t>(packed[i / per_byte] >> shift & sentinel);
      if (bits < 8 && deltas[i] == sentinel) deltas[i] = reader_.u8();
    }
  }

  void add_up(size_t column, size_t count, std::span<uint8_t> elements) {
    const uint8_t mode = channels_[column / 4];
    uint8_t* last = &last_[column];
    for (size_t i = 0; i < count; i++) {
      const std::array<uint8_t, 4> delta = {deltas_[0][i], deltas_[1][i], deltas_[2][i], deltas_[3][i]};
      if (mode == 0) add_bytes(delta, last);
      if (mode == 1) add_halves(delta, last);
      if ((mode & 15) == 2) change_bits(delta, mode >> 4, last);
      std::copy(last, last + 4, &elements[i * stride_ + column]);
    }
  }

  static void add_bytes(const std::array<uint8_t, 4>& delta, uint8_t* last) {
    for (size_t k = 0; k < 4; k++) last[k] = static_cast<uint8_t>(last[k] + unzigzag(delta[k]));
  }

  static void add_halves(const std::array<uint8_t, 4>& delta, uint8_t* last) {
    for (size_t k = 0; k < 4; k += 2) {
      const auto change = unzigzag(static_cast<uint16_t>(delta[k] | delta[k + 1] << 8));
      const auto value = static_cast<uint16_t>((last[k] | last[k + 1] << 8) + change);
      last[k] = static_cast<uint8_t>(value);
      last[k + 1] = static_cast<uint8_t>(value >> 8);
    }
  }

  static void change_bits(const std::array<uint8_t, 4>& delta, int rotation, uint8_t* last) {
    ByteReader word(delta);
    const uint32_t change = std::rotr(word.u32(), rotation);
    for (size_t k = 0; k < 4; k++) last[k] ^= static_cast<uint8_t>(change >> (8 * k));
  }

  ByteReader reader_;
  std::vector<uint8_t> last_;
  Bytes channels_;
  size_t stride_;
  std::array<Column, 4> deltas_{};
};

bool is_valid_channel(uint8_t mode) { return mode <= 2 || (mode & 15) == 2; }

}  // namespace

double least_bytes_v1(size_t count, size_t stride) {
  return static_cast<double>(count) / 256 * static_cast<double>(stride) / 4;
}

std::optional<std::vector<uint8_t>> decode_meshopt_vertices_v1(Bytes packed, size_t count, size_t stride) {
  const size_t tail = stride + stride / 4;
  const size_t padded_tail = std::max(tail, least_tail);
  if (packed.size() < 1 + padded_tail || packed[0] != meshopt_vertices_v1) return std::nullopt;
  const Bytes body = packed.subspan(1, packed.size() - 1 - padded_tail);
  const Bytes last = packed.subspan(packed.size() - tail, stride);
  const Bytes channels = packed.last(stride / 4);
  if (!std::all_of(channels.begin(), channels.end(), is_valid_channel)) return std::nullopt;

  std::vector<uint8_t> elements(count * stride);
  VertexDecoder decoder(body, last, channels, stride);
  const size_t block = block_size(stride) * stride;
  for (size_t at = 0; at < elements.size(); at += block)
    if (!decoder.decode_block(std::span(elements).subspan(at, std::min(block, elements.size() - at))))
      return std::nullopt;
  if (!decoder.finished()) return std::nullopt;
  return elements;
}

}  // namespace lightwell
