// SPDX-License-Identifier: Apache-2.0
#include "lightwell/scene/sun_of_sky.h"

#include <algorithm>

#include "lightwell/gltf/document.h"
#include "lightwell/scene/sky_map.h"

namespace lightwell {
namespace {

constexpr const char* sun_name = "sun of the sky";

/// Angles from the sun's middle, as cosines: of what is taken for it, and of the ring that tells the sky around.
const float edge_of_sun = std::cos(0.07f), edge_of_ring = std::cos(0.14f);  // 4 and 8 degrees
/// Of the brightest pixel: the ring is at most so bright.
constexpr float most_around = 0.02f;
/// Of the irradiance that the whole picture gives a surface in the mean, pi times its mean radiance: a sun of less
/// casts no shadow that anybody sees.
constexpr float least_share = 0.05f;

float brightness(const Vec3f& light) { return light[0] + light[1] + light[2]; }

class SkyPicture {
 public:
  explicit SkyPicture(const RadianceImage& map) : map_(map), count_(map.pixels.size() / 3) {}

  size_t brightest() const {
    size_t best = 0;
    for (size_t i = 1; i < count_; i++)
      if (brightness(pixel_radiance(map_, i)) > brightness(pixel_radiance(map_, best))) best = i;
    return best;
  }
  /// Calls f(pixel, direction, radiance, solid angle) for the pixels within two cosines to a direction.
  template <typename Function>
  void within(const Vec3f& middle, float least, float most, const Function& f) const {
    for (size_t i = 0; i < count_; i++) {
      const Vec3f direction = pixel_direction(map_, i);
      const float cosine = dot(direction, middle);
      if (cosine < least || cosine > most) continue;
      f(i, direction, pixel_radiance(map_, i),
        solid_angle(static_cast<int>(i / static_cast<size_t>(map_.width)), map_));
    }
  }
  Vec3f mean_within(const Vec3f& middle, float least, float most) const {
    Vec3f sum{};
    float angle = 0;
    within(middle, least, most, [&](size_t, const Vec3f&, const Vec3f& radiance, float share) {
      sum += radiance * share;
      angle += share;
    });
    return angle > 0 ? sum / angle : Vec3f{};
  }

 private:
  const RadianceImage& map_;
  size_t count_;
};

/// Adds a light to the document's KHR_lights_punctual, and returns its number.
int add_light(Document& document, Json light) {
  constexpr const char* name = "KHR_lights_punctual";
  Json& used = document.json["extensionsUsed"];
  if (!used.is_array()) used = Json::array();
  if (std::ranges::find(used, Json(name)) == used.end()) used.push_back(name);
  Json& lights = document.json["extensions"][name]["lights"];
  lights.push_back(std::move(light));
  return static_cast<int>(lights.size()) - 1;
}

}  // namespace

std::optional<Lamp> take_sun(Environment& environment) {
  if (!environment.map || environment.map->pixels.empty()) return std::nullopt;
  const SkyPicture sky(*environment.map);
  constexpr float whole_circle = 2;
  const size_t peak = sky.brightest();
  const Vec3f middle = pixel_direction(*environment.map, peak);
  const Vec3f around = sky.mean_within(middle, edge_of_ring, edge_of_sun);
  if (brightness(around) >= most_around * brightness(pixel_radiance(*environment.map, peak))) return std::nullopt;

  Vec3f irradiance{}, towards{};
  auto without = std::make_shared<RadianceImage>(*environment.map);
  sky.within(middle, edge_of_sun, whole_circle,
             [&](size_t pixel, const Vec3f& direction, const Vec3f& radiance, float angle) {
               const Vec3f above = max(radiance - around, Vec3f{}) * angle;
               irradiance += above;
               towards += direction * brightness(above);
               const Vec3f left = min(radiance, around);
               for (int c = 0; c < 3; c++) without->pixels[3 * pixel + static_cast<size_t>(c)] = left[c];
             });
  const Vec3f mean = sky.mean_within(middle, -whole_circle, whole_circle);
  if (brightness(irradiance) < least_share * std::numbers::pi_v<float> * brightness(mean)) return std::nullopt;

  Lamp sun;
  sun.kind = Lamp::Kind::sun;
  sun.name = sun_name;
  sun.direction = -normalized(towards);
  sun.intensity = irradiance * environment.radiance;
  environment.map = std::move(without);
  return sun;
}

bool is_sun_of_sky(const Lamp& lamp) { return lamp.kind == Lamp::Kind::sun && lamp.name == sun_name; }

void add_sun(Scene& scene, const Lamp& sun) {
  if (std::ranges::any_of(scene.lamps, is_sun_of_sky)) return;
  const float strongest = max_component(sun.intensity);
  const Vec3f color = sun.intensity / strongest;
  const int light = add_light(
      scene.document, {{"name", sun.name}, {"type", "directional"}, {"color", color.e}, {"intensity", strongest}});
  // A lamp shines along its node's -z.
  const Vec3f z = -sun.direction;
  const Vec3f x = normalized(cross(std::abs(z[1]) < 0.9f ? Vec3f{{0, 1, 0}} : Vec3f{{1, 0, 0}}, z)), y = cross(z, x);
  const Json matrix = {x[0], x[1], x[2], 0, y[0], y[1], y[2], 0, z[0], z[1], z[2], 0, 0, 0, 0, 1};
  const int node =
      DocumentBuilder(scene.document)
          .add("nodes",
               {{"name", sun.name}, {"matrix", matrix}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
  const auto shown = static_cast<size_t>(std::max(0, index_of(scene.document.json, "scene")));
  scene.document.json["scenes"][shown]["nodes"].push_back(node);
  scene.lamps.push_back(sun);
  scene.lamps.back().node = node;
}

}  // namespace lightwell
