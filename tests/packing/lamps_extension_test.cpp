// SPDX-License-Identifier: Apache-2.0
#include "lightwell/packing/lamps_extension.h"

#include <gtest/gtest.h>

#include "tests/packing/extension_properties.h"

namespace lightwell {
namespace {

using Kind = ClientLamp::Kind;

Vec3f any_vector(Random& random) {
  Vec3f v{};
  for (float& x : v.e) x = 20 * random.uniform() - 10;
  return v;
}

bool is_flat(Kind kind) { return kind == Kind::rectangle || kind == Kind::disc; }
bool is_round(Kind kind) { return kind == Kind::disc || kind == Kind::sphere; }

// A lamp that has what its kind has and nothing else.
ClientLamp any_lamp(Random& random) {
  ClientLamp lamp;
  lamp.kind = static_cast<Kind>(random.below(6));
  if (random.below(2)) lamp.name = "lamp \"" + std::to_string(random.below(99)) + "\"";
  if (lamp.kind != Kind::sun) lamp.center = any_vector(random);
  if (lamp.kind != Kind::point && lamp.kind != Kind::sphere) lamp.normal = normalized(any_vector(random));
  if (lamp.kind == Kind::rectangle) {
    lamp.half_u = any_vector(random);
    lamp.half_v = any_vector(random);
  }
  if (is_flat(lamp.kind)) lamp.two_sided = random.below(2);
  if (is_round(lamp.kind)) lamp.radius = random.uniform();
  (is_flat(lamp.kind) || is_round(lamp.kind) ? lamp.radiance : lamp.intensity) = any_vector(random);
  if (random.below(2)) lamp.range = 0.1f + random.uniform();
  if (lamp.kind == Kind::spot) {
    lamp.inner_cone = random.uniform() / 2;
    lamp.outer_cone = lamp.inner_cone + random.uniform() / 2;
  }
  lamp.luminaire.kind = LuminaireId::Kind::lamp;
  if (random.below(2)) lamp.luminaire.node = static_cast<int>(random.below(1000));
  if (is_flat(lamp.kind) || is_round(lamp.kind)) {
    lamp.luminaire.kind = LuminaireId::Kind::surface;
    if (random.below(2)) lamp.luminaire.copy = static_cast<int>(random.below(1000));
    if (random.below(2)) lamp.luminaire.primitive = static_cast<int>(random.below(1000));
    lamp.luminaire.vertex = random.below(1000000);
  }
  return lamp;
}

struct Lamps {
  using Value = std::vector<ClientLamp>;
  static constexpr const char* place = lamps_extension;
  static Value any(Random& random) {
    Value lamps(random.below(most_client_lamps + 1));
    for (ClientLamp& lamp : lamps) lamp = any_lamp(random);
    return lamps;
  }
  static Json pack_of(const Value& lamps) { return {{"extensions", {{lamps_extension, to_json(lamps)}}}}; }
  static Result<Value> read(const Json& json) { return read_lamps(json); }
};

TEST(LampsExtension, ReadsWhatItWrites) { expect_reads_what_it_writes<Lamps>(11); }
TEST(LampsExtension, ReadsAnyJsonAsLampsOrAnError) { expect_reads_any_json_or_an_error<Lamps>(12); }

TEST(LampsExtension, NamesWhatIsWrong) {
  const auto error = [](const Json& json) { return read_lamps(json).error().message(); };
  EXPECT_EQ(error(Json()), "LIGHTWELL_lamps: is missing");
  Random random(13, 0);
  Json json = Lamps::pack_of({any_lamp(random), any_lamp(random)});
  Json& lamp = json["extensions"]["LIGHTWELL_lamps"]["lamps"][1];
  lamp["kind"] = "candle";
  EXPECT_EQ(error(json), "LIGHTWELL_lamps.lamps[1].kind: is no kind of lamp");
  lamp = {{"kind", "point"}, {"center", {1, 2}}};
  EXPECT_EQ(error(json), "LIGHTWELL_lamps.lamps[1].center: is not three finite numbers");
  lamp["center"] = {1, 2, 1e39};
  EXPECT_EQ(error(json), "LIGHTWELL_lamps.lamps[1].center: is not three finite numbers");
  lamp["center"] = {1, 2, 3};
  EXPECT_EQ(error(json), "LIGHTWELL_lamps.lamps[1].intensity: is missing");
  EXPECT_EQ(error(Lamps::pack_of(std::vector<ClientLamp>(most_client_lamps + 1))),
            "LIGHTWELL_lamps.lamps: are more than 16");
}

}  // namespace
}  // namespace lightwell
