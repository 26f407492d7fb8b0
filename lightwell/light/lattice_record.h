// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lightwell/light/grid.h"

namespace lightwell {

/// How the light of a node is written as whole numbers (docs/format.md, "Records"). The numbers are those of the
/// format.
enum class LightRecord : uint8_t {
  moments,             ///< E in steps of its logarithm, S as shares: the default
  shared_exponent,     ///< the record of the order of slices (light/record.h), without loss
  floats,              ///< the moments as they are
  direction_colour,    ///< of S08: for each axis direction one direction for three colours, and their irradiance
  direction_magnitude  ///< of R09: the same direction, and the lengths of the three vectors
};
inline constexpr int light_records = 5;

/// A number of a record: what is expected of it, and which models code how it differs.
struct RecordNumber {
  enum class Expected : uint8_t {
    mean,     ///< that of the parents
    largest,  ///< of the parents; an exponent
    scaled    ///< the mean in units of two to the power of the number at `exponent`
  };
  /// Red and blue are expected to deviate as green has, nearly: by as much, or in proportion.
  enum class Colour : uint8_t { alone, leads, follows, follows_in_proportion };

  int32_t least = 0, most = 0;
  uint8_t models = 0;   ///< the set of models, 0 ... LatticeRecord::most_models - 1
  bool begins = false;  ///< what has been coded of the node before says nothing of its noise
  Expected expected = Expected::mean;
  Colour colour = Colour::alone;
  uint8_t exponent = 0;
};

/// A record: a table of numbers, and what they stand for.
class LatticeRecord {
 public:
  static constexpr size_t most_numbers = 42, most_models = 7;

  virtual ~LatticeRecord() = default;
  LightRecord kind() const { return kind_; }
  /// By which E is taken.
  float scale() const { return scale_; }
  /// The numbers in the order in which they are coded.
  std::span<const RecordNumber> numbers() const { return numbers_; }
  /// Finite for any numbers, and the same on every machine.
  virtual Moments decode(std::span<const int32_t> numbers) const = 0;

 protected:
  LatticeRecord(LightRecord kind, float scale) : kind_(kind), scale_(scale) {}
  /// Adds the three of a colour, green first.
  void add_colour(RecordNumber number, RecordNumber::Colour follows);

  const LightRecord kind_;
  const float scale_;
  std::vector<RecordNumber> numbers_;
};

/// The nearest numbers of a record to the light of a node. Bakers alone need it.
void encode_numbers(const LatticeRecord& record, const Moments& moments, std::span<int32_t> numbers);

/// `steps` to an octave of E is of LightRecord::moments only, a power of two from least_steps to most_steps. E is
/// taken `scale` times: see light_scale.
std::unique_ptr<const LatticeRecord> make_lattice_record(LightRecord record, int steps, float scale);

inline constexpr int least_steps = 4, most_steps = 256;

// Each has a file of its own.
std::unique_ptr<const LatticeRecord> moments_record(int steps, float scale);
std::unique_ptr<const LatticeRecord> shared_exponent_record(float scale);
std::unique_ptr<const LatticeRecord> floats_record(float scale);
std::unique_ptr<const LatticeRecord> direction_colour_record(float scale);
std::unique_ptr<const LatticeRecord> direction_magnitude_record(float scale);

/// The colours in the order in which they are coded: green, red, blue.
inline constexpr std::array<int, 3> coded_colours{1, 0, 2};
/// Of LightRecord::moments: added to the scaled E, below it nothing is told apart, a 16,000th of the largest.
inline constexpr float moments_darkness = 0x1p-4f;
/// Of LightRecord::floats, of a scaled unit: what is smaller is 0, a 2^-30th of the largest E.
inline constexpr float smallest_float = 0x1p-20f, largest_float = 0x1p12f;
/// Of the records of directions: the largest component, and the largest half.
inline constexpr int32_t direction_end = 127, largest_half = 0x7bff;

/// The numbers of many nodes: of each those of its record, then 1 or 0, whether it is valid.
class LatticeNumbers {
 public:
  LatticeNumbers() = default;
  LatticeNumbers(size_t nodes, size_t numbers) : stride_(numbers + 1), numbers_(nodes * stride_) {}

  std::span<int32_t> operator[](size_t node) { return {numbers_.data() + node * stride_, stride_}; }
  std::span<const int32_t> operator[](size_t node) const { return {numbers_.data() + node * stride_, stride_}; }
  /// Asks the memory for them.
  [[gnu::always_inline]] void prefetch(size_t node) const {
    constexpr size_t numbers_a_line = 16;
    const int32_t* numbers = numbers_.data() + node * stride_;
    for (size_t i = 0; i < stride_; i += numbers_a_line) __builtin_prefetch(numbers + i);
  }

 private:
  size_t stride_ = 1;
  std::vector<int32_t> numbers_;
};

}  // namespace lightwell
