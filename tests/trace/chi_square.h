// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

namespace lightwell {

/// Pearson's chi-square test: how far counted samples are from the expected share of each bin, in standard deviations.
/// For samples of the expected shares it is about normally distributed, so that 5 is passed by chance once in a million
/// times. Bins that expect fewer than 10 samples are counted as one; without an expectation they must stay empty.
/// Infinite when a bin without an expectation has a sample.
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
    if (expected <= 0 && counts[i] > 0) return HUGE_VAL;
    if (expected >= 10) {
      add(counts[i], expected);
    } else {
      rest_count += counts[i];
      rest_expected += expected;
    }
  }
  if (rest_expected >= 10) add(rest_count, rest_expected);
  const double freedom = bins - 1;
  return (sum - freedom) / std::sqrt(2 * freedom);
}

/// The same for bins that expect equally many samples.
inline double chi_square_of_equal_bins(const std::vector<int>& counts) {
  return chi_square(counts, std::vector<double>(counts.size(), 1.0 / static_cast<double>(counts.size())));
}

}  // namespace lightwell
