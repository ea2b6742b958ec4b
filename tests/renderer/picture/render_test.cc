// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/picture/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "renderer/trace/interreflected_light.h"
#include "tests/calibration/files/wrong_field.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

// A photograph in which every pixel differs, to tell pixels apart.
void Texture(SmallSite& site) {
  for (size_t i = 0; i < site.photo.data.size(); ++i) {
    site.photo.data[i] = 0.1f + 0.5f * static_cast<float>((i * 7919) % 1000) / 1000.0f;
  }
}

ArtificialEnvironment Tower(const SmallSite& site) {
  return Box(site, {-1, 3, 0}, {1, 5, 3}, {"tower", {0.6, 0.3, 0.2}, 1, std::nullopt});
}

TEST(RenderMontage, WithoutBuildingIsThePhotographBitForBit) {
  SmallSite site = MakeSmallSite();
  Texture(site);
  const MontageScene scene = site.With({});
  const RenderResult result = RenderMontage(scene, site.camera(), site.photo);
  EXPECT_EQ(result.linear.data, site.photo.data);
  EXPECT_EQ(result.building_pixels + result.changed_pixels, 0);
  EXPECT_EQ(result.mean_rays, 4);
}

TEST(RenderMontage, ALensWithDistortionKeepsThatLaw) {
  SmallSite site = MakeSmallSite();
  Texture(site);
  const MontageScene scene = site.With({});
  PosedCamera camera = site.camera();
  camera.camera = Camera("LENSMODEL_OPENCV4", {60, 61, 30, 22, -0.1, 0.02, 1e-3, -1e-3}, 64, 48);
  EXPECT_EQ(RenderMontage(scene, camera, site.photo).linear.data, site.photo.data);
}

TEST(RenderMontage, PixelsWithoutInfluenceAreThePhotographs) {
  SmallSite site = MakeSmallSite();
  Texture(site);
  const RenderResult result = RenderMontage(site.With(Tower(site)), site.camera(), site.photo);
  EXPECT_GT(result.building_pixels, 50);
  EXPECT_GT(result.changed_pixels, 50);
  // The tower reaches 3 m; the top row looks above the horizon beside it.
  for (int x : {0, 1, 2, 61, 62, 63}) {
    EXPECT_EQ(result.linear.Rgb(x, 0), site.photo.Rgb(x, 0)) << x;
  }
}

TEST(RenderMontage, DoesNotDependOnTheNumberOfThreads) {
  SmallSite site = MakeSmallSite();
  Texture(site);
  const MontageScene scene = site.With(Tower(site));
  RenderOptions one, three;
  one.threads = 1;
  three.threads = 3;
  EXPECT_EQ(RenderMontage(scene, site.camera(), site.photo, one).linear.data,
            RenderMontage(scene, site.camera(), site.photo, three).linear.data);
}

TEST(RenderMontage, EdgesTakeMoreRaysThanFlatGround) {
  SmallSite site = MakeSmallSite();
  RenderOptions fixed;
  fixed.most_rays = 4;
  const MontageScene scene = site.With(Tower(site));
  EXPECT_EQ(RenderMontage(scene, site.camera(), site.photo, fixed).mean_rays, 4);
  const double adaptive = RenderMontage(scene, site.camera(), site.photo).mean_rays;
  EXPECT_GT(adaptive, 4);
  EXPECT_LT(adaptive, 10);
}

// Rays come in fours until there are enough: where no tolerance is small enough, up to each cap.
TEST(RenderMontage, SamplesInStepsOfFourUpToTheCap) {
  SmallSite site = MakeSmallSite();
  Texture(site);
  const MontageScene scene = site.With(Tower(site));
  const double pixels = 64 * 48;
  const auto further_rays = [&](int most, double tolerance) {
    RenderOptions options;
    options.most_rays = most;
    options.tolerance = tolerance;
    return RenderMontage(scene, site.camera(), site.photo, options).mean_rays * pixels - 4 * pixels;
  };
  const double once = further_rays(8, 1e-12);
  EXPECT_GT(once, 400);
  EXPECT_NEAR(further_rays(12, 1e-12), 2 * once, 1e-6);
  EXPECT_NEAR(further_rays(16, 1e-12), 3 * once, 1e-6);
  EXPECT_NEAR(further_rays(RenderOptions().most_rays, 1e-12), 3 * once, 1e-6);
  const double usual = further_rays(16, RenderOptions().tolerance);
  EXPECT_GT(usual, 0);
  EXPECT_LT(usual, 3 * once);
}

// A quick look: four rays stand for sixteen pixels, and what the building does not touch stays.
TEST(RenderMontage, BlocksTakeASixteenthOfTheRays) {
  SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Tower(site));
  RenderOptions quick, whole;
  quick.block = 4;
  quick.most_rays = quick.outline_rays = whole.most_rays = whole.outline_rays = 4;
  quick.point_spread = PointSpread{0.7, 0.7, 0, 9};
  const RenderResult seen = RenderMontage(scene, site.camera(), site.photo, quick),
                     truth = RenderMontage(scene, site.camera(), site.photo, whole);
  EXPECT_NEAR(seen.mean_rays, 0.25, 1e-9);
  double error = 0, change = 0;
  for (size_t i = 0; i < seen.linear.data.size(); ++i) {
    error += std::abs(seen.linear.data[i] - truth.linear.data[i]);
    change += std::abs(truth.linear.data[i] - site.photo.data[i]);
  }
  EXPECT_LT(error, 0.4 * change);
  EXPECT_EQ(seen.linear.Rgb(0, 0), site.photo.Rgb(0, 0));
}

TEST(RenderMontage, BlocksScaleAShadowByWhatEachPixelShows) {
  SmallSite site = MakeSmallSite();
  Texture(site);
  RenderOptions quick;
  quick.block = 4;
  const RenderResult seen = RenderMontage(site.With(Tower(site)), site.camera(), site.photo, quick);
  for (const float value : seen.linear.data) ASSERT_GE(value, 0);
  EXPECT_GT(seen.changed_pixels, 50);
}

// The number of bins is how finely spectra are told, not how bright they are.
TEST(RenderMontage, NineBinsGiveThePictureOfSixteen) {
  for (const bool is_interreflected : {false, true}) {
    std::array<Raster, 2> pictures;
    for (const int bins : {16, 9}) {
      SmallSite site = MakeSmallSite(bins);
      Texture(site);
      // Low, so that one sees its sunlit top.
      MontageScene scene =
          site.With(Box(site, {-2, 2, 0}, {2, 6, 1}, {"box", {0.6, 0.3, 0.2}, 1, std::nullopt}));
      if (is_interreflected) AddInterreflection(&scene, std::nullopt);
      pictures[bins == 9] = RenderMontage(scene, site.camera(), site.photo).linear;
    }
    double largest = 0;
    for (size_t i = 0; i < pictures[0].data.size(); ++i) {
      largest = std::max<double>(largest, std::abs(pictures[0].data[i] - pictures[1].data[i]));
    }
    EXPECT_LT(largest, 0.005) << is_interreflected;
  }
}

constexpr double kSigma = 0.7;  // [px]

RenderOptions SpreadAlike() {
  RenderOptions options;
  options.point_spread = PointSpread{kSigma, kSigma, 0, 9};
  return options;
}

// As a lens of that spread draws it: the same view of eight times as many pixels, each of them
// ideal, weighed by the Gaussian.
Raster BlurredTruth(const SmallSite& site, const MontageScene& scene) {
  constexpr int kFiner = 8, kReach = 3 * kFiner;
  PosedCamera camera = site.camera();
  camera.camera = Camera::Pinhole(60 * kFiner, 60 * kFiner, 32 * kFiner - 0.5, 24 * kFiner - 0.5,
                                  64 * kFiner, 48 * kFiner);
  Raster photo(64 * kFiner, 48 * kFiner);
  photo.data.assign(photo.data.size(), static_cast<float>(kLawnRadiance));
  const Raster fine = RenderMontage(scene, camera, photo).linear;
  Raster blurred(64, 48);
  for (int y = 3; y < 45; ++y) {
    for (int x = 3; x < 61; ++x) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double weights = 0;
      for (int dy = -kReach; dy < kReach; ++dy) {
        for (int dx = -kReach; dx < kReach; ++dx) {
          const Eigen::Vector2d offset = Eigen::Vector2d(dx + 0.5, dy + 0.5) / kFiner;
          const double weight = std::exp(-offset.squaredNorm() / (2 * kSigma * kSigma));
          sum += weight * fine.Rgb(x * kFiner + kFiner / 2 + dx, y * kFiner + kFiner / 2 + dy);
          weights += weight;
        }
      }
      blurred.SetRgb(x, y, sum / weights);
    }
  }
  return blurred;
}

// Root mean square over the inner pixels.
double Difference(const Raster& a, const Raster& b) {
  double sum = 0;
  for (int y = 3; y < 45; ++y) {
    for (int x = 3; x < 61; ++x) sum += (a.Rgb(x, y) - b.Rgb(x, y)).squaredNorm();
  }
  return std::sqrt(sum / (42 * 58 * 3));
}

TEST(RenderMontage, SpreadsTheBuildingAsThePhotographSpreadsItsEdges) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Tower(site));
  const Raster truth = BlurredTruth(site, scene);
  const double ideal = Difference(RenderMontage(scene, site.camera(), site.photo).linear, truth);
  const double spread =
      Difference(RenderMontage(scene, site.camera(), site.photo, SpreadAlike()).linear, truth);
  EXPECT_LT(spread, 0.5 * ideal) << ideal;
}

Eigen::Vector3d SumOf(const Raster& image) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += image.Rgb(x, y);
  }
  return sum;
}

TEST(RenderMontage, SpreadingPreservesSums) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Tower(site));
  const Eigen::Vector3d photo = SumOf(site.photo);
  RenderOptions options;
  options.reach = 0;
  const Eigen::Vector3d ideal =
      SumOf(RenderMontage(scene, site.camera(), site.photo, options).linear) - photo;
  options.point_spread = SpreadAlike().point_spread;
  const Eigen::Vector3d spread =
      SumOf(RenderMontage(scene, site.camera(), site.photo, options).linear) - photo;
  EXPECT_LT((spread - ideal).norm(), 0.01 * ideal.norm());
}

TEST(RenderMontage, BeyondTheSpreadThePhotographStays) {
  SmallSite site = MakeSmallSite();
  Texture(site);
  EXPECT_EQ(RenderMontage(site.With({}), site.camera(), site.photo, SpreadAlike()).linear.data,
            site.photo.data);
  const Raster spread =
      RenderMontage(site.With(Tower(site)), site.camera(), site.photo, SpreadAlike()).linear;
  for (int x : {0, 1, 2, 61, 62, 63}) EXPECT_EQ(spread.Rgb(x, 0), site.photo.Rgb(x, 0)) << x;
}

TEST(RenderMontage, SpreadAndGrainDoNotDependOnThreads) {
  SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Tower(site));
  RenderOptions one = SpreadAlike();
  one.grain = Grain{Eigen::Vector3d::Constant(1e-4), Eigen::Vector3d::Zero(), 0.5, 0.3, 200};
  one.threads = 1;
  RenderOptions three = one;
  three.threads = 3;
  EXPECT_EQ(RenderMontage(scene, site.camera(), site.photo, one).linear.data,
            RenderMontage(scene, site.camera(), site.photo, three).linear.data);
}

// On the building all of it, in shadows what the darkened photograph lacks, elsewhere none.
TEST(RenderMontage, GrainIsAddedToWhatIsComputed) {
  SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Tower(site));
  const RenderResult plain = RenderMontage(scene, site.camera(), site.photo);
  RenderOptions options;
  options.grain = Grain{Eigen::Vector3d::Constant(1e-5), Eigen::Vector3d::Zero(), 0, 0, 200};
  const RenderResult grainy = RenderMontage(scene, site.camera(), site.photo, options);
  EXPECT_EQ(grainy.changed_pixels, plain.changed_pixels);
  double squares = 0;
  int count = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Eigen::Vector3d change = grainy.linear.Rgb(x, y) - plain.linear.Rgb(x, y);
      if (plain.linear.Rgb(x, y) == site.photo.Rgb(x, y)) {
        EXPECT_EQ(change, Eigen::Vector3d::Zero());
      } else {
        squares += change.squaredNorm() / 3;
        ++count;
      }
    }
  }
  EXPECT_GT(squares / count, 0.3e-5);
  EXPECT_LT(squares / count, 1.1e-5);
}

TEST(RenderOptions, NameTheFieldThatIsWrong) {
  EXPECT_EQ(WrongField(RenderOptions()), "");
  EXPECT_NE(WrongField(RenderOptions{.fewest_rays = 3}).find("fewest_rays"), std::string::npos);
  EXPECT_NE(WrongField(RenderOptions{.most_rays = 18}).find("most_rays"), std::string::npos);
  EXPECT_NE(WrongField(RenderOptions{.tolerance = 0}).find("tolerance"), std::string::npos);
  EXPECT_NE(WrongField(RenderOptions{.outline_rays = 8}).find("outline_rays"), std::string::npos);
  EXPECT_NE(WrongField(RenderOptions{.point_spread = PointSpread{}}).find("point_spread"),
            std::string::npos);
  EXPECT_NE(WrongField(RenderOptions{.threads = -1}).find("threads"), std::string::npos);
  const SmallSite site = MakeSmallSite();
  EXPECT_THROW(RenderMontage(site.With({}), site.camera(), site.photo, {.threads = -1}),
               CheckError);
}

// Leaves before the view: whole on the left, nothing on the right, a fraction between.
float LeafShare(int x) { return std::clamp((40.0f - static_cast<float>(x)) / 16, 0.0f, 1.0f); }

TEST(RenderMontage, WhatStandsInFrontStaysAndShowsWhatIsBehindItNow) {
  SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Tower(site));
  const RenderResult plain = RenderMontage(scene, site.camera(), site.photo);
  const Eigen::Vector3d leaf(0.02, 0.06, 0.01);
  Raster share(64, 48, 1);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double m = *share.At(x, y) = LeafShare(x);
      site.photo.SetRgb(x, y, m * leaf + (1 - m) * site.photo.Rgb(x, y));
    }
  }
  RenderOptions options;
  options.foreground = std::make_shared<const Foreground>(SeparateForeground(site.photo, share));
  const RenderResult result = RenderMontage(scene, site.camera(), site.photo, options);
  int mixed = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Eigen::Vector3d layers = result.layers.Rgb(x, y), now = result.linear.Rgb(x, y);
      const double m = LeafShare(x);
      EXPECT_EQ(layers.sum(), 1);
      EXPECT_EQ(layers[2], m);
      EXPECT_TRUE(layers[1] > 0 || now == site.photo.Rgb(x, y)) << x << " " << y;
      EXPECT_TRUE(m < 1 || layers[1] == 0) << x << " " << y;
      const Eigen::Vector3d truth = m * leaf + (1 - m) * plain.linear.Rgb(x, y);
      EXPECT_LT((now - truth).norm(), 0.02) << x << " " << y;
      mixed += m > 0 && layers[1] > 0;
    }
  }
  EXPECT_GT(mixed, 50);
}

// Stopped anywhere and gone on with, the picture is the same to the bit, with its counts.
TEST(RenderMontage, GoesOnWhereItWasStopped) {
  const SmallSite site = MakeSmallSite();
  const MontageScene scene = site.With(Tower(site));
  RenderOptions options = SpreadAlike();
  options.grain = Grain{Eigen::Vector3d::Constant(1e-4), Eigen::Vector3d::Constant(1e-4), 0};
  const RenderResult whole = RenderMontage(scene, site.camera(), site.photo, options);
  EXPECT_EQ(whole.tiles_left, 0);
  for (const int stopped_after : {0, 1, 3}) {
    std::vector<FinishedTile> kept;
    RenderCourse first;
    first.tile_done = [&](const FinishedTile& tile) { kept.push_back(tile); };
    first.stops = [&] { return static_cast<int>(kept.size()) >= stopped_after; };
    options.threads = 1;
    const RenderResult part = RenderMontage(scene, site.camera(), site.photo, options, first);
    EXPECT_EQ(part.tiles_left, 4 - stopped_after);
    RenderCourse second;
    second.earlier = kept;
    int rendered = 0;
    second.tile_done = [&](const FinishedTile&) { ++rendered; };
    const RenderResult rest = RenderMontage(scene, site.camera(), site.photo, options, second);
    EXPECT_EQ(rendered, 4 - stopped_after);
    EXPECT_EQ(rest.linear.data, whole.linear.data);
    EXPECT_EQ(rest.layers.data, whole.layers.data);
    EXPECT_EQ(rest.building_pixels, whole.building_pixels);
    EXPECT_EQ(rest.changed_pixels, whole.changed_pixels);
    EXPECT_EQ(rest.mean_rays, whole.mean_rays);
  }
}

TEST(RenderMontage, BeginsWithTheTilesInSightOfTheBuilding) {
  const SmallSite site = MakeSmallSite();
  RenderOptions options;
  options.threads = 1;
  std::vector<int64_t> of_building;
  RenderCourse course;
  course.tile_done = [&](const FinishedTile& tile) { of_building.push_back(tile.counts.building); };
  // In the lower right quarter alone.
  const auto hut = Box(site, {1.5, 0, 0}, {4, 2, 1}, {});
  RenderMontage(site.With(hut), site.camera(), site.photo, options, course);
  ASSERT_EQ(of_building.size(), 4u);
  EXPECT_GT(of_building[0], 0);
  EXPECT_EQ(of_building[3], 0);
}

}  // namespace
}  // namespace insitu
