// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/render_site.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/foreground_matte.h"
#include "radiometry/natural_environment.h"
#include "renderer/light_cache.h"
#include "renderer/tiles/partial_render.h"
#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/make_montage_scene.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

using testing::HasSubstr;

// A site with nothing but what a montage is made of: no survey, no calibration, no reconstruction.
class RenderSiteTest : public testing::Test {
 protected:
  RenderSiteTest() {
    small_.natural.input_images[0].file = site_.input_image("photo");
    small_.natural.scene.camera_covariances = {1e-8 * Eigen::MatrixXd::Identity(6, 6)};
    WriteJson(site_.environment(), DescriptionOf(small_.natural, site_.environment()));
    WriteExr(site_.input_image("photo"), small_.photo);
    WriteExr(site_.photos() / "photo.exr", small_.photo);
    WriteArtificialEnvironment(site_, Box(small_, {-2, 0, 0}, {2, 4, 6}, {}));
  }
  std::string Complaint() const {
    try {
      RenderSite(site_, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  ScratchFolder folder_;
  SitePaths site_{folder_.path()};
  SmallSite small_ = MakeSmallSite();
};

TEST_F(RenderSiteTest, NeedsTheDescriptionsAndTheImagesAlone) {
  for (const Frame frame : {Frame::kPhoto, Frame::kPinhole}) {
    RenderSiteOptions options;
    options.frame = frame;
    const std::vector<RenderSiteReport> reports = RenderSite(site_, options);
    ASSERT_EQ(reports.size(), 1u);
    EXPECT_GT(reports[0].result.building_pixels, 100);
    ASSERT_TRUE(reports[0].uncertainty);
    EXPECT_GT(reports[0].uncertainty->corners, 3);
  }
  EXPECT_TRUE(std::filesystem::exists(site_.montages() / "photo.exr"));
  EXPECT_THAT(ReadWhole(site_.montages() / "photo.uncertainty.csv"), HasSubstr("sigma_major_px"));
}

// What stands before the lawn on the left stays the photograph; the building is drawn over it.
TEST_F(RenderSiteTest, HeedsMasksOfPolygons) {
  const Raster without = RenderSite(site_, {})[0].result.linear;
  Raster mask(64, 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 40; x < 64; ++x) mask.SetRgb(x, y, Eigen::Vector3d::Ones());
  }
  WritePng(site_.survey() / "lawn.png", mask, Encoding::kSrgb8);
  const std::string polygons = R"({"polygons": [{"name": "lawn", "mask": "lawn.png"}]})";
  WriteWhole(site_.survey() / "polygons.json", polygons);
  const RenderSiteReport report = RenderSite(site_, {})[0];
  const Raster& with = report.result.linear;
  int kept = 0, alike = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool was_lawn = with.Rgb(x, y) == small_.photo.Rgb(x, y);
      if (x < 40) kept += was_lawn && without.Rgb(x, y) != small_.photo.Rgb(x, y);
      if (x >= 41) alike += (with.Rgb(x, y) - without.Rgb(x, y)).norm() < 0.01;
    }
  }
  EXPECT_GT(kept, 50);        // darkened without the mask
  EXPECT_GT(alike, 22 * 48);  // what no photograph shows has the mean of the rest
  EXPECT_GT(report.result.building_pixels, 100);
  std::filesystem::remove(site_.survey() / "lawn.png");
  EXPECT_THAT(Complaint(), HasSubstr("lawn.png"));
}

TEST_F(RenderSiteTest, HoldsNoPictureThatIsWrittenUnlessAskedTo) {
  RenderSiteOptions options;
  const RenderResult kept = RenderSite(site_, options)[0].result;
  options.keeps_pictures = false;
  const RenderSiteReport report = RenderSite(site_, options)[0];
  EXPECT_EQ(report.pixels, 64 * 48);
  for (const Raster* picture :
       {&report.result.linear, &report.result.layers, &report.result.unseen}) {
    EXPECT_TRUE(picture->data.empty());
  }
  EXPECT_EQ(report.result.building_pixels, kept.building_pixels);
  EXPECT_EQ(ReadPhotograph(site_.montages() / "photo.exr").linear.data, kept.linear.data);
}

// In the frame of the pinhole a montage is made of the input image, as that camera sees it.
TEST_F(RenderSiteTest, ThePinholesFrameShowsTheInputImage) {
  for (size_t i = 0; i < small_.photo.data.size(); ++i) {
    small_.photo.data[i] = 0.1f + 0.0013f * static_cast<float>(i % 211);
  }
  WriteExr(site_.input_image("photo"), small_.photo);
  small_.natural.scene.cameras[0].camera =
      Camera("LENSMODEL_OPENCV4", {57, 58, 30, 22, -0.1, 0.02, 1e-3, -1e-3}, 64, 48);
  small_.natural.qualities = {{PointSpread{0.8, 0.8, 0.05, 12}, std::nullopt}};
  WriteJson(site_.environment(), DescriptionOf(small_.natural, site_.environment()));
  RenderSiteOptions options;
  options.find_shadows = false;  // the stripes of this picture are no shadows
  const RenderResult in_photo = RenderSite(site_, options)[0].result;
  options.frame = Frame::kPinhole;
  const RenderSiteReport report = RenderSite(site_, options)[0];
  // A pixel of the lens's middle spans 60 / 57.5 of the pinhole's.
  EXPECT_NEAR(report.point_spread->center_sigma, 0.8 * 60 / 57.5, 0.02);
  MontageScene scene =
      MakeMontageScene(ReadEnvironment(site_), ReadArtificialEnvironment(site_), {small_.photo});
  AddInterreflection(&scene, std::nullopt);
  PosedCamera pinhole = small_.camera();
  pinhole.camera = small_.pinhole;
  RenderOptions render;
  render.point_spread = report.point_spread;
  const RenderResult expected = RenderMontage(scene, pinhole, small_.photo, render);
  EXPECT_EQ(report.result.linear.data, expected.linear.data);
  EXPECT_EQ(report.result.linear.Rgb(0, 0), small_.photo.Rgb(0, 0));
  EXPECT_NE(in_photo.linear.data, expected.linear.data);
}

// The south face mirrors the lawn up to behind the camera, which shows it from 5.4 m south on.
TEST_F(RenderSiteTest, MarksWhatMirrorsShowOfWhatNoPhotographDoes) {
  const std::filesystem::path file = site_.montages() / "photo.unseen.exr";
  SurfaceMaterial material;
  const auto render = [&] {
    WriteArtificialEnvironment(site_, Box(small_, {-2, 0, 0}, {2, 4, 6}, material));
    return RenderSite(site_, {})[0].result;
  };
  material.specular = Specular{1};
  const RenderResult mirror = render();
  EXPECT_NEAR(*mirror.unseen.At(31, 26), 0, 0.01);  // 0.5 m up: the lawn 2 m south
  EXPECT_NEAR(*mirror.unseen.At(31, 17), 1, 0.01);  // 2 m up: the lawn 20 m south
  EXPECT_NEAR(*mirror.unseen.At(31, 5), 0, 0.01);   // 4 m up: the sky
  EXPECT_EQ(*mirror.unseen.At(5, 40), 0);           // the photograph
  EXPECT_GT(mirror.unseen_area, 0.2 * mirror.building_pixels);
  EXPECT_LT(mirror.unseen_area, 0.5 * mirror.building_pixels);
  EXPECT_GE(mirror.unseen_pixels, mirror.unseen_area);
  EXPECT_FLOAT_EQ(ReadPhotograph(file).linear.Rgb(31, 17)[0], *mirror.unseen.At(31, 17));
  material.specular = Specular{1, 1.5};  // mirrors 4 %
  EXPECT_NEAR(render().unseen_area / mirror.unseen_area, 0.04, 0.005);
  material.specular.reset();
  EXPECT_EQ(render().unseen_pixels, 0);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(RenderSiteTest, IsAsSharpAsThePhotographUnlessIdealIsAskedFor) {
  small_.natural.qualities = {{PointSpread{0.8, 0.8, 0.05, 12}, std::nullopt}};
  RenderSiteOptions options;
  const std::vector<float> unmeasured = RenderSite(site_, options)[0].result.linear.data;
  WriteJson(site_.environment(), DescriptionOf(small_.natural, site_.environment()));
  const RenderSiteReport measured = RenderSite(site_, options)[0];
  EXPECT_EQ(measured.point_spread->edges, 12);
  EXPECT_NE(measured.result.linear.data, unmeasured);
  options.sharpness = Sharpness::kIdeal;
  options.with_grain = true;  // of which nothing is known here
  const RenderSiteReport ideal = RenderSite(site_, options)[0];
  EXPECT_FALSE(ideal.point_spread);
  EXPECT_FALSE(ideal.has_grain);
  EXPECT_EQ(ideal.result.linear.data, unmeasured);
}

TEST_F(RenderSiteTest, RefusesAPhotographTakenFromWithinTheBuilding) {
  RenderSite(site_, {});
  WriteArtificialEnvironment(site_, Box(small_, {-5, -15, 0}, {5, -5, 6}, {}));
  const RenderSiteReport report = RenderSite(site_, {})[0];
  EXPECT_TRUE(report.is_within_building);
  ASSERT_EQ(report.remarks.size(), 1u);
  EXPECT_THAT(report.remarks[0], HasSubstr("from within the building"));
  EXPECT_FALSE(std::filesystem::exists(site_.montages() / "photo.exr"));
  // Without its south wall it is a room that one looks into.
  ArtificialEnvironment open = Box(small_, {-5, -15, 0}, {5, -5, 6}, {});
  open.triangles.erase(open.triangles.begin() + 4, open.triangles.begin() + 6);
  open.material_of_triangle.resize(open.triangles.size());
  WriteArtificialEnvironment(site_, open);
  EXPECT_FALSE(RenderSite(site_, {})[0].is_within_building);
}

// White lawn: how bright it is behind the sensor's highest code, nobody knows.
TEST_F(RenderSiteTest, SaysWhereItDarkensWhatIsClipped) {
  EXPECT_EQ(RenderSite(site_, {})[0].result.clipped_darkened, 0);
  std::ranges::fill(small_.photo.data, 1.0F);
  std::filesystem::remove(site_.photos() / "photo.exr");
  WritePng(site_.photos() / "photo.png", small_.photo, Encoding::kSrgb8);
  WriteExr(site_.input_image("photo"), small_.photo);
  const RenderSiteReport report = RenderSite(site_, {})[0];
  EXPECT_GT(report.result.clipped_darkened, 10);
  EXPECT_LE(report.result.clipped_darkened + report.result.clipped_lifted,
            report.result.changed_pixels);
  ASSERT_FALSE(report.remarks.empty());
  EXPECT_THAT(report.remarks[0], HasSubstr(std::to_string(report.result.clipped_darkened) +
                                           " pixels are clipped in the photograph and darkened"));
}

// The same site photographed with a stop and a half more: the montage is that much brighter, and
// what the building does not touch is the photograph.
TEST_F(RenderSiteTest, APhotographOfAnotherExposureStaysInItsOwn) {
  const Raster usual = RenderSite(site_, {})[0].result.linear;
  Json::Value environment = ReadJson(site_.environment());
  const Eigen::Vector3d gain(2.8, 2.8, 2.6);
  environment["scene"]["cameras"][0]["exposure"] = ToJson(gain);
  WriteJson(site_.environment(), environment);
  Raster brighter = small_.photo;
  for (size_t i = 0; i < brighter.data.size(); ++i) {
    brighter.data[i] *= static_cast<float>(gain[static_cast<int>(i % 3)]);
  }
  WriteExr(site_.input_image("photo"), brighter);
  WriteExr(site_.photos() / "photo.exr", brighter);
  for (const Frame frame : {Frame::kPhoto, Frame::kPinhole}) {
    RenderSiteOptions options;
    options.frame = frame;
    const RenderResult result = RenderSite(site_, options)[0].result;
    EXPECT_GT(result.building_pixels, 100);
    int untouched = 0;
    for (size_t i = 0; i < usual.data.size(); ++i) {
      EXPECT_NEAR(result.linear.data[i], usual.data[i] * gain[static_cast<int>(i % 3)], 0.02);
      untouched += result.linear.data[i] == brighter.data[i];
    }
    EXPECT_GT(untouched, 100);
  }
}

TEST_F(RenderSiteTest, WhatIsMissingNamesItsProgram) {
  std::filesystem::remove(site_.input_image("photo"));
  EXPECT_THAT(Complaint(), HasSubstr("insitu-undistort"));
  std::filesystem::remove(site_.environment());
  EXPECT_THAT(Complaint(), HasSubstr("insitu-light"));
}

TEST_F(RenderSiteTest, RefusesImagesOfAnotherSize) {
  WriteExr(site_.input_image("photo"), Raster(32, 24));
  EXPECT_THAT(Complaint(), HasSubstr("photo.exr: is 32x24 px, expected 64x48 px"));
  WriteExr(site_.input_image("photo"), small_.photo);
  WriteExr(site_.photos() / "photo.exr", Raster(64, 40));
  EXPECT_THAT(Complaint(), HasSubstr("photo.exr: is 64x40 px, expected 64x48 px"));
}

TEST_F(RenderSiteTest, RefusesAPhotographThatTheEnvironmentLacks) {
  WriteExr(site_.photos() / "other.exr", small_.photo);
  EXPECT_THAT(Complaint(), HasSubstr("has no camera for photograph other"));
}

TEST_F(RenderSiteTest, LeavesWhatStandsInFrontInEitherFrame) {
  Raster white(64, 48, 1);
  white.data.assign(white.data.size(), 1);
  for (const Encoding encoding : {Encoding::kSrgb8, Encoding::kSrgb16}) {
    WritePng(site_.survey() / "foreground/photo.png", white, encoding);
    for (const Frame frame : {Frame::kPhoto, Frame::kPinhole}) {
      RenderSiteOptions options;
      options.frame = frame;
      const RenderResult result = RenderSite(site_, options)[0].result;
      EXPECT_EQ(result.linear.data, small_.photo.data);
      EXPECT_EQ(result.building_pixels + result.changed_pixels, 0);
    }
  }
  const Raster layers = ReadPhotograph(site_.montages() / "photo.layers.exr").linear;
  EXPECT_EQ(layers.Rgb(30, 20), Eigen::Vector3d(0, 0, 1));
}

// Where somebody has drawn that the sun does not arrive, the building takes none of it away.
TEST_F(RenderSiteTest, ADrawnShadowStays) {
  const auto darkest = [&](const RenderSiteOptions& options) {
    const RenderResult result = RenderSite(site_, options)[0].result;
    double least = 1;
    for (int y = 24; y < 30; ++y) {
      for (int x = 0; x < 20; ++x) {
        if (*(result.layers.At(x, y) + 1) == 0) continue;
        least = std::min(least, result.linear.Rgb(x, y).y() / kLawnRadiance);
      }
    }
    return least;
  };
  RenderSiteOptions without_search;
  without_search.find_shadows = false;
  EXPECT_LT(darkest(without_search), 0.5);  // the box shades the lawn west of it
  EXPECT_FALSE(std::filesystem::exists(site_.montages() / "photo.shadows.exr"));
  WritePng(site_.survey() / "shadows/photo.png", Raster(64, 48, 1), Encoding::kSrgb8);
  EXPECT_GT(darkest({}), 0.6);
  const Raster shares = ReadPhotograph(site_.montages() / "photo.shadows.exr").linear;
  EXPECT_EQ(shares.Rgb(10, 40).x(), 0);
  WritePng(site_.survey() / "shadows/photo.png", Raster(64, 40, 1), Encoding::kSrgb8);
  EXPECT_THAT(Complaint(), HasSubstr("shadows/photo.png: is 64x40 px, expected 64x48 px"));
}

TEST_F(RenderSiteTest, RefusesAMatteThatCannotBeOne) {
  const auto matte = site_.survey() / "foreground/photo.png";
  WritePng(matte, Raster(64, 40, 1), Encoding::kSrgb8);
  EXPECT_THAT(Complaint(), HasSubstr("foreground/photo.png: is 64x40 px, expected 64x48 px"));
  Raster red(64, 48);
  red.SetRgb(5, 5, {1, 0, 0});
  WritePng(matte, red, Encoding::kSrgb8);
  EXPECT_THAT(Complaint(), HasSubstr("foreground/photo.png: is coloured, expected a grey picture"));
}

TEST_F(RenderSiteTest, TellsOfMattesThatBelongToNoPhotograph) {
  EXPECT_TRUE(UnreadDrawings(site_).empty());
  WritePng(site_.survey() / "foreground/photo.png", Raster(64, 48, 1), Encoding::kSrgb8);
  WritePng(site_.survey() / "foreground/foto.png", Raster(64, 48, 1), Encoding::kSrgb8);
  const std::vector<std::string> unread = UnreadDrawings(site_);
  ASSERT_EQ(unread.size(), 1u);
  EXPECT_THAT(unread[0], HasSubstr("foto.png: is not read"));
  EXPECT_THAT(unread[0], HasSubstr("as in photo.png"));
}

// Stripes 2 m wide on a box 4 m wide.
TEST_F(RenderSiteTest, ShowsTheTexturesOfTheBuilding) {
  Raster stripes(64, 1);
  for (int x = 0; x < 32; ++x) stripes.SetRgb(x, 0, {1, 1, 1});
  WritePng(site_.building() / "stripes.png", stripes, Encoding::kSrgb8);
  SurfaceMaterial material;
  material.texture = "stripes.png";
  material.texture_size = {4, 4};
  WriteArtificialEnvironment(site_, Box(small_, {-2, 0, 0}, {2, 4, 6}, material));
  const Raster picture = RenderSite(site_, {})[0].result.linear;
  double least = 1, most = 0;
  for (int x = 20; x < 44; ++x) {
    least = std::min(least, picture.Rgb(x, 24).x());
    most = std::max(most, picture.Rgb(x, 24).x());
  }
  EXPECT_LT(least, 0.2 * most);
  EXPECT_FALSE(std::filesystem::is_empty(site_.root / "work/textures"));
}

// All that lies in montages/.
std::map<std::string, std::string> Montages(const SitePaths& site) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(site.montages())) {
    files[entry.path().filename().string()] = ReadWhole(entry.path());
  }
  return files;
}

TEST_F(RenderSiteTest, StoppedItGoesOnToTheSameBytes) {
  RenderSite(site_, {});
  const auto expected = Montages(site_);
  const auto partial = site_.root / "work/render/photo.partial";
  EXPECT_FALSE(std::filesystem::exists(partial));
  for (const int calls : {0, 3, 4, 5}) {  // asked twice before the first tile, then before each
    std::filesystem::remove_all(site_.montages());
    RenderSiteOptions options;
    options.render.threads = 1;
    int asked = 0;
    options.stops = [&] { return asked++ >= calls; };
    EXPECT_THROW(RenderSite(site_, options), RenderStopped);
    EXPECT_FALSE(std::filesystem::exists(site_.montages() / "photo.exr"));
    if (calls > 2) {
      PartialRenderReader reader(partial);
      EXPECT_EQ(reader.Read().tiles.size(), static_cast<size_t>(calls - 2));
    }
    RenderSite(site_, {});  // with other threads
    EXPECT_EQ(Montages(site_), expected);
    EXPECT_FALSE(std::filesystem::exists(partial));
  }
}

TEST_F(RenderSiteTest, WhatWasRenderedOfOtherInputsIsNotGoneOnWith) {
  const auto stop_after_three = [&](RenderSiteOptions options) {
    options.render.threads = 1;
    int asked = 0;
    options.stops = [&] { return asked++ >= 5; };
    EXPECT_THROW(RenderSite(site_, options), RenderStopped);
  };
  RenderSiteOptions others;
  others.render.most_rays = 4;
  RenderSite(site_, others);
  auto expected = Montages(site_);
  stop_after_three({});
  RenderSite(site_, others);
  EXPECT_EQ(Montages(site_), expected);

  SurfaceMaterial white;
  white.diffuse_rgb.setConstant(0.9);
  stop_after_three({});
  WriteArtificialEnvironment(site_, Box(small_, {-2, 0, 0}, {2, 4, 6}, white));
  RenderSite(site_, {});
  expected = Montages(site_);
  std::filesystem::remove_all(site_.root / "work/render");
  RenderSite(site_, {});
  EXPECT_EQ(Montages(site_), expected);
}

// The hash that a cache begins with after its first word.
std::string InputsOf(const std::filesystem::path& cache) {
  const std::string text = ReadWhole(cache);
  const size_t first = text.find(' ') + 1;
  return text.substr(first, text.find(' ', first) - first);
}

TEST_F(RenderSiteTest, TheNextRenderTakesUpTheLight) {
  const auto cache = site_.root / "work/render/light.cache";
  RenderSite(site_, {});
  const auto expected = Montages(site_);
  RenderSite(site_, {});
  EXPECT_EQ(Montages(site_), expected);
  auto light = ReadLightCache(cache, InputsOf(cache));
  ASSERT_TRUE(light);
  ASSERT_FALSE(light->on_building.empty());
  for (KeptPoint& point : light->on_building) point.before *= 2;
  WriteLightCache(cache, InputsOf(cache), *light);
  RenderSite(site_, {});
  EXPECT_NE(Montages(site_), expected);
}

TEST_F(RenderSiteTest, AnotherBuildingHasItsOwnLight) {
  const auto cache = site_.root / "work/render/light.cache";
  RenderSite(site_, {});
  const std::string before = InputsOf(cache);
  WriteArtificialEnvironment(site_, Box(small_, {-1, 0, 0}, {2, 4, 6}, {}));
  RenderSite(site_, {});
  EXPECT_NE(InputsOf(cache), before);
  const auto expected = Montages(site_);
  std::filesystem::remove_all(site_.root / "work/render");
  RenderSite(site_, {});
  EXPECT_EQ(Montages(site_), expected);
}

TEST_F(RenderSiteTest, ThePhotographsOfAStoppedRunAreNotRenderedTwice) {
  std::filesystem::copy(site_.photos() / "photo.exr", site_.photos() / "z.exr");
  small_.natural.scene.cameras.push_back(small_.natural.scene.cameras[0]);
  small_.natural.scene.cameras[1].photo = "z";
  small_.natural.scene.camera_covariances.push_back(small_.natural.scene.camera_covariances[0]);
  small_.natural.input_images.push_back(small_.natural.input_images[0]);
  WriteJson(site_.environment(), DescriptionOf(small_.natural, site_.environment()));
  RenderSiteOptions options;
  options.render.threads = 1;
  int asked = 0;
  options.stops = [&] { return asked++ >= 9; };  // in the second one
  EXPECT_THROW(RenderSite(site_, options), RenderStopped);
  EXPECT_TRUE(std::filesystem::exists(site_.montages() / "photo.exr"));
  PartialRenderReader reader(site_.root / "work/render/photo.partial");
  EXPECT_EQ(reader.Read().tiles.size(), 4u);
  int rest = 0;
  options.stops = [&] {
    ++rest;
    return false;
  };
  RenderSite(site_, options);
  EXPECT_LT(rest, 8);
  EXPECT_TRUE(std::filesystem::is_empty(site_.root / "work/render") ||
              !std::filesystem::exists(site_.root / "work/render/photo.partial"));
}

}  // namespace
}  // namespace insitu
