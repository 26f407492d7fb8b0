// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "tests/packing/nasty_json.h"

namespace lightwell {

/// A LIGHTWELL_ extension as its tests see it. `Value` is all that a document says by it.
///   static Value any(Random&);             a value with everything that it may have
///   static Json pack_of(const Value&);     a document that says it
///   static Result<Value> read(const Json&);
///   static constexpr const char* place;    how the element of every error begins
/// What is written comes back exactly, also as text, since a pack holds text.
template <typename Extension>
void expect_reads_what_it_writes(uint64_t seed) {
  for (uint64_t i = 0; i < 200; i++) {
    Random random(seed, i);
    const auto value = Extension::any(random);
    const auto again = Extension::read(Json::parse(Extension::pack_of(value).dump()));
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_TRUE(*again == value) << Extension::pack_of(value).dump(2);
  }
}

/// Whatever is changed in a document: it is refused with an error that names the place, or what is read can be written
/// and read alike.
template <typename Extension>
void expect_reads_any_json_or_an_error(uint64_t seed) {
  int refused = 0;
  for (uint64_t i = 0; i < 1000; i++) {
    Random random(seed, i);
    Json json = Extension::pack_of(Extension::any(random));
    for (uint32_t changes = 1 + random.below(3); changes > 0; changes--) spoil(json, random);
    const auto value = Extension::read(json);
    if (!value) {
      refused++;
      EXPECT_TRUE(value.error().element.starts_with(Extension::place)) << value.error().message();
      continue;
    }
    const auto again = Extension::read(Extension::pack_of(*value));
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_TRUE(*again == *value) << json.dump(2);
  }
  EXPECT_GT(refused, 200);  // else the changes would not be nasty
}

}  // namespace lightwell
