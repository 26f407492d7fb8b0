// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "lightwell/gltf/json.h"

namespace lightwell {

/// A float as the JSON of a pack has it: the shortest text that reads back as the same float.
Json to_json(float x);
/// Three floats, or three whole numbers, as an array.
Json to_json(const Vec3f& v);
Json to_json(const Vec3i& v);

/// Reads the members of a JSON object of any origin. The first member that is missing or of another type than asked for
/// becomes the error of the whole, named "OBJECT.KEY"; it and all that follow read as zeros. So a reader asks for
/// everything first and looks at the error once, as with ByteReader.
class MemberReader {
 public:
  /// `name` is the object's in errors, such as "LIGHTWELL_lamps.lamps[2]".
  MemberReader(const Json& object, std::string name);

  bool has(const char* key) const;
  float real(const char* key);  ///< finite as a float
  Vec3f vector(const char* key);
  Vec3i whole_vector(const char* key);
  uint32_t whole(const char* key);  ///< 0 to 2^31 - 1, as every index and count of a pack is
  std::string string(const char* key);
  bool flag(const char* key);  ///< false when it is missing
  const Json& array(const char* key);
  const Json& object(const char* key);

  /// Makes "OBJECT.KEY" the error, unless there is one already.
  void refuse(const char* key, const std::string& reason);
  /// "OBJECT.KEY[INDEX]".
  std::string name_of(const char* key, size_t index) const;

  /// The value that was made of the members, unless one of them was wrong.
  template <typename T>
  Result<T> finish(T value) const {
    if (error_) return fail(*error_);
    return value;
  }

 private:
  const Json& object_;
  std::string name_;
  std::optional<Error> error_;
};

}  // namespace lightwell
