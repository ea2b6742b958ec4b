// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/warnings.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

TEST(WarningLines, ALineEach) {
  EXPECT_EQ(WarningLines({}), "");
  EXPECT_EQ(WarningLines({"dark", "over\ntwo lines"}), "warning: dark\nwarning: over two lines\n");
}

}  // namespace
}  // namespace insitu
