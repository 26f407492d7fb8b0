// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/field_list.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(FieldList, NamesATag) {
  for (const char* list : {"\"a\"", "*", "\"b\", \"a\"", "\"b\",\"a\" ", "\t\"a\",,", "\"x,y\", \"a\""}) {
    EXPECT_TRUE(names_tag(list, "\"a\"")) << list;
    EXPECT_TRUE(names_strong_tag(list, "\"a\"")) << list;
  }
  for (const char* list : {"", "a", "\"b\"", "\"A\"", "\"x, \"a\"", "\"a", "w/\"a\"", "**"}) {
    EXPECT_FALSE(names_tag(list, "\"a\"")) << list;
    EXPECT_FALSE(names_strong_tag(list, "\"a\"")) << list;
  }
  EXPECT_TRUE(names_tag("\"b\", W/\"a\"", "\"a\""));
  EXPECT_FALSE(names_strong_tag("\"b\", W/\"a\"", "\"a\""));
}

TEST(FieldList, AcceptsGzip) {
  for (const char* list : {"gzip", "br, gzip", "deflate,GZIP;q=0.5", "x-gzip", "*", "identity, *;q=0.1",
                           "gzip ; q=0.001", "br;q=0, gzip;q=1.0"})
    EXPECT_TRUE(accepts_gzip(list)) << list;
  for (const char* list :
       {"", "identity", "br", "gzip;q=0", "gzip; Q=0.000", "*, gzip;q=0", "*;q=0", "gzipped", ";", ","})
    EXPECT_FALSE(accepts_gzip(list)) << list;
}

}  // namespace
}  // namespace lightwell
