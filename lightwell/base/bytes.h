// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

using Bytes = std::span<const uint8_t>;

/// A cursor that reads little-endian fields from untrusted bytes. A read past the end yields zero and leaves the cursor
/// failed for good, so a decoder may read a whole header and ask ok() once, before it allocates anything.
class ByteReader {
 public:
  explicit ByteReader(Bytes bytes) : bytes_(bytes) {}

  uint8_t u8() { return integer<uint8_t>(); }
  uint16_t u16() { return integer<uint16_t>(); }
  uint32_t u32() { return integer<uint32_t>(); }
  uint64_t u64() { return integer<uint64_t>(); }
  float f32() { return std::bit_cast<float>(u32()); }
  double f64() { return std::bit_cast<double>(u64()); }
  /// The next n bytes; empty and failed when there are fewer.
  Bytes take(size_t n) {
    if (n > remaining()) {
      failed_ = true;
      at_ = bytes_.size();
      return {};
    }
    at_ += n;
    return bytes_.subspan(at_ - n, n);
  }

  bool ok() const { return !failed_; }
  size_t position() const { return at_; }
  size_t remaining() const { return bytes_.size() - at_; }

 private:
  template <typename T>
  T integer() {
    const Bytes field = take(sizeof(T));
    T value = 0;
    for (size_t i = 0; i < field.size(); i++) value = static_cast<T>(value | static_cast<T>(field[i]) << (8 * i));
    return value;
  }

  Bytes bytes_;
  size_t at_ = 0;
  bool failed_ = false;
};

/// A growing array of bytes to which little-endian fields are appended.
class ByteWriter {
 public:
  void u8(uint8_t value) { integer(value); }
  void u16(uint16_t value) { integer(value); }
  void u32(uint32_t value) { integer(value); }
  void u64(uint64_t value) { integer(value); }
  void f32(float value) { integer(std::bit_cast<uint32_t>(value)); }
  void f64(double value) { integer(std::bit_cast<uint64_t>(value)); }
  void append(Bytes more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }
  /// Pads with `filler` to a multiple of `alignment` bytes.
  void align(size_t alignment, uint8_t filler = 0) {
    while (bytes_.size() % alignment != 0) bytes_.push_back(filler);
  }

  size_t size() const { return bytes_.size(); }
  const std::vector<uint8_t>& bytes() const { return bytes_; }
  std::vector<uint8_t> release() { return std::move(bytes_); }

 private:
  template <typename T>
  void integer(T value) {
    for (size_t i = 0; i < sizeof(T); i++) bytes_.push_back(static_cast<uint8_t>(value >> (8 * i)));
  }

  std::vector<uint8_t> bytes_;
};

inline Bytes as_bytes(std::string_view text) { return {reinterpret_cast<const uint8_t*>(text.data()), text.size()}; }

}  // namespace lightwell
