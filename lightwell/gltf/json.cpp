// SPDX-License-Identifier: Apache-2.0
#include "lightwell/gltf/json.h"

#include <array>
#include <charconv>
#include <cmath>

namespace lightwell {
namespace {

const Json null;

constexpr size_t max_depth = 128;
constexpr size_t max_keys = 8192;

/// Checks the limits on levels and keys before anything is built. Syntax errors are left to the parser.
Result<void> check_shape(Bytes text) {
  std::vector<size_t> keys;  // number of keys in each open object or array
  bool in_string = false;
  for (size_t i = 0; i < text.size(); i++) {
    const uint8_t c = text[i];
    if (in_string) {
      if (c == '\\') i++;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if (c == '{' || c == '[') keys.push_back(0);
    if ((c == '}' || c == ']') && !keys.empty()) keys.pop_back();
    if (c == ':' && !keys.empty() && ++keys.back() > max_keys)
      return fail(ErrorKind::limit, "JSON", "an object has more than " + std::to_string(max_keys) + " keys");
    if (keys.size() > max_depth)
      return fail(ErrorKind::limit, "JSON", "is nested deeper than " + std::to_string(max_depth) + " levels");
  }
  return {};
}

}  // namespace

Result<Json> parse_json(Bytes text, uint64_t place) {
  const size_t whole = text.size();
  constexpr uint8_t mark[] = {0xef, 0xbb, 0xbf};
  if (text.size() >= 3 && std::equal(mark, mark + 3, text.begin())) text = text.subspan(3);
  LW_CHECK(check_shape(text));
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    const size_t read = whole - text.size() + std::max<size_t>(error.byte, 1);  // up to and including the error
    return fail({"", "JSON", "syntax error", ErrorKind::bad_input, place + read - 1});
  } catch (const Json::exception&) {
    return fail("JSON", "holds a number that is too large");
  }
}

std::string json_text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

const Json& member(const Json& object, const char* key) {
  if (!object.is_object()) return null;
  const auto found = object.find(key);
  return found == object.end() ? null : *found;
}

const Json& element(const Json& array, size_t index) {
  return array.is_array() && index < array.size() ? array[index] : null;
}

const Json& extension(const Json& object, const char* name) { return member(member(object, "extensions"), name); }

double number(const Json& object, const char* key, double fallback) {
  const Json& value = member(object, key);
  return value.is_number() ? value.get<double>() : fallback;
}

bool boolean(const Json& object, const char* key, bool fallback) {
  const Json& value = member(object, key);
  return value.is_boolean() ? value.get<bool>() : fallback;
}

std::string text(const Json& object, const char* key) {
  const Json& value = member(object, key);
  return value.is_string() ? value.get<std::string>() : std::string();
}

int64_t whole_number(const Json& value) {
  if (!value.is_number()) return -1;
  const double number = value.get<double>();
  return number >= 0 && number <= 0x1p53 && std::floor(number) == number ? static_cast<int64_t>(number) : -1;
}

double shortest(float value) {
  std::array<char, 32> digits;
  double rounded = value;
  const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  std::from_chars(digits.data(), end, rounded);
  return rounded;
}

int index_of(const Json& object, const char* key) {
  const int64_t index = whole_number(member(object, key));
  return index <= std::numeric_limits<int>::max() ? static_cast<int>(index) : -1;
}

std::string element_name(const char* array, size_t index) {
  return std::string(array) + "[" + std::to_string(index) + "]";
}

}  // namespace lightwell
