// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/material.h"

#include "lightwell/trace/sampling.h"
#include "lightwell/trace/texture_lookup.h"

namespace lightwell {
namespace {

/// The width of the GGX lobe; a perfect mirror is treated as a very smooth lobe, which can be sampled like any other.
float alpha_of(float roughness) { return std::max(roughness * roughness, 0.02f); }

/// The GGX distribution of microfacet normals at a cosine to the normal.
float ggx(float cosine, float alpha) {
  const float a2 = alpha * alpha;
  const float d = cosine * cosine * (a2 - 1) + 1;
  return a2 / (pi * d * d);
}

/// Smith's Lambda: the area of hidden facets per visible one.
float smith_lambda(float cosine, float alpha) {
  const float c2 = cosine * cosine;
  return (std::sqrt(1 + alpha * alpha * (1 - c2) / c2) - 1) / 2;
}

/// Samples the normal of a facet visible from `out`, in the local frame whose z is the normal (Heitz, Sampling the GGX
/// Distribution of Visible Normals, JCGT 2018).
Vec3f sample_visible_facet(const Vec3f& out, float alpha, Random& random) {
  const Vec3f stretched = normalized(Vec3f{{alpha * out[0], alpha * out[1], out[2]}});
  const float across = stretched[0] * stretched[0] + stretched[1] * stretched[1];
  const Vec3f t1 = across > 0 ? Vec3f{{-stretched[1], stretched[0], 0}} / std::sqrt(across) : Vec3f{{1, 0, 0}};
  const Vec3f t2 = cross(stretched, t1);
  const Vec3f disc = sample_disc(random);
  const float s = (1 + stretched[2]) / 2;
  const float p2 = (1 - s) * std::sqrt(std::max(0.0f, 1 - disc[0] * disc[0])) + s * disc[1];
  const float p3 = std::sqrt(std::max(0.0f, 1 - disc[0] * disc[0] - p2 * p2));
  const Vec3f facet = t1 * disc[0] + t2 * p2 + stretched * p3;
  return normalized(Vec3f{{alpha * facet[0], alpha * facet[1], std::max(0.0f, facet[2])}});
}

float power5(float x) { return x * x * x * x * x; }

Vec3f rgb(const Vec4f& c) { return {{c[0], c[1], c[2]}}; }

}  // namespace

float Bsdf::diffuse_share() const {
  const float d = max_component(diffuse), m = max_component(metal);
  return m <= 0 ? 1.0f : d / (d + m);
}

Vec3f Bsdf::value(const Vec3f& normal, const Vec3f& out, const Vec3f& in) const {
  const float cos_in = dot(normal, in), cos_out = dot(normal, out);
  if (cos_in <= 0) return {};
  Vec3f f = diffuse / pi;
  if (max_component(metal) <= 0 || cos_out <= 0) return f;
  const Vec3f half = normalized(in + out);
  const float alpha = alpha_of(roughness);
  const Vec3f fresnel = metal + (Vec3f::filled(metallic) - metal) * power5(1 - std::min(1.0f, dot(half, out)));
  const float shadowing = 1 / (1 + smith_lambda(cos_in, alpha) + smith_lambda(cos_out, alpha));
  return f + fresnel * (ggx(dot(normal, half), alpha) * shadowing / (4 * cos_in * cos_out));
}

float Bsdf::density(const Vec3f& normal, const Vec3f& out, const Vec3f& in) const {
  const float cos_in = dot(normal, in), cos_out = dot(normal, out);
  if (cos_in <= 0) return 0;
  const float share = diffuse_share();
  float density = share * cos_in / pi;
  if (share < 1 && cos_out > 0) {
    const float alpha = alpha_of(roughness);
    const float facets = ggx(dot(normal, normalized(in + out)), alpha);
    density += (1 - share) * facets / (4 * cos_out * (1 + smith_lambda(cos_out, alpha)));
  }
  return density;
}

Bsdf::Sample Bsdf::sample(const Vec3f& normal, const Vec3f& out, Random& random) const {
  const float share = diffuse_share();
  if (share >= 1) {
    const Vec3f in = sample_cosine_hemisphere(normal, random);
    return {in, diffuse, std::max(dot(normal, in), 0.0f) / pi};
  }
  Sample sample;
  if (random.uniform() < share) {
    sample.in = sample_cosine_hemisphere(normal, random);
  } else {
    const Frame frame(normal);
    const Vec3f facet = frame.to_world(sample_visible_facet(frame.to_local(out), alpha_of(roughness), random));
    sample.in = normalized(facet * (2 * dot(facet, out)) - out);
  }
  sample.density = density(normal, out, sample.in);
  if (sample.density > 0) {
    sample.weight = value(normal, out, sample.in) * (dot(normal, sample.in) / sample.density);
  }
  return sample;
}

Surface surface_of(const Material& material, const std::vector<Image>& images, const std::array<Vec2f, 2>& texcoords,
                   const Vec4f& vertex_color) {
  const Vec4f base = material.base_color * vertex_color * look_up(material.base_color_texture, images, texcoords, true);
  const Vec4f metal_rough = look_up(material.metallic_roughness_texture, images, texcoords, false);
  const float metallic = std::clamp(material.metallic * metal_rough[2], 0.0f, 1.0f);
  const Vec3f color = min(max(rgb(base), Vec3f{}), Vec3f::filled(1));
  Surface surface;
  if (material.alpha == Material::Alpha::mask) surface.coverage = base[3] >= material.alpha_cutoff ? 1.0f : 0.0f;
  if (material.alpha == Material::Alpha::blend) surface.coverage = std::clamp(base[3], 0.0f, 1.0f);
  // Transmission replaces only the diffuse part of the dielectric (KHR_materials_transmission): of all light, color *
  // (1 - metallic) * transmission passes, color * (1 - metallic) * (1 - transmission) is reflected diffusely and color
  // * metallic by the metal. Chance lets all colours pass together, in their mean; the tint has the rest of what they
  // differ in. The BSDF's parts are shares of the light that does not pass.
  const float dielectric = 1 - metallic;
  const Vec3f passing = color * (dielectric * material.transmission);
  const float stopped = 1 - mean_of_channels(passing);
  const Vec3f past = Vec3f::filled(1 - surface.coverage) + passing * surface.coverage;
  surface.coverage *= stopped;
  if (surface.coverage < 1) surface.tint = past / mean_of_channels(past);
  if (stopped > 0) {
    surface.bsdf.diffuse = color * (dielectric * ((1 - material.transmission) / stopped));
    surface.bsdf.metal = color * (metallic / stopped);
    surface.bsdf.metallic = metallic / stopped;
  }
  surface.emission = material.emission * rgb(look_up(material.emission_texture, images, texcoords, true));
  if (surface.coverage < 1 && max_component(surface.bsdf.diffuse + surface.bsdf.metal + surface.emission) <= 0) {
    // Where nothing comes back, chance would only add noise.
    surface.coverage = 0;
    surface.tint = past;
  }
  surface.bsdf.roughness = std::clamp(material.roughness * metal_rough[1], 0.0f, 1.0f);
  return surface;
}

bool lets_light_pass(const Material& material) {
  return material.alpha != Material::Alpha::opaque || material.transmission > 0;
}

bool tints_light(const Material& material) { return material.transmission > 0; }

}  // namespace lightwell
