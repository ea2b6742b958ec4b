// SPDX-License-Identifier: GPL-3.0-or-later
// materials.json as `insitu new` writes it, and as FILES.md tells it.
#include <gtest/gtest.h>

#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "radiometry/light/material.h"
#include "reconstruction/new_site.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

TEST(WrittenMaterials, AreRead) {
  const ScratchFolder folder;
  const SitePaths site{folder.path()};
  WritePng(site.photos() / "a.png", Raster(640, 480), Encoding::kSrgb8);
  MakeNewSite(site);
  EXPECT_TRUE(ReadNaturalMaterials(site).empty());

  const std::string text =
      ReadWhole(fs::path(INSITU_SOURCE_FOLDER) / "reconstruction" / "FILES.md");
  const size_t heading = text.find("## `survey/materials.json`\n");
  ASSERT_NE(heading, std::string::npos);
  const size_t begin = text.find('\n', text.find("```", heading)) + 1;
  WriteWhole(site.survey() / "materials.json", text.substr(begin, text.find("```", begin) - begin));
  const auto materials = ReadNaturalMaterials(site);
  ASSERT_EQ(materials.size(), 3u);
  EXPECT_NEAR(materials.at("water").specular->roughness.slope, 0.05, 1e-12);
  ASSERT_TRUE(materials.at("river").bumps);
  EXPECT_EQ(materials.at("river").bumps->rms_slope, 0.08);
  EXPECT_EQ(materials.at("river").bumps->longest, 1.5);
}

}  // namespace
}  // namespace insitu
