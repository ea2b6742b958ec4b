// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/batch/contact_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::HasSubstr;
using testing::Not;

class ContactSheetTest : public testing::Test {
 protected:
  ContactSheetTest() {
    plan_.file = scratch_.path() / "evening.json";
    plan_.site.root = scratch_.path();
  }
  SheetEntry Entry(const std::string& hour) const {
    SheetEntry entry;
    entry.job = {"IMG_1", "tower", hour, "final", {}, {}};
    return entry;
  }
  std::string Page(const SheetEntry& entry) const { return ContactSheet(plan_, {entry}); }

  ScratchFolder scratch_;
  BatchPlan plan_;
};

TEST_F(ContactSheetTest, ShowsAPictureSmallWithItsTime) {
  SheetEntry entry = Entry("");
  entry.is_done = true;
  entry.seconds = 12.34;
  Raster grey(40, 30);
  WritePng(scratch_.path() / "montages/tower/IMG_1.png", grey, Encoding::kSrgb8);
  const std::string page = Page(entry);
  EXPECT_THAT(page, HasSubstr("<img alt=\"tower/IMG_1\" src=\"data:image/jpeg;base64,"));
  EXPECT_THAT(page, HasSubstr("<a href=\"tower/IMG_1.png\">"));
  EXPECT_THAT(page, HasSubstr("rendered in 12.3 s"));
  EXPECT_THAT(page, HasSubstr("1 of 1 pictures"));
  EXPECT_THAT(page, HasSubstr("the photograph's light"));
}

TEST_F(ContactSheetTest, SaysOfASimulationThatItIsOne) {
  SheetEntry entry = Entry("1630");
  entry.simulation = "simulated daylight, not the photograph's: 16:30";
  const std::string page = Page(entry);
  EXPECT_THAT(page, HasSubstr("class=\"simulation\">simulated daylight, not the photograph"));
  EXPECT_THAT(page, HasSubstr("1 in simulated daylight"));
}

TEST_F(ContactSheetTest, TellsWhyAPictureIsMissing) {
  SheetEntry entry = Entry("");
  EXPECT_THAT(Page(entry), HasSubstr("not rendered yet"));
  entry.fault = "failed (status 137)";
  EXPECT_THAT(Page(entry), HasSubstr("<b>failed:</b> failed (status 137)"));
  EXPECT_THAT(Page(entry), Not(HasSubstr("not rendered yet")));
}

TEST_F(ContactSheetTest, NamesStayText) {
  SheetEntry entry = Entry("");
  entry.job.view = "<script>alert(1)</script>\"'";
  entry.fault = "<img src=x onerror=y>";
  const std::string page = Page(entry);
  EXPECT_THAT(page, Not(HasSubstr("<script>")));
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
}

}  // namespace
}  // namespace insitu
