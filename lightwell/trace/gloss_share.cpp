// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/gloss_share.h"

#include <array>

#include "lightwell/trace/ggx.h"

namespace lightwell {
namespace {

constexpr int cells = 32;  // of an axis: cosine or roughness

/// Where a number of [0, 1] lies between the nodes of an axis.
struct Place {
  size_t cell;
  float share;  // of the cell's upper end

  explicit Place(float x) {
    const float scaled = std::clamp(x, 0.0f, 1.0f) * cells;
    cell = std::min(static_cast<size_t>(scaled), size_t(cells - 1));
    share = scaled - static_cast<float>(cell);
  }
};

GlossShare between(const GlossShare& a, const GlossShare& b, float share) {
  return {a.normal + (b.normal - a.normal) * share, a.grazing + (b.grazing - a.grazing) * share};
}

/// The integral, over the facets that are visible: points spread evenly over the disc that chooses them.
GlossShare integrated(float cosine, float alpha) {
  constexpr int rings = 16, spokes = 32;
  const Vec3f out{{std::sqrt(1 - cosine * cosine), 0, cosine}};
  const float hidden_out = ggx_hidden(cosine, alpha);
  double normal = 0, grazing = 0;
  for (int i = 0; i < rings * spokes; i++) {
    const float radius = std::sqrt((static_cast<float>(i / spokes) + 0.5f) / rings);
    const float turn = 2 * pi * (static_cast<float>(i % spokes) + 0.5f) / spokes;
    const Vec3f facet = ggx_visible_facet(out, alpha, {{radius * std::cos(turn), radius * std::sin(turn), 0}});
    const float cos_in = 2 * dot(facet, out) * facet[2] - cosine;
    if (cos_in <= 0) continue;
    const double seen = static_cast<double>((1 + hidden_out) / (1 + hidden_out + ggx_hidden(cos_in, alpha)));
    const double fresnel = static_cast<double>(schlick_grazing(dot(facet, out)));
    normal += seen * (1 - fresnel);
    grazing += seen * fresnel;
  }
  return {static_cast<float>(normal / (rings * spokes)), static_cast<float>(grazing / (rings * spokes))};
}

/// The shares at evenly spaced roughnesses and cosines, and their means over the cosines.
class Table {
 public:
  Table() {
    constexpr float least_cosine = 1e-3f;  // instead of 0, from where no facet is seen
    for (size_t r = 0; r <= cells; r++) {
      const float alpha = ggx_alpha(static_cast<float>(r) / cells);
      for (size_t c = 0; c <= cells; c++)
        shares_[r][c] = integrated(std::max(static_cast<float>(c) / cells, least_cosine), alpha);
      means_[r] = mean(shares_[r]);
    }
  }

  GlossShare at(float cosine, float roughness) const {
    const Place c(cosine), r(roughness);
    const Row &below = shares_[r.cell], &above = shares_[r.cell + 1];
    return between(between(below[c.cell], below[c.cell + 1], c.share),
                   between(above[c.cell], above[c.cell + 1], c.share), r.share);
  }

  GlossShare mean(float roughness) const {
    const Place r(roughness);
    return between(means_[r.cell], means_[r.cell + 1], r.share);
  }

 private:
  using Row = std::array<GlossShare, cells + 1>;

  /// 2 times the integral of share * cosine, of the function that is linear between the nodes.
  static GlossShare mean(const Row& row) {
    GlossShare sum;
    for (size_t c = 0; c < cells; c++) {
      const float lo = static_cast<float>(c) / cells, width = 1.0f / cells;
      const float of_upper = 2 * width * (lo / 2 + width / 3), of_lower = 2 * width * (lo / 2 + width / 6);
      sum.normal += row[c].normal * of_lower + row[c + 1].normal * of_upper;
      sum.grazing += row[c].grazing * of_lower + row[c + 1].grazing * of_upper;
    }
    return sum;
  }

  std::array<Row, cells + 1> shares_;
  std::array<GlossShare, cells + 1> means_;
};

const Table& table() {
  static const Table table;
  return table;
}

}  // namespace

GlossShare gloss_share(float cosine, float roughness) { return table().at(cosine, roughness); }

GlossShare mean_gloss_share(float roughness) { return table().mean(roughness); }

}  // namespace lightwell
