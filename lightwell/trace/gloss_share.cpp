// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/gloss_share.h"

#include <array>

#include "lightwell/trace/ggx.h"

namespace lightwell {
namespace {

// The axes of the table are roughness and the root of the cosine, since facets that are seen at grazing angles soon
// hide each other.
constexpr int cells = 32;

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
  constexpr size_t points = 512;
  const Vec3f out{{std::sqrt(1 - cosine * cosine), 0, cosine}};
  const float hidden_out = ggx_hidden(cosine, alpha);
  double normal = 0, grazing = 0;
  for (size_t i = 0; i < points; i++) {
    const Vec3f above_disc = cosine_direction(i, points, 0.5f, 0);
    const Vec3f facet = ggx_visible_facet(out, alpha, above_disc);
    const float cos_in = 2 * dot(facet, out) * facet[2] - cosine;
    if (cos_in <= 0) continue;
    const double seen = static_cast<double>((1 + hidden_out) / (1 + hidden_out + ggx_hidden(cos_in, alpha)));
    const double fresnel = static_cast<double>(schlick_grazing(dot(facet, out)));
    normal += seen * (1 - fresnel);
    grazing += seen * fresnel;
  }
  return {static_cast<float>(normal / points), static_cast<float>(grazing / points)};
}

/// The shares at evenly spaced roughnesses and cosines, and their means over the cosines.
class Table {
 public:
  Table() {
    constexpr float least_root = 0.02f;  // instead of 0, from where no facet is seen
    for (size_t r = 0; r <= cells; r++) {
      const float alpha = ggx_alpha(static_cast<float>(r) / cells);
      for (size_t c = 0; c <= cells; c++) {
        const float root = std::max(static_cast<float>(c) / cells, least_root);
        shares_[r][c] = integrated(root * root, alpha);
      }
      means_[r] = mean(shares_[r]);
    }
  }

  GlossShare at(float cosine, float roughness) const {
    const Place c(std::sqrt(std::max(cosine, 0.0f))), r(roughness);
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

  /// 2 times the integral of share * cosine, of the function that is linear in the cosine's root between the nodes.
  static GlossShare mean(const Row& row) {
    double normal = 0, grazing = 0;
    for (size_t c = 0; c < cells; c++) {
      const double lo = static_cast<double>(c) / cells, hi = static_cast<double>(c + 1) / cells;
      const double whole = std::pow(hi, 4) - std::pow(lo, 4);             // 4 times the integral of root^3 ...
      const double moment = (std::pow(hi, 5) - std::pow(lo, 5)) * 4 / 5;  // ... and of root^4
      const double upper = (moment - lo * whole) * cells, lower = (hi * whole - moment) * cells;
      normal += static_cast<double>(row[c].normal) * lower + static_cast<double>(row[c + 1].normal) * upper;
      grazing += static_cast<double>(row[c].grazing) * lower + static_cast<double>(row[c + 1].grazing) * upper;
    }
    return {static_cast<float>(normal), static_cast<float>(grazing)};
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
