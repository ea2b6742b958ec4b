// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/levels/avr_levels.h"

#include <gtest/gtest.h>

#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

// A box before the camera, 2 m wide and high, and perhaps a wall that hides its left half.
class AvrLevels : public testing::Test {
 protected:
  AvrLevels() {
    for (size_t i = 0; i < site_.photo.data.size(); ++i) {
      site_.photo.data[i] = 0.1F + static_cast<float>(i % 97) / 500;
    }
  }

  void HideTheLeft() {
    Polygon wall = site_.natural.scene.polygons[0];
    wall.name = "wall";
    wall.vertices.clear();
    for (const auto& [x, z] : {std::pair(-9, 0), {0, 0}, {0, 9}, {-9, 9}}) {
      wall.vertices.push_back(site_.natural.scene.origin + Eigen::Vector3d(x, 0, z));
    }
    wall.normal = -Eigen::Vector3d::UnitY();
    site_.natural.scene.polygons.push_back(wall);
  }

  ArtificialEnvironment TheBox() const {
    SurfaceMaterial red{.name = "red", .diffuse_rgb = {0.7, 0.1, 0.1}};
    red.texture = "brick.png";
    red.specular = Specular{};
    return Box(site_, {-1, 3, 0.5}, {1, 5, 2.5}, red);
  }

  // What of the picture is not the photograph's, bit for bit.
  static long Differing(const RenderResult& result, const Raster& photo) {
    long differing = 0;
    for (int y = 0; y < photo.height; ++y) {
      for (int x = 0; x < photo.width; ++x) differing += result.linear.Rgb(x, y) != photo.Rgb(x, y);
    }
    return differing;
  }

  RenderResult Silhouette() const {
    const MontageScene scene = site_.With(TheBox());
    return DrawSilhouette({scene, site_.camera(), site_.photo});
  }
  RenderResult Outline() const {
    const MontageScene scene = site_.With(TheBox());
    return DrawOutline({scene, site_.camera(), site_.photo}, BuildingEdges(TheBox()));
  }
  bool IsPhotograph(const RenderResult& result, const Eigen::Vector3d& local) const {
    const auto pixel = site_.camera().camera.Project(site_.camera().cam_from_world *
                                                     (site_.natural.scene.origin + local));
    const int x = static_cast<int>(std::lround(pixel->x())),
              y = static_cast<int>(std::lround(pixel->y()));
    return result.linear.Rgb(x, y) == site_.photo.Rgb(x, y);
  }

  SmallSite site_ = MakeSmallSite();
};

TEST_F(AvrLevels, FormIsOneGreyAndNothingElse) {
  ArtificialEnvironment building = TheBox();
  building.lights.push_back({"lamp", Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()});
  const ArtificialEnvironment form = FormOf(building);
  ASSERT_EQ(form.materials.size(), 1U);
  EXPECT_EQ(form.materials[0].name, "red");
  EXPECT_EQ(form.materials[0].diffuse_rgb, Eigen::Vector3d(0.5, 0.5, 0.5));
  EXPECT_TRUE(form.materials[0].texture.empty());
  EXPECT_FALSE(form.materials[0].specular);
  EXPECT_TRUE(form.lights.empty());
  EXPECT_EQ(form.triangles.size(), building.triangles.size());
}

TEST_F(AvrLevels, SilhouetteCoversTheBoxAndNothingElse) {
  const RenderResult result = Silhouette();
  EXPECT_FALSE(IsPhotograph(result, {0, 3, 1.5}));
  EXPECT_FALSE(IsPhotograph(result, {-0.9, 3, 0.6}));
  EXPECT_TRUE(IsPhotograph(result, {-1.4, 3, 1.5}));
  EXPECT_TRUE(IsPhotograph(result, {0, 3, 0.1}));
  EXPECT_EQ(Differing(result, site_.photo), result.building_pixels);
  // Its front, 13 m away, and what is seen of its sides: about (2 m 60 px / 13 m)^2.
  EXPECT_NEAR(static_cast<double>(result.building_pixels), 9.2 * 9.2, 35);
}

TEST_F(AvrLevels, SilhouetteShowsWhatIsHiddenToo) {
  const long seen = Silhouette().building_pixels;
  HideTheLeft();
  EXPECT_EQ(Silhouette().building_pixels, seen);
}

TEST_F(AvrLevels, OutlineLeavesTheInsideThePhotographs) {
  const RenderResult result = Outline();
  EXPECT_TRUE(IsPhotograph(result, {0, 3, 1.5}));
  EXPECT_FALSE(IsPhotograph(result, {-1, 3, 1.5}));
  EXPECT_FALSE(IsPhotograph(result, {1, 3, 1.2}));
  EXPECT_TRUE(IsPhotograph(result, {-2, 3, 1.5}));
  EXPECT_EQ(Differing(result, site_.photo), result.building_pixels);
}

TEST_F(AvrLevels, WhatTheSiteHidesIsDashed) {
  const long whole = Outline().building_pixels;
  HideTheLeft();
  const long dashed = Outline().building_pixels;
  EXPECT_LT(dashed, whole);
  EXPECT_GT(dashed, whole / 2);
}

}  // namespace
}  // namespace insitu
