// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/base/vector.h"

namespace lightwell {

/// JSON that keeps the order of its keys, as a file that is written again should.
using Json = nlohmann::ordered_json;

/// Parses JSON (UTF-8, with or without a byte order mark) that nobody vouches for: at most 128 levels deep and 8192
/// keys an object, since what follows recurses over levels and looks keys up one by one. `place` is where the text
/// begins in its file, so that a syntax error can say at which byte it is.
Result<Json> parse_json(Bytes text, uint64_t place = 0);

// Lookups that never throw: what is missing or of another type reads as null or as the fallback.

/// The member `key` of an object, null when there is none.
const Json& member(const Json& object, const char* key);
/// The element of an array, null when there is none.
const Json& element(const Json& array, size_t index);
/// json["extensions"][name].
const Json& extension(const Json& object, const char* name);
double number(const Json& object, const char* key, double fallback);
bool boolean(const Json& object, const char* key, bool fallback);
std::string text(const Json& object, const char* key);
/// A whole number (also one written 3.0 or 3e0) in [0, 2^53]; -1 for all else.
int64_t whole_number(const Json& value);
/// An index into another array; -1 when it is missing.
int index_of(const Json& object, const char* key);

/// The double of fewest decimal digits that rounds to a float: as text it is half as long as the float's own value.
double shortest(float value);

/// An array of N numbers.
template <int N>
Vec<double, N> numbers(const Json& object, const char* key, Vec<double, N> fallback) {
  const Json& array = member(object, key);
  if (!array.is_array() || array.size() != N) return fallback;
  for (int i = 0; i < N; i++) {
    const Json& value = array[static_cast<size_t>(i)];
    if (value.is_number()) fallback[i] = value.get<double>();
  }
  return fallback;
}

/// "accessors[3]": the name of an element in errors and warnings.
std::string element_name(const char* array, size_t index);

}  // namespace lightwell
