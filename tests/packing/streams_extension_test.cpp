// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/streams_extension.h"

#include <gtest/gtest.h>

#include "tests/packing/extension_properties.h"

namespace lightwell {
namespace {

struct Identity {
  using Value = PackIdentity;
  static constexpr const char* place = streams_extension;
  static Value any(Random& random) {
    return {random.below(9), std::to_string(random.below(1000000)), "lightwell", 20 * random.uniform() - 10};
  }
  static Json pack_of(const Value& identity) { return {{"extensions", {{streams_extension, to_json(identity)}}}}; }
  static Result<Value> read(const Json& json) { return read_identity(json); }
};

TEST(StreamsExtension, ReadsWhatItWrites) { expect_reads_what_it_writes<Identity>(41); }
TEST(StreamsExtension, ReadsAnyJsonAsAnIdentityOrAnError) { expect_reads_any_json_or_an_error<Identity>(42); }

}  // namespace
}  // namespace lightwell
