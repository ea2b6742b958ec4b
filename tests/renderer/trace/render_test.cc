// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/render.h"

#include <gtest/gtest.h>

#include "renderer/trace/sampling.h"
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

TEST(PixelSampler, SpreadsOverThePixelAndDependsOnItAlone) {
  const PixelSampler sampler(3, 4);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int ray = 0; ray < 4096; ++ray) {
    const Eigen::Vector2d offset = sampler.InPixel(ray);
    ASSERT_TRUE((offset.array() >= -0.5).all() && (offset.array() < 0.5).all());
    mean += offset / 4096;
  }
  EXPECT_LT(mean.norm(), 2e-3);
  EXPECT_EQ(PixelSampler(3, 4).InPixel(7), sampler.InPixel(7));
  EXPECT_NE(PixelSampler(4, 3).InPixel(7), sampler.InPixel(7));
}

TEST(ColorStatistics, StandardErrorOfTheMean) {
  ColorStatistics statistics;
  for (int i = 0; i < 8; ++i) statistics.Add(Eigen::Vector3d::Constant(i % 2));
  // Values 0 and 1 alike: variance 1/4, eight of them, seven degrees of freedom.
  EXPECT_NEAR(statistics.StandardError(), std::sqrt(0.25 / 7), 1e-9);
}

TEST(RenderOptions, NameTheFieldThatIsWrong) {
  EXPECT_EQ(WrongField(RenderOptions()), "");
  EXPECT_NE(WrongField(RenderOptions{.fewest_rays = 3}).find("fewest_rays"), std::string::npos);
  EXPECT_NE(WrongField(RenderOptions{.most_rays = 18}).find("most_rays"), std::string::npos);
  EXPECT_NE(WrongField(RenderOptions{.tolerance = 0}).find("tolerance"), std::string::npos);
  EXPECT_NE(WrongField(RenderOptions{.threads = -1}).find("threads"), std::string::npos);
  const SmallSite site = MakeSmallSite();
  EXPECT_THROW(RenderMontage(site.With({}), site.camera(), site.photo, {.threads = -1}),
               CheckError);
}

}  // namespace
}  // namespace insitu
