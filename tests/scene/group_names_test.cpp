// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/group_names.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

std::vector<std::string> names(const char* nodes, GroupedBy by) {
  Scene scene;
  scene.document.json["nodes"] = Json::parse(nodes);
  return group_names(scene, by);
}

constexpr const char* house = R"([
  {"name": "Upstairs", "children": [1, 2], "extras": {"lightGroup": "first floor"}},
  {"name": "Lamp.001"},
  {"name": "Lamp.002", "extras": {"lightGroup": "desk"}},
  {"name": "Lamp 3", "extras": {"lightGroup": 3}}])";

TEST(GroupNames, OfExtrasHoldForTheNodesBelow) {
  EXPECT_EQ(names(house, GroupedBy::extras), (std::vector<std::string>{"first floor", "first floor", "desk", ""}));
}

TEST(GroupNames, OfCollectionsAreTheNodesAbove) {
  EXPECT_EQ(names(house, GroupedBy::collection), (std::vector<std::string>{"", "Upstairs", "Upstairs", ""}));
}

TEST(GroupNames, LoseTheNumberAtTheirEnd) {
  EXPECT_EQ(names(house, GroupedBy::name), (std::vector<std::string>{"Upstairs", "Lamp", "Lamp", "Lamp"}));
  EXPECT_EQ(names(R"([{"name": "2001"}, {"name": "_7"}, {"name": "A-1 B"}, {}])", GroupedBy::name),
            (std::vector<std::string>{"2001", "_7", "A-1 B", ""}));
}

TEST(GroupNames, AreEmptyWithoutGroups) {
  EXPECT_EQ(names(house, GroupedBy::nothing), std::vector<std::string>(4));
  EXPECT_TRUE(group_names(Scene(), GroupedBy::name).empty());
}

}  // namespace
}  // namespace lightwell
