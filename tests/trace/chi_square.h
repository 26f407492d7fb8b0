// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <vector>

namespace lightwell {

/// Pearson's chi-square test: the probability that samples of the expected shares would be as far from them as the
/// counted ones, or farther. Bins that expect fewer than 10 samples are counted as one; without an expectation they
/// must stay empty: 0 when one has a sample.
inline double chi_square(const std::vector<int>& counts, const std::vector<double>& shares) {
  double total = 0;
  for (const int count : counts) total += count;
  double sum = 0, rest_count = 0, rest_expected = 0;
  int bins = 0;
  const auto add = [&](double count, double expected) {
    sum += (count - expected) * (count - expected) / expected;
    bins++;
  };
  for (size_t i = 0; i < counts.size(); i++) {
    const double expected = shares[i] * total;
    if (expected <= 0 && counts[i] > 0) return 0;
    if (expected >= 10) {
      add(counts[i], expected);
    } else {
      rest_count += counts[i];
      rest_expected += expected;
    }
  }
  if (rest_expected >= 10) add(rest_count, rest_expected);
  return bins < 2 ? 1 : boost::math::gamma_q((bins - 1) / 2.0, sum / 2);
}

/// The same for bins that expect equally many samples.
inline double chi_square_of_equal_bins(const std::vector<int>& counts) {
  return chi_square(counts, std::vector<double>(counts.size(), 1.0 / static_cast<double>(counts.size())));
}

/// Below this probability a sampler is wrong. Right samplers would fail one of at most 200 tests, as many as there are
/// in this folder, for one choice of all their seeds in 100 (Sidak): seeds are fixed, so a test that passes stays so. A
/// share that is wrong by a few percent in bins of a thousand samples fails by many orders of magnitude.
inline const double least_probability = 1 - std::pow(1 - 0.01, 1 / 200.0);

}  // namespace lightwell
