// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/number_text.h"

#include <gtest/gtest.h>

#include "lightwell/cli/figures_text.h"

namespace lightwell {
namespace {

TEST(NumberText, HasFourDigitsOrAllOfAWholeNumber) {
  for (const auto& [number, text] :
       std::vector<std::pair<double, std::string>>{{0, "0"},
                                                   {1e-9, "0"},
                                                   {0.043611, "0.04361"},
                                                   {9999.49, "9999"},
                                                   {9999.5, "10,000"},
                                                   {9999.99, "10,000"},
                                                   {10000, "10,000"},
                                                   {2387121.7, "2,387,122"},
                                                   {999999999999999, "999,999,999,999,999"},
                                                   {1e15, "1e+15"}}) {
    EXPECT_EQ(short_number(number), text);
    EXPECT_EQ(short_number(-number), text == "0" ? text : "-" + text);
  }
}

TEST(FiguresText, KeepsTheSignOfAWholeNumber) {
  EXPECT_EQ(figures_text({{"faces", 20010u}, {"change", -7}, {"fall", -20010}}),
            "faces: 20,010\nchange: -7\nfall: -20,010\n");
}

}  // namespace
}  // namespace lightwell
