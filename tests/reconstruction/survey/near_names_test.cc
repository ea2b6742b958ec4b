// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/near_names.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

using Names = std::vector<std::string>;

TEST(NearNames, DifferInCaseSignsAndZeros) {
  const std::set<std::string> known = {"P1", "P12", "P13", "P21", "Q12"};
  EXPECT_EQ(NearNames("p 12", known), Names{"P12"});
  EXPECT_EQ(NearNames("P-012", known), Names{"P12"});
  EXPECT_EQ(NearNames("P10", {"P1", "P100"}), (Names{"P1", "P100"}));
}

TEST(NearNames, AreOneSlipAway) {
  const std::set<std::string> known = {"church", "tower", "pw_7"};
  EXPECT_EQ(NearNames("chruch", known), Names{"church"});
  EXPECT_EQ(NearNames("towr", known), Names{"tower"});
  EXPECT_EQ(NearNames("pw_8", known), Names{"pw_7"});
  EXPECT_EQ(NearNames("chrchu", known), Names{"church"});
  EXPECT_TRUE(NearNames("spire", known).empty());
}

TEST(NearNames, AreNotGuessedAmongMany) {
  EXPECT_TRUE(NearNames("g9", {"g0", "g1", "g2", "g3"}).empty());
  EXPECT_TRUE(NearNames("x", {"y"}).empty());
  EXPECT_TRUE(NearNames("", {"y", "zz"}).empty());
  EXPECT_TRUE(NearNames("same", {"same"}).empty());
}

TEST(DigitsWithin, CountSingleLettersThatStandAlone) {
  EXPECT_EQ(DigitsWithin("wall_f_1"), "1f");
  EXPECT_NE(DigitsWithin("wall_f_1"), DigitsWithin("wall_b_1"));
  EXPECT_NE(DigitsWithin("roof-L"), DigitsWithin("roof-R"));
  EXPECT_EQ(DigitsWithin("p 12"), DigitsWithin("P012"));
}

TEST(DidYouMean, IsAQuestionOrNothing) {
  EXPECT_EQ(DidYouMean("ab1", {"ab2", "ab3"}), "; did you mean 'ab2' or 'ab3'?");
  EXPECT_EQ(DidYouMean("ab1", {"ab2", "ab3", "ab4"}), "; did you mean 'ab2', 'ab3' or 'ab4'?");
  EXPECT_EQ(DidYouMean("ab1", {"zz9"}), "");
}

}  // namespace
}  // namespace insitu
