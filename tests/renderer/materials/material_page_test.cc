// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/materials/material_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "renderer/building/building_materials.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::HasSubstr;

TEST(MaterialPage, ShowsEachEntryWithItsSource) {
  const ScratchFolder folder;
  folder.Write("library/walls/grey.json", R"({"kind": "material", "title": "<grey>",
    "source": "a book", "licence": "CC0 1.0", "diffuse_rgb": [0.5, 0.5, 0.5]})");
  folder.Write("library/lamp/red.json", R"({"kind": "lamp", "source": "us", "licence": "-",
    "spectrum_table": [[640, 0], [650, 1], [660, 0]]})");
  const MaterialLibrary library({folder.path() / "library"});
  EXPECT_THAT(MaterialList(library), HasSubstr("grey                     walls     <grey>"));
  NaturalEnvironment site;
  site.light.sky_radiance = site.spectra.SpectrumFromRgb({0.5, 0.7, 1});
  WriteMaterialPage(folder.path() / "page", library, site);
  const std::string page = ReadWhole(folder.path() / "page.html");
  EXPECT_THAT(page, HasSubstr("&lt;grey&gt;"));
  EXPECT_THAT(page, HasSubstr("a book"));
  EXPECT_THAT(page, HasSubstr("<h2>walls</h2>"));
  const Raster picture = ReadPhotograph(folder.path() / "page.png").linear;
  ASSERT_EQ(picture.width, 4 * 96);
  ASSERT_EQ(picture.height, 2 * 96);
  EXPECT_GT(picture.Rgb(48, 48).x(), 0.9);
  EXPECT_LT(picture.Rgb(48, 48).z(), 0.1);
  EXPECT_NEAR(picture.Rgb(150, 150).z() / picture.Rgb(150, 150).x(), 1, 0.05);  // under D65
  EXPECT_GT(picture.Rgb(340, 150).z(), 1.5 * picture.Rgb(340, 150).x());        // under that sky
}

// What is installed: every material can be read.
TEST(MaterialPage, OurLibraryIsRight) {
  const MaterialLibrary library({LibraryFolders(std::nullopt).back()});
  int clear = 0, metals = 0;
  for (const auto& [name, entry] : library.entries()) {
    if (entry.content.At("kind").Text() != "material") continue;
    const SurfaceMaterial surface =
        ReadBuildingMaterial(name, entry.content, entry.content.path().parent_path()).surface;
    clear += surface.glass ? 1 : 0;
    metals += surface.metal ? 1 : 0;
    EXPECT_LE(surface.diffuse_rgb.maxCoeff(), 0.9) << name;
  }
  EXPECT_EQ(clear, 5);
  EXPECT_EQ(metals, 9);
}

}  // namespace
}  // namespace insitu
