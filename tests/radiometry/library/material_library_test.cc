// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/library/material_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "radiometry/spectrum/color.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::HasSubstr;

const char kBrick[] = R"({"kind": "material", "source": "us", "licence": "CC0 1.0",
  "reflectance": [[380, 0.1], [780, 0.5]]})";
const char kSodium[] = R"({"kind": "lamp", "source": "us", "licence": "CC0 1.0",
  "spectrum_table": [[588, 0], [589, 1], [590, 0]]})";

template <typename Run>
std::string Complaint(const Run& run) {
  try {
    run();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class Library : public testing::Test {
 protected:
  // A text that names an entry.
  JsonNode Name(const std::string& name) {
    return JsonNode::Load(folder_.Write("names.json", "{\"name\": \"" + name + "\"}")).At("name");
  }
  ScratchFolder folder_;
};

TEST_F(Library, TheFirstFolderGoesBefore) {
  folder_.Write("site/brick.json",
                R"({"kind": "material", "source": "the site's", "licence": "-"})");
  folder_.Write("installed/walls/brick.json", kBrick);
  folder_.Write("installed/walls/tile.json", kBrick);
  const MaterialLibrary library(
      {folder_.path() / "site", folder_.path() / "not there", folder_.path() / "installed"});
  ASSERT_EQ(library.entries().size(), 2u);
  EXPECT_EQ(library.Material(Name("brick")).content.At("source").Text(), "the site's");
  EXPECT_EQ(library.Material(Name("brick")).group, "");
  EXPECT_EQ(library.Material(Name("tile")).group, "walls");
  EXPECT_EQ(ReflectanceOf(library.Material(Name("tile"))).back().y(), 0.5);
  EXPECT_THAT(Complaint([&] { ReflectanceOf(library.Material(Name("brick"))); }),
              HasSubstr("no reflectance by wavelength"));
}

TEST_F(Library, NamesThatAreNotThereAreTold) {
  folder_.Write("l/brick.json", kBrick);
  folder_.Write("l/sodium.json", kSodium);
  const MaterialLibrary library({folder_.path() / "l"});
  EXPECT_THAT(Complaint([&] { library.Material(Name("brik")); }), HasSubstr("is brick meant?"));
  EXPECT_THAT(Complaint([&] { library.Material(Name("sodium")); }),
              HasSubstr("no material of the library"));
  EXPECT_THAT(Complaint([&] { SpectrumOfLamp(library, Name("neon")); }),
              HasSubstr("expected D65, A, blackbody or a lamp"));
  EXPECT_EQ(SpectrumOfLamp(library, Name("sodium")).size(), 3u);
  EXPECT_GT(SpectrumOfLamp(library, Name("A")).size(), 50u);
}

TEST_F(Library, FilesAtFault) {
  const auto complaint = [&](const std::string& text) {
    folder_.Write("l/x.json", text);
    return Complaint([&] { MaterialLibrary({folder_.path() / "l"}); });
  };
  EXPECT_THAT(complaint(R"({"kind": "stone"})"), HasSubstr("expected material or lamp"));
  EXPECT_THAT(complaint(R"({"kind": "material", "source": "us"})"), HasSubstr("licence"));
  EXPECT_THAT(complaint(R"({"kind": "lamp", "source": "us", "licence": "-"})"),
              HasSubstr("spectrum_table"));
  folder_.Write("l/deeper/x.json", kBrick);
  EXPECT_THAT(complaint(kBrick), HasSubstr("one file a name"));
}

TEST_F(Library, FoldersOfSiteUserAndPrograms) {
  setenv("XDG_DATA_HOME", "/data", 1);
  setenv("INSITU_LIBRARY", "/mine", 1);
  const auto folders = LibraryFolders(SitePaths{"/site"});
  unsetenv("XDG_DATA_HOME");
  unsetenv("INSITU_LIBRARY");
  EXPECT_THAT(folders, testing::ElementsAre("/site/library", "/data/insitu/library", "/mine"));
}

// The library that is installed: every entry can be read, colours are what their names say.
TEST_F(Library, Ours) {
  const MaterialLibrary library({LibraryFolders(std::nullopt).back()});
  EXPECT_GT(library.entries().size(), 60u);
  const Eigen::Vector3d brick =
      ColorOfReflectance(ReflectanceOf(library.Material(Name("brick_red"))));
  EXPECT_GT(brick.x(), 2 * brick.z());
  const auto xy = [&](const std::string& lamp) {
    return Eigen::Vector2d(
        Chromaticity(Tristimulus(Sampled(SpectrumOfLamp(library, Name(lamp)), {}), {})).head<2>());
  };
  // CIE 15:2018; at 5 nm the tables agree to the printed digits, bins of 25 nm cut through lines.
  EXPECT_NEAR((xy("fluorescent_cool_white") - Eigen::Vector2d(0.3721, 0.3751)).norm(), 0, 6e-3);
  EXPECT_NEAR((xy("fluorescent_triband") - Eigen::Vector2d(0.3805, 0.3769)).norm(), 0, 8e-3);
  EXPECT_NEAR((xy("sodium_high_pressure") - Eigen::Vector2d(0.5330, 0.4150)).norm(), 0, 6e-3);
  EXPECT_NEAR((xy("led_warm") - Eigen::Vector2d(0.4560, 0.4078)).norm(), 0, 6e-3);
  EXPECT_NEAR((xy("led_neutral") - Eigen::Vector2d(0.3756, 0.3723)).norm(), 0, 6e-3);
}

}  // namespace
}  // namespace insitu
