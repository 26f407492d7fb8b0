// SPDX-License-Identifier: Apache-2.0
#include "lightwell/trace/gloss_share.h"

#include <gtest/gtest.h>

#include "lightwell/trace/ggx.h"

namespace lightwell {
namespace {

// What a white lobe of alpha 1 reflects of light along its normal when each facet is met once: facets have a cosine's
// density, a facet with cosine c turns the light to cos_in = 2 c^2 - 1, the shadowing of which is
// 2 cos_in / (1 + cos_in), and the mean of that is 1 - ln 2.
TEST(GlossShare, OfTheRoughestSurfaceIsItsClosedForm) {
  EXPECT_NEAR(gloss_share(1, 1).all(), 1 - std::numbers::ln2, 0.003);
}

TEST(GlossShare, OfASmoothSurfaceIsSchlicksTerm) {
  for (const float cosine : {1.0f, 0.8f, 0.5f, 0.3f}) {
    const GlossShare share = gloss_share(cosine, 0);
    EXPECT_NEAR(share.grazing, schlick_grazing(cosine), 0.004f) << cosine;
    EXPECT_NEAR(share.all(), 1, 0.004f) << cosine;
  }
}

// The integral over the directions that light comes from, against the table, whose own is over the facets.
TEST(GlossShare, IsTheIntegralOfTheLobe) {
  for (const float roughness : {0.4f, 0.55f, 0.9f}) {
    const float alpha = ggx_alpha(roughness);
    for (const float cosine : {0.95f, 0.6f, 0.33f}) {
      const Vec3f out{{std::sqrt(1 - cosine * cosine), 0, cosine}};
      double normal = 0, grazing = 0;
      const int heights = 500, turns = 500;
      for (int i = 0; i < heights * turns; i++) {
        const float height = (static_cast<float>(i % heights) + 0.5f) / heights;
        const float turn = 2 * pi * (static_cast<float>(i / heights) + 0.5f) / turns;
        const float radius = std::sqrt(1 - height * height);
        const Vec3f in{{radius * std::cos(turn), radius * std::sin(turn), height}};
        const Vec3f half = normalized(in + out);
        const float lobe =
            ggx_facets(half[2], alpha) / (4 * cosine * (1 + ggx_hidden(cosine, alpha) + ggx_hidden(height, alpha)));
        const double share = static_cast<double>(lobe * 2 * pi / (heights * turns));
        const double fresnel = static_cast<double>(schlick_grazing(dot(half, out)));
        normal += share * (1 - fresnel);
        grazing += share * fresnel;
      }
      EXPECT_NEAR(static_cast<double>(gloss_share(cosine, roughness).normal), normal, 0.003) << roughness << cosine;
      EXPECT_NEAR(static_cast<double>(gloss_share(cosine, roughness).grazing), grazing, 0.003) << roughness << cosine;
    }
  }
}

TEST(GlossShare, HasItsMean) {
  for (const float roughness : {0.0f, 0.37f, 1.0f}) {
    double sum = 0;
    const int count = 10000;
    for (int i = 0; i < count; i++) {
      const float cosine = (static_cast<float>(i) + 0.5f) / count;
      sum += static_cast<double>(2 * cosine * gloss_share(cosine, roughness).all()) / count;
    }
    EXPECT_NEAR(static_cast<double>(mean_gloss_share(roughness).all()), sum, 1e-4);
  }
}

}  // namespace
}  // namespace lightwell
