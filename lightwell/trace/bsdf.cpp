// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/bsdf.h"

#include "lightwell/trace/ggx.h"
#include "lightwell/trace/gloss_share.h"

namespace lightwell {
namespace {

/// The share of light that reaches what lies under the gloss, on its way in or out. The least keeps ratios finite where
/// nothing does.
float past(float gloss) { return std::max(1 - gloss, 1e-6f); }

/// How the facets divide light that comes or goes at a cosine among what lies beyond them.
struct Passage {
  float to_diffuse = 1, to_facets = 0;

  Passage(const Bsdf& bsdf, const GlossShare& share)
      : to_diffuse(past(share.of(bsdf.coat, bsdf.coat_grazing))), to_facets(past(share.all())) {}
};

Bsdf::Albedo albedo_of(const Bsdf& bsdf, const GlossShare& share) {
  const Passage passage(bsdf, share);
  return {.diffuse = bsdf.diffuse * passage.to_diffuse,
          .gloss = bsdf.gloss * share.normal + Vec3f::filled(bsdf.grazing * share.grazing),
          .repeated = bsdf.repeated * passage.to_facets};
}

/// The value of what is diffuse and of what facets pass to each other.
Vec3f cosine_lobes(const Bsdf& bsdf, const GlossShare& to_out, const GlossShare& to_in) {
  const Passage back(bsdf, to_out), there(bsdf, to_in), mean(bsdf, mean_gloss_share(bsdf.roughness));
  return bsdf.diffuse * (there.to_diffuse * back.to_diffuse / (pi * mean.to_diffuse)) +
         bsdf.repeated * (there.to_facets * back.to_facets / (pi * mean.to_facets));
}

/// The probability of sampling a cosine's lobe, not the facets.
float share_of_cosine(const Bsdf::Albedo& albedo) {
  const float cosine = max_component(albedo.diffuse + albedo.repeated), facets = max_component(albedo.gloss);
  return cosine + facets > 0 ? cosine / (cosine + facets) : 1;
}

}  // namespace

Bsdf::Albedo Bsdf::albedo(float cosine) const {
  return glossy() ? albedo_of(*this, gloss_share(cosine, roughness)) : Albedo{.diffuse = diffuse};
}

Vec3f Bsdf::value_without_facets(float cos_out, float cos_in) const {
  if (cos_in <= 0) return {};
  if (!glossy() || cos_out <= 0) return diffuse / pi;
  return cosine_lobes(*this, gloss_share(cos_out, roughness), gloss_share(cos_in, roughness));
}

Bsdf Bsdf::facets_alone() const {
  Bsdf facets = *this;
  facets.diffuse = facets.repeated = {};
  return facets;
}

Bsdf::Evaluation Bsdf::evaluate(const Vec3f& normal, const Vec3f& out, const Vec3f& in) const {
  const float cos_in = dot(normal, in), cos_out = dot(normal, out);
  if (cos_in <= 0) return {};
  if (!glossy() || cos_out <= 0) return {diffuse / pi, cos_in / pi};
  const GlossShare to_out = gloss_share(cos_out, roughness);
  Evaluation result;
  result.value = cosine_lobes(*this, to_out, gloss_share(cos_in, roughness));
  const Vec3f half = normalized(in + out);
  const float alpha = ggx_alpha(roughness);
  const float facets = ggx_facets(dot(normal, half), alpha) / (4 * cos_out);
  const float hidden_out = ggx_hidden(cos_out, alpha), hidden_in = ggx_hidden(cos_in, alpha);
  const float at_grazing = schlick_grazing(dot(half, out));
  const Vec3f fresnel = gloss * (1 - at_grazing) + Vec3f::filled(grazing * at_grazing);
  result.value += fresnel * (facets / (cos_in * (1 + hidden_in + hidden_out)));
  const float share = share_of_cosine(albedo_of(*this, to_out));
  result.density = share * cos_in / pi + (1 - share) * facets / (1 + hidden_out);
  return result;
}

Bsdf::Sample Bsdf::sample(const Vec3f& normal, const Vec3f& out, Random& random) const {
  const float cos_out = dot(normal, out);
  if (!glossy() || cos_out <= 0) {
    const Vec3f in = sample_cosine_hemisphere(normal, random);
    return {in, diffuse, std::max(dot(normal, in), 0.0f) / pi};
  }
  Sample sample;
  if (random.uniform() < share_of_cosine(albedo(cos_out))) {
    sample.in = sample_cosine_hemisphere(normal, random);
  } else {
    const Frame frame(normal);
    const Vec3f facet =
        frame.to_world(ggx_visible_facet(frame.to_local(out), ggx_alpha(roughness), sample_disc(random)));
    sample.in = normalized(facet * (2 * dot(facet, out)) - out);
  }
  const Evaluation found = evaluate(normal, out, sample.in);
  sample.density = found.density;
  if (found.density > 0) sample.weight = found.value * (dot(normal, sample.in) / found.density);
  return sample;
}

Vec3f repeated_reflectance(const Vec3f& gloss, float roughness) {
  // Schlick's term averaged over a cosine's hemisphere leaves 1/21 of what it adds at grazing angles.
  const Vec3f mean_fresnel = gloss + (Vec3f::filled(1) - gloss) / 21;
  const float once = mean_gloss_share(roughness).all();
  Vec3f reflectance;
  for (int c = 0; c < 3; c++)
    reflectance[c] = mean_fresnel[c] * mean_fresnel[c] * once / (1 - mean_fresnel[c] * (1 - once));
  return reflectance;
}

}  // namespace lightwell
