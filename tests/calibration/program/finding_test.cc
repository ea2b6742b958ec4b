// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/finding.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

std::string Status(const std::vector<Finding>& findings) {
  return VerdictReport(findings)["status"].asString();
}

TEST(Finding, TheWorstMakesTheVerdict) {
  const Finding note{Severity::kNote, "n", ""}, review{Severity::kReview, "r", ""},
      fail{Severity::kFail, "f", ""};
  EXPECT_EQ(Status({}), "pass");
  EXPECT_EQ(Status({note}), "pass");
  EXPECT_EQ(Status({note, review}), "review");
  EXPECT_EQ(Status({fail, review, note}), "fail");
}

TEST(Finding, IsReadAsItWasWritten) {
  const std::vector<Finding> written = {{Severity::kNote, "few boards", "more"},
                                        {Severity::kReview, "blurred", ""},
                                        {Severity::kFail, "no boards", "photograph some"}};
  const std::vector<Finding> read = FindingsOf(VerdictReport(written));
  ASSERT_EQ(read.size(), written.size());
  for (size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].severity, written[i].severity);
    EXPECT_EQ(read[i].reason, written[i].reason);
    EXPECT_EQ(read[i].remedy, written[i].remedy);
  }
  EXPECT_TRUE(FindingsOf(Json::Value()).empty());
}

}  // namespace
}  // namespace insitu
