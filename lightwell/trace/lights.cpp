// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/lights.h"

#include "lightwell/trace/enclosure.h"
#include "lightwell/trace/punctual_light.h"

namespace lightwell {
namespace {

std::vector<float> weights_of(const LuminaireInventory& inventory) {
  std::vector<float> weights;
  for (const LuminaireInventory::Element& element : inventory.elements) weights.push_back(element.weight);
  return weights;
}

}  // namespace

Lights::Lights(const TraceScene& scene)
    : scene_(scene),
      environment_(scene.scene().environment),
      region_(scene.bounds(), !environment_.black()),
      inventory_(take_inventory(scene, environment_, region_)),
      choice_(weights_of(inventory_)) {
  for (const Lamp& lamp : scene.scene().lamps) clearances_.push_back(bulb_radius(scene, lamp));
}

Lights Lights::only(const LuminaireSet& shining) const {
  Lights lights = *this;
  lights.inventory_ = restricted_to(shining, inventory_);
  lights.choice_ = Distribution(weights_of(lights.inventory_));
  return lights;
}

bool Lights::finite() const { return std::isfinite(choice_.total()) && is_finite(power()); }

Vec3f Lights::power() const {
  Vec3f sum{};
  for (const Luminaire& luminaire : luminaires()) sum += luminaire.power;
  return sum;
}

const Lamp& Lights::lamp(const Luminaire& luminaire) const {
  return scene_.scene().lamps[static_cast<size_t>(luminaire.index)];
}

Emission Lights::emit(Random& random) const {
  const size_t chosen = choice_.sample(random);
  const int number = inventory_.elements[chosen].luminaire;
  const Luminaire& luminaire = luminaires()[static_cast<size_t>(number)];
  Emission emission;
  switch (luminaire.kind()) {
    case Luminaire::Kind::lamp: {
      emission = emit_punctual(lamp(luminaire), region_, random);
      const float clearance = clearances_[static_cast<size_t>(luminaire.index)];
      emission.ray.origin += emission.ray.direction * clearance;
      emission.ray.far = std::max(emission.ray.far - clearance, 0.0f);
      break;
    }
    case Luminaire::Kind::surface: emission = face(chosen).emit(scene_, random); break;
    case Luminaire::Kind::environment: emission = environment_.emit(region_, random); break;
  }
  emission.flux *= 1 / choice_.probability(chosen);
  emission.luminaire = number;
  return emission;
}

Arrival Lights::sample(const Vec3f& point, Random& random) const {
  const size_t chosen = choice_.sample(random);
  const int number = inventory_.elements[chosen].luminaire;
  const Luminaire& luminaire = luminaires()[static_cast<size_t>(number)];
  Arrival arrival;
  switch (luminaire.kind()) {
    case Luminaire::Kind::lamp:
      arrival = arrive_punctual(lamp(luminaire), point);
      arrival.clearance = clearances_[static_cast<size_t>(luminaire.index)];
      break;
    case Luminaire::Kind::surface: arrival = face(chosen).arrive(scene_, point, random); break;
    case Luminaire::Kind::environment: arrival = environment_.arrive(random); break;
  }
  arrival.density *= choice_.probability(chosen);
  arrival.luminaire = number;
  return arrival;
}

float Lights::density(const Vec3f& point, const Hit& hit) const {
  const int first = inventory_.first_element[hit.instance];
  if (first < 0) return 0;
  const size_t element = static_cast<size_t>(first) + hit.face;
  return choice_.probability(element) * face(element).density(point, hit);
}

float Lights::environment_density(const Vec3f& direction) const {
  return choice_.probability(inventory_.elements.size() - 1) * environment_.density(direction);
}

int Lights::luminaire(const Hit& hit) const {
  const int first = inventory_.first_element[hit.instance];
  return first < 0 ? -1 : inventory_.elements[static_cast<size_t>(first) + hit.face].luminaire;
}

}  // namespace lightwell
