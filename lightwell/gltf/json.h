// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lightwell/base/bytes.h"
#include "lightwell/base/result.h"
#include "lightwell/base/vector.h"

namespace lightwell {

/// JSON that keeps the order of its keys, so that rewriting a file does not change it.
using Json = nlohmann::ordered_json;

/// Parses untrusted JSON (UTF-8, with or without a byte order mark) of at most 128 levels and 8192 keys an object,
/// since later code recurses over levels and looks keys up one by one. `place` is the offset of the text in its file,
/// for the position of syntax errors.
Result<Json> parse_json(Bytes text, uint64_t place = 0);

/// The JSON as text without spaces; what is no UTF-8 in it is replaced.
std::string json_text(const Json& json);

// Lookups that never throw: a value that is missing or of another type reads as null or as the fallback.

/// The member `key` of an object, null when there is none.
const Json& member(const Json& object, const char* key);
/// The element of an array, null when out of range.
const Json& element(const Json& array, size_t index);
/// json["extensions"][name].
const Json& extension(const Json& object, const char* name);
double number(const Json& object, const char* key, double fallback);
bool boolean(const Json& object, const char* key, bool fallback);
std::string text(const Json& object, const char* key);
/// A whole number (also one written 3.0 or 3e0) in [0, 2^53]; -1 for anything else.
int64_t whole_number(const Json& value);
/// An index into another array; -1 when missing or invalid.
int index_of(const Json& object, const char* key);

/// The double with the fewest decimal digits that rounds to `value`. As text it is half as long as the exact value.
double shortest(float value);

/// An array of N numbers, or the fallback; an element that is not a number is taken from the fallback.
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
