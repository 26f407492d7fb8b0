// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "lightwell/gltf/json.h"

namespace lightwell {

/// A float as a number of a pack's JSON: the shortest decimal that reads back as the same float.
Json to_json(float x);
/// A vector as an array of three numbers.
Json to_json(const Vec3f& v);
Json to_json(const Vec3i& v);

/// Reads the members of an untrusted JSON object. The first member that is missing or of the wrong type becomes the
/// error, named "OBJECT.KEY"; invalid members read as zero or empty. Callers thus read all members first and check for
/// an error once, in finish(), as with ByteReader.
class MemberReader {
 public:
  /// `name` identifies the object in errors, e.g. "LIGHTWELL_lamps.lamps[2]".
  MemberReader(const Json& object, std::string name);

  bool has(const char* key) const;
  float real(const char* key);  ///< must be finite as a float
  Vec3f vector(const char* key);
  Vec3d exact_vector(const char* key);  ///< must be finite and within 1e30
  Vec3i whole_vector(const char* key);
  uint32_t whole(const char* key);  ///< 0 to 2^31 - 1, the range of all indices and counts in a pack
  std::string string(const char* key);
  bool flag(const char* key);  ///< false when missing
  const Json& array(const char* key);
  const Json& object(const char* key);

  /// Records an error at "OBJECT.KEY", unless there is one already.
  void refuse(const char* key, const std::string& reason);
  /// "OBJECT.KEY[INDEX]".
  std::string name_of(const char* key, size_t index) const;

  /// Returns `value`, or the recorded error.
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
