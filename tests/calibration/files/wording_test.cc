// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/wording.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

TEST(Formatted, TakesWhatPrintfTakes) {
  EXPECT_EQ(Formatted("%s: %d of %.1f %%", "a", 3, 2.25), "a: 3 of 2.2 %");
  EXPECT_EQ(Formatted("plain"), "plain");
  EXPECT_EQ(Formatted("%s", ""), "");
}

TEST(Formatted, CutsNothingOff) {
  const std::string long_name(5000, 'x');
  EXPECT_EQ(Formatted("<%s>", long_name.c_str()), "<" + long_name + ">");
}

TEST(Number, IsOnePrintedNumber) { EXPECT_EQ(Number("%.2f px", 0.125), "0.12 px"); }

TEST(ShortNumber, HasThreeDigitsOrTwoDecimals) {
  EXPECT_EQ(ShortNumber(1234.56), "1235");
  EXPECT_EQ(ShortNumber(12.345), "12.35");
  EXPECT_EQ(ShortNumber(-0.012345), "-0.0123");
}

TEST(QuotedList, NamesFourAndCountsTheOthers) {
  EXPECT_EQ(QuotedList({"a"}), "'a'");
  EXPECT_EQ(QuotedList({"a", "b", "c"}), "'a', 'b' and 'c'");
  EXPECT_EQ(QuotedList({"a", "b", "c", "d", "e"}), "'a', 'b', 'c', 'd' and 'e'");
  EXPECT_EQ(QuotedList({"a", "b", "c", "d", "e", "f"}), "'a', 'b', 'c', 'd' and 2 others");
}

TEST(Listing, NamesTheFirstAndCountsTheRest) {
  EXPECT_EQ(Listing("points", {"a", "b"}), "points (2): a, b");
  EXPECT_EQ(Listing("points", {"a", "b", "c"}, 2), "points (3): a, b and 1 more");
}

TEST(Quoted, IsShortAndPrintable) {
  EXPECT_EQ(Quoted("SECTION"), "\"SECTION\"");
  EXPECT_EQ(Quoted("a\tb\xFF"), "\"a?b?\"");
  EXPECT_EQ(Quoted(std::string(41, 'x')), "\"" + std::string(40, 'x') + "...\"");
}

}  // namespace
}  // namespace insitu
