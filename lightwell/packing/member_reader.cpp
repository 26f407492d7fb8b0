// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/member_reader.h"

#include <cmath>
#include <limits>

namespace lightwell {
namespace {

constexpr int32_t most = std::numeric_limits<int32_t>::max();

// Whether a JSON number, a double, is also finite as a float.
bool fits_float(const Json& value) {
  return value.is_number() && std::abs(value.get<double>()) <= static_cast<double>(std::numeric_limits<float>::max());
}

bool fits_whole(const Json& value) {
  const int64_t number = whole_number(value);
  return number >= 0 && number <= most;
}

// Reads an array of three numbers that all pass `fits`; returns false for anything else.
template <typename T, typename Fits>
bool read_three(const Json& value, const Fits& fits, Vec<T, 3>& three) {
  if (!value.is_array() || value.size() != 3) return false;
  for (const Json& number : value)
    if (!fits(number)) return false;
  for (int i = 0; i < 3; i++) three[i] = static_cast<T>(value[static_cast<size_t>(i)].get<double>());
  return true;
}

}  // namespace

Json to_json(float x) { return shortest(x); }
Json to_json(const Vec3f& v) { return Json::array({to_json(v[0]), to_json(v[1]), to_json(v[2])}); }
Json to_json(const Vec3i& v) { return Json::array({v[0], v[1], v[2]}); }

MemberReader::MemberReader(const Json& object, std::string name) : object_(object), name_(std::move(name)) {
  if (object.is_object()) return;
  error_.emplace("", name_, object.is_null() ? "is missing" : "is no object");
}

bool MemberReader::has(const char* key) const { return object_.is_object() && object_.contains(key); }

float MemberReader::real(const char* key) {
  const Json& value = member(object_, key);
  if (fits_float(value)) return static_cast<float>(value.get<double>());
  refuse(key, "is no finite number");
  return 0;
}

Vec3f MemberReader::vector(const char* key) {
  Vec3f vector{};
  if (!read_three(member(object_, key), fits_float, vector)) refuse(key, "is not three finite numbers");
  return vector;
}

Vec3d MemberReader::exact_vector(const char* key) {
  const auto fits = [](const Json& value) { return value.is_number() && std::abs(value.get<double>()) <= 1e30; };
  Vec3d vector{};
  if (!read_three(member(object_, key), fits, vector)) refuse(key, "is not three finite numbers");
  return vector;
}

Vec3i MemberReader::whole_vector(const char* key) {
  Vec3i vector{};
  if (!read_three(member(object_, key), fits_whole, vector)) refuse(key, "is not three whole numbers");
  return vector;
}

uint32_t MemberReader::whole(const char* key) {
  const Json& value = member(object_, key);
  if (fits_whole(value)) return static_cast<uint32_t>(whole_number(value));
  refuse(key, "is no whole number");
  return 0;
}

std::string MemberReader::string(const char* key) {
  if (!member(object_, key).is_string()) refuse(key, "is no string");
  return text(object_, key);
}

bool MemberReader::flag(const char* key) {
  if (has(key) && !member(object_, key).is_boolean()) refuse(key, "is neither true nor false");
  return boolean(object_, key, false);
}

const Json& MemberReader::array(const char* key) {
  static const Json empty = Json::array();
  const Json& value = member(object_, key);
  if (value.is_array()) return value;
  refuse(key, "is no array");
  return empty;
}

const Json& MemberReader::object(const char* key) {
  static const Json empty = Json::object();
  const Json& value = member(object_, key);
  if (value.is_object()) return value;
  refuse(key, "is no object");
  return empty;
}

void MemberReader::refuse(const char* key, const std::string& reason) {
  if (error_) return;
  error_.emplace("", name_ + "." + key, has(key) ? reason : "is missing");
}

std::string MemberReader::name_of(const char* key, size_t index) const {
  return name_ + "." + element_name(key, index);
}

}  // namespace lightwell
