// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/lamps_extension.h"

#include <gtest/gtest.h>

#include "tests/packing/nasty_json.h"

namespace lightwell {
namespace {

using Kind = ClientLamp::Kind;

Json pack_of(const std::vector<ClientLamp>& lamps) { return {{"extensions", {{lamps_extension, to_json(lamps)}}}}; }

Vec3f any_vector(Random& random) {
  Vec3f v{};
  for (float& x : v.e) x = 20 * random.uniform() - 10;
  return v;
}

// A lamp that has what its kind has and nothing else.
ClientLamp any_lamp(Random& random) {
  ClientLamp lamp;
  lamp.kind = static_cast<Kind>(random.below(5));
  if (random.below(2)) lamp.name = "lamp \"" + std::to_string(random.below(99)) + "\"";
  if (lamp.kind != Kind::sun) lamp.center = any_vector(random);
  if (lamp.kind != Kind::point && lamp.kind != Kind::sphere) lamp.normal = normalized(any_vector(random));
  if (lamp.kind == Kind::rectangle) {
    lamp.half_u = any_vector(random);
    lamp.half_v = any_vector(random);
    lamp.two_sided = random.below(2);
  }
  if (lamp.kind == Kind::sphere) lamp.radius = random.uniform();
  (lamp.kind == Kind::rectangle || lamp.kind == Kind::sphere ? lamp.radiance : lamp.intensity) = any_vector(random);
  if (random.below(2)) lamp.range = 0.1f + random.uniform();
  if (lamp.kind == Kind::spot) {
    lamp.inner_cone = random.uniform() / 2;
    lamp.outer_cone = lamp.inner_cone + random.uniform() / 2;
  }
  lamp.luminaire.kind = LuminaireId::Kind::lamp;
  if (random.below(2)) lamp.luminaire.node = static_cast<int>(random.below(1000));
  if (lamp.kind == Kind::rectangle || lamp.kind == Kind::sphere) {
    lamp.luminaire.kind = LuminaireId::Kind::surface;
    if (random.below(2)) lamp.luminaire.copy = static_cast<int>(random.below(1000));
    if (random.below(2)) lamp.luminaire.primitive = static_cast<int>(random.below(1000));
    lamp.luminaire.vertex = random.below(1000000);
  }
  return lamp;
}

void expect_same(const ClientLamp& a, const ClientLamp& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.center, b.center);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.half_u, b.half_u);
  EXPECT_EQ(a.half_v, b.half_v);
  EXPECT_EQ(a.two_sided, b.two_sided);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.radiance, b.radiance);
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.range, b.range);
  EXPECT_EQ(a.inner_cone, b.inner_cone);
  EXPECT_EQ(a.outer_cone, b.outer_cone);
  EXPECT_EQ(a.luminaire, b.luminaire);
}

TEST(LampsExtension, ReadsWhatItWrites) {
  for (uint64_t i = 0; i < 200; i++) {
    Random random(11, i);
    std::vector<ClientLamp> lamps(random.below(most_client_lamps + 1));
    for (ClientLamp& lamp : lamps) lamp = any_lamp(random);
    // As text, since a pack holds text: floats come back exactly.
    const auto again = read_lamps(Json::parse(pack_of(lamps).dump()));
    ASSERT_TRUE(again) << again.error().message();
    ASSERT_EQ(again->size(), lamps.size());
    for (size_t k = 0; k < lamps.size(); k++) expect_same((*again)[k], lamps[k]);
  }
}

// What is read can be written and is read alike, whatever was changed.
TEST(LampsExtension, ReadsAnyJsonAsLampsOrAnError) {
  int refused = 0;
  for (uint64_t i = 0; i < 1000; i++) {
    Random random(12, i);
    Json json = pack_of({any_lamp(random), any_lamp(random)});
    for (uint32_t changes = 1 + random.below(3); changes > 0; changes--) spoil(json, random);
    const auto lamps = read_lamps(json);
    if (!lamps) {
      refused++;
      EXPECT_TRUE(lamps.error().element.starts_with(lamps_extension)) << lamps.error().message();
      continue;
    }
    const auto again = read_lamps(pack_of(*lamps));
    ASSERT_TRUE(again) << again.error().message();
    for (size_t k = 0; k < lamps->size(); k++) expect_same((*again)[k], (*lamps)[k]);
  }
  EXPECT_GT(refused, 300);  // else the changes would not be nasty
}

TEST(LampsExtension, NamesWhatIsWrong) {
  const auto error = [](const Json& json) { return read_lamps(json).error().message(); };
  EXPECT_EQ(error(Json()), "LIGHTWELL_lamps: is missing");
  Random random(13, 0);
  Json json = pack_of({any_lamp(random), any_lamp(random)});
  Json& lamp = json["extensions"]["LIGHTWELL_lamps"]["lamps"][1];
  lamp["kind"] = "candle";
  EXPECT_EQ(error(json), "LIGHTWELL_lamps.lamps[1].kind: is no kind of lamp");
  lamp = {{"kind", "point"}, {"center", {1, 2}}};
  EXPECT_EQ(error(json), "LIGHTWELL_lamps.lamps[1].center: is not three finite numbers");
  lamp["center"] = {1, 2, 1e39};
  EXPECT_EQ(error(json), "LIGHTWELL_lamps.lamps[1].center: is not three finite numbers");
  lamp["center"] = {1, 2, 3};
  EXPECT_EQ(error(json), "LIGHTWELL_lamps.lamps[1].intensity: is missing");
  EXPECT_EQ(error(pack_of(std::vector<ClientLamp>(most_client_lamps + 1))), "LIGHTWELL_lamps.lamps: are more than 16");
}

}  // namespace
}  // namespace lightwell
