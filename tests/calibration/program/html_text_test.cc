// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/html_text.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

TEST(HtmlText, EndsNeitherTagNorAttribute) {
  EXPECT_EQ(HtmlText("<b title=\"A & B\">"), "&lt;b title=&quot;A &amp; B&quot;&gt;");
  EXPECT_EQ(HtmlText("Zürich's"), "Zürich's");
}

}  // namespace
}  // namespace insitu
