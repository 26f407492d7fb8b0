// SPDX-License-Identifier: Apache-2.0
#include "lightwell/texture/etc1s_decode.h"

#include <array>

#include "lightwell/texture/texel_block.h"

namespace lightwell {
namespace {

/// The bits of untrusted bytes, from the lowest of each on. A read past the end yields zeros and leaves the reader
/// failed for good, as what was read can be made to by whoever finds that it makes no sense.
class BitReader {
 public:
  explicit BitReader(Bytes bytes) : bytes_(bytes) {}

  uint32_t bit() {
    if (at_ / 8 == bytes_.size()) {
      failed_ = true;
      return 0;
    }
    const uint32_t bit = bytes_[at_ / 8] >> (at_ % 8) & 1u;
    at_++;
    return bit;
  }
  /// At most 32 bits, the lowest first.
  uint32_t bits(unsigned count) {
    uint32_t value = 0;
    for (unsigned i = 0; i < count; i++) value |= bit() << i;
    return value;
  }
  /// Appendix "ETC1S VLC Decoding Procedure": chunks of so many bits, after each a bit that tells of another.
  uint64_t chunks(unsigned count) {
    uint64_t value = 0;
    for (unsigned shift = 0; shift < 32; shift += count) {
      value |= uint64_t(bits(count)) << shift;
      if (bit() == 0) return value;
    }
    fail();
    return 0;
  }

  void fail() { failed_ = true; }
  bool ok() const { return !failed_; }

 private:
  Bytes bytes_;
  size_t at_ = 0;
  bool failed_ = false;
};

/// A canonical prefix code (RFC 1951, section 3.2.2), of no symbols at first.
class HuffmanTable {
 public:
  /// The code with such lengths, zero for symbols that it lacks. Lengths are at most 16. False when they are not those
  /// of a complete code; one symbol alone need not be one.
  bool assign(const std::vector<uint8_t>& lengths) {
    counts_.fill(0);
    for (const uint8_t length : lengths) counts_[length]++;
    counts_[0] = 0;
    std::array<size_t, longest_code + 1> next{};
    size_t taken = 0, used = 0;  // of all codes of 16 bits, and symbols
    for (size_t length = 1; length <= longest_code; length++) {
      next[length] = used;
      used += counts_[length];
      taken += counts_[length] << (longest_code - length);
    }
    if (used > 1 && taken != size_t(1) << longest_code) return false;
    symbols_.resize(used);
    for (size_t symbol = 0; symbol < lengths.size(); symbol++)
      if (lengths[symbol] > 0) symbols_[next[lengths[symbol]]++] = static_cast<uint16_t>(symbol);
    return true;
  }

  uint32_t decode(BitReader& bits) const {
    uint32_t code = 0, first = 0, before = 0;  // first: the lowest code of a length; before: symbols of shorter ones
    for (size_t length = 1; length <= longest_code; length++) {
      code = code << 1 | bits.bit();
      first <<= 1;
      if (code - first < counts_[length]) return symbols_[before + code - first];
      first += counts_[length];
      before += counts_[length];
    }
    bits.fail();
    return 0;
  }

 private:
  static constexpr size_t longest_code = 16;

  std::array<uint32_t, longest_code + 1> counts_{};  // symbols by the length of their codes
  std::vector<uint16_t> symbols_;                    // by their codes
};

/// The lengths of a table's codes, which are themselves coded: 0 to 16 as they are, then runs.
std::vector<uint8_t> read_code_lengths(BitReader& bits, const HuffmanTable& coder, size_t symbols) {
  struct Run {
    uint8_t count_bits, least;
    bool repeats;  ///< the length before it, else zero
  };
  constexpr uint32_t first_run = 17;
  constexpr std::array<Run, 4> runs = {{{3, 3, false}, {7, 11, false}, {2, 3, true}, {7, 7, true}}};
  std::vector<uint8_t> lengths;
  while (bits.ok() && lengths.size() < symbols) {
    const uint32_t code = coder.decode(bits);
    if (code < first_run) {
      lengths.push_back(static_cast<uint8_t>(code));
      continue;
    }
    const Run& run = runs[code - first_run];
    const uint8_t length = run.repeats && !lengths.empty() ? lengths.back() : 0;
    if (run.repeats && length == 0) bits.fail();
    lengths.insert(lengths.end(), run.least + bits.bits(run.count_bits), length);
  }
  if (lengths.size() != symbols) bits.fail();
  return lengths;
}

/// Appendix "Compressed Huffman Tables".
HuffmanTable read_huffman_table(BitReader& bits) {
  constexpr std::array<uint8_t, 21> order = {17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15, 16};
  HuffmanTable table;
  const size_t symbols = bits.bits(14);
  if (symbols == 0) return table;
  const size_t stored = bits.bits(5);
  if (stored == 0 || stored > order.size()) bits.fail();
  if (!bits.ok()) return table;
  std::vector<uint8_t> coder_lengths(order.size());
  for (size_t i = 0; i < stored; i++) coder_lengths[order[i]] = static_cast<uint8_t>(bits.bits(3));
  HuffmanTable coder;
  if (!coder.assign(coder_lengths)) bits.fail();
  const std::vector<uint8_t> lengths = read_code_lengths(bits, coder, symbols);
  if (!bits.ok() || !table.assign(lengths)) bits.fail();
  return table;
}

/// What the four colours of a block are made from.
struct Endpoint {
  std::array<uint8_t, 3> color;  ///< of five bits each
  uint8_t intensity;             ///< a row of the modifiers
};

/// Which of its block's four colours each texel has: a byte for each row, the left texel in the lowest two bits.
using Selector = std::array<uint8_t, 4>;

struct Codebooks {
  std::vector<Endpoint> endpoints;
  std::vector<Selector> selectors;
  HuffmanTable predictions, endpoint_deltas, selector_symbols, selector_runs;
  size_t history_size = 0;
};

/// Appendix "ETC1S Endpoint Codebooks".
std::vector<Endpoint> read_endpoints(BitReader& bits, size_t count) {
  std::array<HuffmanTable, 3> color_deltas;
  for (HuffmanTable& table : color_deltas) table = read_huffman_table(bits);
  const HuffmanTable intensity_deltas = read_huffman_table(bits);
  const size_t stored_channels = bits.bit() == 1 ? 1 : 3;
  Endpoint endpoint{{16, 16, 16}, 0};
  std::vector<Endpoint> endpoints;
  while (endpoints.size() < count && bits.ok()) {
    endpoint.intensity = (endpoint.intensity + intensity_deltas.decode(bits)) & 7;
    for (size_t c = 0; c < stored_channels; c++) {
      const uint8_t before = endpoint.color[c];
      endpoint.color[c] = (before + color_deltas[before < 10 ? 0 : before < 22 ? 1 : 2].decode(bits)) & 31;
    }
    if (stored_channels == 1) endpoint.color.fill(endpoint.color[0]);
    endpoints.push_back(endpoint);
  }
  return endpoints;
}

/// Appendix "ETC1S Selector Codebooks".
std::vector<Selector> read_selectors(BitReader& bits, size_t count) {
  if (bits.bits(2) != 0) bits.fail();
  const bool raw = bits.bit() == 1;
  const HuffmanTable deltas = raw ? HuffmanTable() : read_huffman_table(bits);
  Selector selector{};
  std::vector<Selector> selectors;
  while (selectors.size() < count && bits.ok()) {
    for (uint8_t& row : selector)
      row = static_cast<uint8_t>(raw || selectors.empty() ? bits.bits(8) : row ^ deltas.decode(bits));
    selectors.push_back(selector);
  }
  return selectors;
}

Result<Codebooks> read_codebooks(const Etc1sStreams& streams) {
  if (streams.endpoint_count == 0 || streams.selector_count == 0) return fail("KTX2", "an empty ETC1S codebook");
  Codebooks books;
  BitReader endpoints(streams.endpoints), selectors(streams.selectors), tables(streams.tables);
  books.endpoints = read_endpoints(endpoints, streams.endpoint_count);
  if (!endpoints.ok()) return fail("KTX2", "damaged ETC1S endpoints");
  books.selectors = read_selectors(selectors, streams.selector_count);
  if (!selectors.ok()) return fail("KTX2", "damaged ETC1S selectors");
  for (HuffmanTable* table :
       {&books.predictions, &books.endpoint_deltas, &books.selector_symbols, &books.selector_runs})
    *table = read_huffman_table(tables);
  books.history_size = tables.bits(13);
  if (!tables.ok()) return fail("KTX2", "damaged ETC1S tables");
  return books;
}

// A slice has the blocks row by row, for each an index of an endpoint and one of a selector (appendix "ETC1S Slice
// Block Decoding"), read by the two classes below from the same bits in turn.

/// The endpoint of each block: that of the block to the left, above, or left above, or one that is coded. Which of the
/// four it is, is told for two by two blocks at once.
class EndpointIndices {
 public:
  EndpointIndices(const Codebooks& books, BitReader& bits, size_t columns)
      : books_(books), bits_(bits), row_(columns), lower_predictions_((columns + 1) / 2) {}

  /// An index within the codebook; the bits have failed when there is none.
  size_t next(size_t x, size_t y) {
    if (x % 2 == 0) predictions_ = y % 2 == 0 ? read_predictions(x / 2) : lower_predictions_[x / 2];
    const uint32_t prediction = predictions_ & 3;
    predictions_ >>= 2;
    const bool from_left = prediction == 0 || prediction == 2, from_above = prediction == 1 || prediction == 2;
    if ((from_left && x == 0) || (from_above && y == 0)) bits_.fail();
    const size_t above = row_[x];
    if (prediction == 1) left_ = above;
    if (prediction == 2) left_ = left_above_;
    if (prediction == 3) left_ = coded();
    left_above_ = above;
    row_[x] = left_;
    return left_;
  }

 private:
  /// The predictions of the blocks (2 pair, y), (2 pair + 1, y) and those below, of two bits each.
  uint32_t read_predictions(size_t pair) {
    constexpr uint32_t repeat = 256, least_repeats = 3;
    if (repeats_ > 0) {
      repeats_--;
    } else {
      const uint32_t symbol = books_.predictions.decode(bits_);
      if (symbol == repeat)
        repeats_ = bits_.chunks(4) + least_repeats - 1;
      else
        repeated_ = symbol;
      if (symbol > repeat) bits_.fail();
    }
    lower_predictions_[pair] = static_cast<uint8_t>(repeated_ >> 4);
    return repeated_;
  }

  size_t coded() {
    const size_t count = books_.endpoints.size(), index = left_ + books_.endpoint_deltas.decode(bits_);
    if (index < count) return index;
    if (index >= 2 * count) bits_.fail();
    return index % count;
  }

  const Codebooks& books_;
  BitReader& bits_;
  std::vector<size_t> row_;                 // of the row above, from x on; of this row before
  std::vector<uint8_t> lower_predictions_;  // for the next row, which is an odd one
  size_t left_ = 0, left_above_ = 0;
  uint32_t predictions_ = 0, repeated_ = 0;
  uint64_t repeats_ = 0;
};

/// The selector of each block: coded, or one of those used lately.
class SelectorIndices {
 public:
  SelectorIndices(const Codebooks& books, BitReader& bits)
      : books_(books), bits_(bits), history_(books.history_size), oldest_(books.history_size / 2) {}

  /// An index within the codebook; the bits have failed when there is none.
  size_t next() {
    const size_t symbol = next_symbol(), count = books_.selectors.size();
    if (symbol < count) {
      remember(symbol);
      return symbol;
    }
    const size_t place = symbol - count;
    if (place >= history_.size()) {
      bits_.fail();
      return 0;
    }
    // Appendix "ETC1S Approximate Move to Front Routines".
    const size_t index = history_[place];
    std::swap(history_[place], history_[place / 2]);
    return index;
  }

 private:
  /// An index within the codebook, or behind those one within the history. Runs repeat the first of the latter.
  size_t next_symbol() {
    constexpr uint32_t least_run = 3, long_run = 63;
    const size_t first_of_history = books_.selectors.size();
    if (run_ == 0) {
      const size_t symbol = books_.selector_symbols.decode(bits_);
      if (symbol != first_of_history + history_.size()) return symbol;
      const uint32_t length = books_.selector_runs.decode(bits_);
      run_ = (length == long_run ? bits_.chunks(7) : length) + least_run;
    }
    run_--;
    return first_of_history;
  }

  void remember(size_t index) {
    if (history_.empty()) return;
    history_[oldest_++] = index;
    if (oldest_ == history_.size()) oldest_ = history_.size() / 2;
  }

  const Codebooks& books_;
  BitReader& bits_;
  std::vector<size_t> history_;
  size_t oldest_;  // in the half that is replaced in turn
  uint64_t run_ = 0;
};

using Color = std::array<uint8_t, 3>;

/// Khronos Data Format Specification 1.3, section 21.1 "ETC1S", and the intensity modifiers of ETC1.
std::array<Color, 4> colors_of(const Endpoint& endpoint) {
  constexpr std::array<std::array<int, 2>, 8> modifiers = {
      {{2, 8}, {5, 17}, {9, 29}, {13, 42}, {18, 60}, {24, 80}, {33, 106}, {47, 183}}};
  const auto [small, large] = modifiers[endpoint.intensity];
  const std::array<int, 4> offsets = {-large, -small, small, large};
  std::array<Color, 4> colors;
  for (size_t i = 0; i < colors.size(); i++) {
    for (size_t c = 0; c < 3; c++) {
      const int base = endpoint.color[c] << 3 | endpoint.color[c] >> 2;
      colors[i][c] = static_cast<uint8_t>(std::clamp(base + offsets[i], 0, 255));
    }
  }
  return colors;
}

/// Calls put(pixel, color) for all pixels of a slice; false when it is damaged.
template <typename Put>
bool decode_slice(const Codebooks& books, Bytes slice, Image& image, const Put& put) {
  const size_t columns = texel_blocks(static_cast<size_t>(image.width));
  const size_t rows = texel_blocks(static_cast<size_t>(image.height));
  BitReader bits(slice);
  EndpointIndices endpoints(books, bits, columns);
  SelectorIndices selectors(books, bits);
  for (size_t y = 0; y < rows; y++) {
    for (size_t x = 0; x < columns; x++) {
      const Endpoint& endpoint = books.endpoints[endpoints.next(x, y)];
      const Selector& selector = books.selectors[selectors.next()];
      if (!bits.ok()) return false;
      const std::array<Color, 4> colors = colors_of(endpoint);
      put_texel_block(image, x, y, [&](uint8_t* pixel, size_t texel) {
        put(pixel, colors[selector[texel / 4] >> (texel % 4 * 2) & 3]);
      });
    }
  }
  return true;
}

}  // namespace

Result<Image> decode_etc1s(const Etc1sStreams& streams, int width, int height) {
  LW_TRY(books, read_codebooks(streams));
  const bool alpha = !streams.second.empty() && streams.second_channel == 3;
  Image image{width, height, alpha ? 4 : 3, {}};
  image.pixels.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(image.channels));
  const auto put_color = [](uint8_t* pixel, const Color& color) { std::copy(color.begin(), color.end(), pixel); };
  if (!decode_slice(books, streams.colors, image, put_color)) return fail("KTX2", "damaged ETC1S slice of colour");
  // Encoders write the one channel into all three of a slice; transcoders read it from green.
  const auto put_second = [&](uint8_t* pixel, const Color& color) { pixel[streams.second_channel] = color[1]; };
  if (!streams.second.empty() && !decode_slice(books, streams.second, image, put_second))
    return fail("KTX2", "damaged ETC1S slice of the second channel");
  return image;
}

}  // namespace lightwell
