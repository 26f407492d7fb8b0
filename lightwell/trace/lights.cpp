// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/lights.h"

#include "lightwell/trace/connected_faces.h"

namespace lightwell {
namespace {

/// KHR_lights_punctual: how much of a spot's intensity is left at an angle, by its cosine to the axis.
float cone(const Lamp& lamp, float cosine) {
  if (lamp.kind != Lamp::Kind::spot) return 1;
  const float inner = std::cos(lamp.inner_cone), outer = std::cos(lamp.outer_cone);
  const float x = std::clamp((cosine - outer) / std::max(0.001f, inner - outer), 0.0f, 1.0f);
  return x * x;
}

/// The solid angle of a spot's light, its fading edge counted by what is left there.
float cone_solid_angle(const Lamp& lamp) {
  const float outer = std::cos(lamp.outer_cone);
  const float width = std::max(0.001f, std::cos(lamp.inner_cone) - outer);
  const float full_from = std::min(1.0f, outer + width);
  const float edge = full_from - outer;
  return 2 * pi * (1 - full_from + edge * edge * edge / (3 * width * width));
}

/// KHR_lights_punctual: the window that ends a lamp's light at its range.
float range_window(const Lamp& lamp, float distance) {
  if (lamp.range <= 0) return 1;
  const float x = distance / lamp.range;
  return std::max(0.0f, 1 - x * x * x * x);
}

/// Of a face's emission, where it changes over the area.
constexpr int samples = 64;

/// Of the scene's longest side: a cell or so of the usual grid.
constexpr float open_margin = 0.04f;

}  // namespace

Lights::Lights(const TraceScene& scene)
    : scene_(scene),
      region_(scene.bounds()),
      first_element_(scene.scene().instances.size(), -1),
      environment_(scene.scene().environment) {
  if (!environment_.black()) {
    const auto margin = Vec3f::filled(open_margin * max_component(region_.size()));
    region_.lo -= margin;
    region_.hi += margin;
  }
  center_ = region_.center();
  radius_ = length(region_.size()) / 2;
  for (size_t i = 0; i < scene.scene().lamps.size(); i++) add_lamp(static_cast<int>(i));
  for (uint32_t i = 0; i < first_element_.size(); i++) {
    if (scene.traced(i) && max_component(scene.material(i).emission) > 0) add_surface(i);
  }
  if (!environment_.black()) add_environment();
  choice_ = Distribution(weights_);
  weights_ = {};
  lit_texels_ = {};
}

void Lights::add(Element element, const Vec3f& power, float least_weight) {
  elements_.push_back(element);
  weights_.push_back(std::max(mean_of_channels(power), least_weight));
  luminaires_[static_cast<size_t>(element.luminaire)].power += power;
}

void Lights::add_lamp(int index) {
  const Lamp& lamp = scene_.scene().lamps[static_cast<size_t>(index)];
  luminaires_.push_back({.kind = Luminaire::Kind::lamp, .index = index});
  const float spread = lamp.kind == Lamp::Kind::sun     ? pi * radius_ * radius_
                       : lamp.kind == Lamp::Kind::point ? 4 * pi
                                                        : cone_solid_angle(lamp);
  add({.luminaire = static_cast<int>(luminaires_.size()) - 1}, lamp.intensity * spread);
}

void Lights::add_surface(uint32_t instance) {
  const std::vector<uint32_t> pieces = connected_faces(scene_.mesh(instance));
  const size_t first = luminaires_.size();
  first_element_[instance] = static_cast<int>(elements_.size());
  for (uint32_t face = 0; face < pieces.size(); face++) {
    const size_t luminaire = first + pieces[face];
    if (luminaire == luminaires_.size())
      luminaires_.push_back({.kind = Luminaire::Kind::surface, .index = static_cast<int>(instance)});
    add_face(static_cast<int>(luminaire), instance, face);
  }
  for (size_t i = first; i < luminaires_.size(); i++) {
    Luminaire& piece = luminaires_[i];
    if (piece.area > 0) piece.center *= 1 / piece.area;
  }
}

/// Adds a face to its piece of surface, whose centre is still times its area.
void Lights::add_face(int luminaire, uint32_t instance, uint32_t face) {
  const Element element{.luminaire = luminaire,
                        .instance = instance,
                        .face = face,
                        .triangle = triangle(instance, face),
                        .double_sided = scene_.material(instance).double_sided};
  const Triangle& t = element.triangle;
  Luminaire& piece = luminaires_[static_cast<size_t>(luminaire)];
  piece.double_sided = element.double_sided;
  piece.faces.push_back(face);
  piece.center += t.at({{1.0f / 3, 1.0f / 3}}) * t.area;
  piece.area += t.area;
  if (!may_shine(element)) return add(element, {});
  // A face that may shine is never given up because all samples missed where it does.
  const float spread = pi * t.area * (element.double_sided ? 2.0f : 1.0f);
  const float least =
      scene_.is_uniform(instance) ? 0 : mean_of_channels(scene_.material(instance).emission) / (4 * samples);
  add(element, mean_emission(element) * spread, least * spread);
}

void Lights::add_environment() {
  environment_element_ = static_cast<int>(elements_.size());
  luminaires_.push_back({.kind = Luminaire::Kind::environment});
  const float sphere_area = 4 * pi * radius_ * radius_;
  add({.luminaire = static_cast<int>(luminaires_.size()) - 1}, environment_.mean() * (pi * sphere_area));
}

bool Lights::finite() const { return std::isfinite(choice_.total()) && is_finite(power()); }

Vec3f Lights::power() const {
  Vec3f sum{};
  for (const Luminaire& luminaire : luminaires_) sum += luminaire.power;
  return sum;
}

Lights::Triangle Lights::triangle(uint32_t instance, uint32_t face) const {
  const std::array<Vec3f, 3> c = scene_.corners(instance, face);
  Triangle t{.corner = c[0], .edge_u = c[1] - c[0], .edge_v = c[2] - c[0]};
  t.normal = scene_.face_normal(instance, c);
  t.area = length(cross(t.edge_u, t.edge_v)) / 2;
  return t;
}

Vec3f Lights::emission(const Element& element, Vec2f uv) const {
  const Surface surface = scene_.surface(element.instance, element.face, uv[0], uv[1]);
  return surface.emission * surface.coverage;
}

/// Whether a face's emission texture is anything but black on it.
bool Lights::may_shine(const Element& element) {
  const TextureLookup& texture = scene_.material(element.instance).emission_texture;
  if (texture.image < 0) return true;
  const Mesh& mesh = scene_.mesh(element.instance);
  const std::vector<Vec2f>& texcoords = mesh.texcoords[texture.texcoord == 1 ? 1 : 0];
  std::array<Vec2f, 3> of_corners{};
  for (size_t i = 0; i < 3 && !texcoords.empty(); i++) of_corners[i] = texcoords[mesh.faces[element.face][i]];
  const auto image = static_cast<size_t>(texture.image);
  return lit_texels_.try_emplace(texture.image, scene_.scene().images[image]).first->second.any(texture, of_corners);
}

/// Over the face's area, by samples where the material changes over it: good enough to choose by.
Vec3f Lights::mean_emission(const Element& element) const {
  if (scene_.is_uniform(element.instance)) return emission(element, {{1.0f / 3, 1.0f / 3}});
  Random random(element.instance, element.face);
  Vec3f sum{};
  for (int i = 0; i < samples; i++) sum += emission(element, sample_triangle(random));
  return sum / samples;
}

Lights::Emission Lights::emit(Random& random) const {
  const size_t chosen = choice_.sample(random);
  const Element& element = elements_[chosen];
  const Luminaire& luminaire = luminaires_[static_cast<size_t>(element.luminaire)];
  Emission emission;
  switch (luminaire.kind) {
    case Luminaire::Kind::lamp:
      emission = emit_from_lamp(scene_.scene().lamps[static_cast<size_t>(luminaire.index)], random);
      break;
    case Luminaire::Kind::surface: emission = emit_from_surface(element, random); break;
    case Luminaire::Kind::environment: emission = emit_from_environment(random); break;
  }
  emission.flux *= 1 / choice_.probability(chosen);
  emission.luminaire = element.luminaire;
  return emission;
}

/// A ray that crosses the sphere round the scene in a direction, as a beam fills it.
Ray Lights::ray_from_afar(const Vec3f& direction, Random& random) const {
  return {.origin = center_ + (Frame(direction).to_world(sample_disc(random)) - direction) * radius_,
          .direction = direction};
}

Lights::Emission Lights::emit_from_lamp(const Lamp& lamp, Random& random) const {
  if (lamp.kind == Lamp::Kind::sun) {
    return {.ray = ray_from_afar(lamp.direction, random), .flux = lamp.intensity * (pi * radius_ * radius_)};
  }
  Emission emission;
  emission.ray.origin = lamp.position;
  if (lamp.kind == Lamp::Kind::point) {
    emission.ray.direction = sample_sphere(random);
    emission.flux = lamp.intensity * (4 * pi);
  } else {
    const float outer = std::cos(lamp.outer_cone);
    const float cosine = 1 - random.uniform() * (1 - outer);
    const float angle = 2 * pi * random.uniform();
    const float radius = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    emission.ray.direction =
        Frame(lamp.direction).to_world({{radius * std::cos(angle), radius * std::sin(angle), cosine}});
    emission.flux = lamp.intensity * (cone(lamp, cosine) * 2 * pi * (1 - outer));
  }
  // 1 - (distance / range)^4 of the photons get beyond a distance.
  if (lamp.range > 0) emission.ray.far = lamp.range * std::sqrt(std::sqrt(1 - random.uniform()));
  return emission;
}

Lights::Emission Lights::emit_from_surface(const Element& element, Random& random) const {
  const Triangle& t = element.triangle;
  const Vec3f normal = element.double_sided && random.uniform() < 0.5f ? -t.normal : t.normal;
  const Vec2f uv = sample_triangle(random);
  Emission emission;
  emission.ray.origin = scene_.leave(t.at(uv), normal);
  emission.ray.direction = sample_cosine_hemisphere(normal, random);
  emission.flux = this->emission(element, uv) * (pi * t.area * (element.double_sided ? 2.0f : 1.0f));
  return emission;
}

Lights::Emission Lights::emit_from_environment(Random& random) const {
  const EnvironmentLight::Sample sample = environment_.sample(random);
  Emission emission;
  emission.ray = ray_from_afar(-sample.direction, random);
  emission.flux = sample.radiance * (pi * radius_ * radius_ / sample.density);
  return emission;
}

Lights::Arrival Lights::sample(const Vec3f& point, Random& random) const {
  const size_t chosen = choice_.sample(random);
  const Element& element = elements_[chosen];
  const Luminaire& luminaire = luminaires_[static_cast<size_t>(element.luminaire)];
  Arrival arrival;
  switch (luminaire.kind) {
    case Luminaire::Kind::lamp:
      arrival = sample_lamp(scene_.scene().lamps[static_cast<size_t>(luminaire.index)], point);
      break;
    case Luminaire::Kind::surface: arrival = sample_surface(element, point, random); break;
    case Luminaire::Kind::environment: arrival = sample_environment(random); break;
  }
  const float probability = choice_.probability(chosen);
  arrival.radiance *= 1 / probability;
  arrival.density *= probability;
  arrival.luminaire = element.luminaire;
  return arrival;
}

Lights::Arrival Lights::sample_lamp(const Lamp& lamp, const Vec3f& point) const {
  Arrival arrival;
  if (lamp.kind == Lamp::Kind::sun) {
    arrival.direction = -lamp.direction;
    arrival.distance = std::numeric_limits<float>::infinity();
    arrival.radiance = lamp.intensity;
    return arrival;
  }
  const Vec3f way = lamp.position - point;
  arrival.distance = length(way);
  if (arrival.distance <= 0) return arrival;
  arrival.direction = way / arrival.distance;
  const float left = cone(lamp, -dot(arrival.direction, lamp.direction)) * range_window(lamp, arrival.distance);
  arrival.radiance = lamp.intensity * (left / (arrival.distance * arrival.distance));
  return arrival;
}

Lights::Arrival Lights::sample_surface(const Element& element, const Vec3f& point, Random& random) const {
  const Triangle& t = element.triangle;
  const Vec2f uv = sample_triangle(random);
  Arrival arrival;
  const Vec3f way = t.at(uv) - point;
  arrival.distance = length(way);
  if (arrival.distance <= 0) return arrival;
  arrival.direction = way / arrival.distance;
  float cosine = -dot(arrival.direction, t.normal);
  if (element.double_sided) cosine = std::abs(cosine);
  if (cosine <= 0) return arrival;
  arrival.density = arrival.distance * arrival.distance / (cosine * t.area);
  arrival.radiance = emission(element, uv) / arrival.density;
  return arrival;
}

Lights::Arrival Lights::sample_environment(Random& random) const {
  Arrival arrival;
  const EnvironmentLight::Sample sample = environment_.sample(random);
  arrival.direction = sample.direction;
  arrival.distance = std::numeric_limits<float>::infinity();
  arrival.density = sample.density;
  arrival.radiance = sample.radiance / sample.density;
  return arrival;
}

float Lights::density(const Vec3f& point, const Hit& hit) const {
  const int first = first_element_[hit.instance];
  if (first < 0) return 0;
  const size_t index = static_cast<size_t>(first) + hit.face;
  const Vec3f way = hit.position - point;
  const float distance2 = dot(way, way);
  const float cosine = std::abs(dot(way, hit.normal)) / std::sqrt(distance2);
  const float area = elements_[index].triangle.area;
  if (!(cosine * area > 0)) return 0;
  return choice_.probability(index) * distance2 / (cosine * area);
}

int Lights::luminaire(const Hit& hit) const {
  const int first = first_element_[hit.instance];
  return first < 0 ? -1 : elements_[static_cast<size_t>(first) + hit.face].luminaire;
}

float Lights::environment_density(const Vec3f& direction) const {
  return choice_.probability(static_cast<size_t>(environment_element_)) * environment_.density(direction);
}

}  // namespace lightwell
