// SPDX-License-Identifier: GPL-3.0-or-later
// Sites and buildings that nobody would draw so: what comes out is right all the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/picture/render.h"
#include "renderer/trace/interreflected_light.h"
#include "tests/renderer/trace/small_site.h"

namespace insitu {
namespace {

const SurfaceMaterial kGrey = {"grey", Eigen::Vector3d::Constant(0.5), 1, std::nullopt};

ArtificialEnvironment Tower(const SmallSite& site) {
  return Box(site, {-1, 3, 0}, {1, 5, 3}, kGrey);
}

Raster Picture(const SmallSite& site, const ArtificialEnvironment& building) {
  MontageScene scene = site.With(building);
  AddInterreflection(&scene, std::nullopt);
  const Raster picture = RenderMontage(scene, site.camera(), site.photo).linear;
  for (const float value : picture.data) {
    EXPECT_TRUE(std::isfinite(value) && value >= 0);
  }
  return picture;
}

// Mean and largest difference of the pixels.
std::pair<double, double> Difference(const Raster& a, const Raster& b) {
  double sum = 0, largest = 0;
  for (size_t i = 0; i < a.data.size(); ++i) {
    const double difference = std::abs(a.data[i] - b.data[i]);
    sum += difference;
    largest = std::max(largest, difference);
  }
  return {sum / static_cast<double>(a.data.size()), largest};
}

void ExpectSame(const Raster& a, const Raster& b) {
  const auto [mean, largest] = Difference(a, b);
  EXPECT_LT(mean, 2e-4);
  EXPECT_LT(largest, 0.04);
}

TEST(HardSite, APolygonTheWrongWayRoundIsTheSameSurface) {
  SmallSite site = MakeSmallSite();
  const Raster right = Picture(site, Tower(site));
  Polygon& lawn = site.natural.scene.polygons[0];
  std::ranges::reverse(lawn.vertices);
  lawn.normal = -lawn.normal;
  ExpectSame(Picture(site, Tower(site)), right);
}

TEST(HardSite, PolygonsThatOverlapAreOneSurface) {
  SmallSite site = MakeSmallSite();
  const Raster once = Picture(site, Tower(site));
  Polygon twin = site.natural.scene.polygons[0];
  for (Eigen::Vector3d& vertex : twin.vertices) {
    vertex = site.natural.scene.origin + 0.5 * (vertex - site.natural.scene.origin) +
             Eigen::Vector3d(0, 0, 0.008);
  }
  site.natural.scene.polygons.push_back(twin);
  ExpectSame(Picture(site, Tower(site)), once);
}

// In a gap nothing is known of what is there: the photograph stays; beside it all is as it was.
TEST(HardSite, WhereAPolygonLacksThePhotographStays) {
  SmallSite site = MakeSmallSite();
  const Raster whole = Picture(site, Tower(site));
  Polygon west = site.natural.scene.polygons[0], east = west;
  const auto at = [&](double x, double y) {
    return Eigen::Vector3d(site.natural.scene.origin + Eigen::Vector3d(x, y, 0));
  };
  west.vertices = {at(-100, -100), at(-2, -100), at(-2, 100), at(-100, 100)};
  east.vertices = {at(-1.5, -100), at(100, -100), at(100, 100), at(-1.5, 100)};
  site.natural.scene.polygons = {west, east};
  const Raster gap = Picture(site, Tower(site));
  EXPECT_LT(Difference(gap, whole).first, 0.005);
  const auto pixel = site.camera().camera.Project(
      site.camera().cam_from_world *
      (site.natural.scene.origin + Eigen::Vector3d(-1.75, 3.5, 0)));  // in the tower's shadow
  const auto x = static_cast<int>(std::lround(pixel->x()));
  const auto y = static_cast<int>(std::lround(pixel->y()));
  EXPECT_EQ(gap.Rgb(x, y), site.photo.Rgb(x, y));
  EXPECT_LT(whole.Rgb(x, y).x(), 0.8 * site.photo.Rgb(x, y).x());
}

// What no photograph shows reflects as the site does on the whole.
TEST(HardSite, AMaterialThatNoPhotographShowsIsTakenForTheSites) {
  SmallSite site = MakeSmallSite();
  Polygon wall = site.natural.scene.polygons[0];
  wall.name = wall.material = "wall";
  wall.photo.reset();
  const Eigen::Vector3d a = site.natural.scene.origin + Eigen::Vector3d(-4, -14, 0);
  wall.vertices = {a, a + Eigen::Vector3d(8, 0, 0), a + Eigen::Vector3d(8, 0, 9),
                   a + Eigen::Vector3d(0, 0, 9)};  // behind the camera
  wall.normal = -Eigen::Vector3d::UnitY();
  site.natural.scene.polygons.push_back(wall);
  site.natural.materials["wall"] = {};
  Picture(site, Box(site, {-3, -13, 0}, {3, -12, 8}, kGrey));
}

// Before the middle of a wall its length does not matter, if only it is long enough.
TEST(HardSite, AWallOfTenKilometresIsLitAsOneOfTwoHundredMetres) {
  const SmallSite site = MakeSmallSite();
  const auto wall = [&](double half) { return Box(site, {-half, 6, 0}, {half, 8, 4}, kGrey); };
  const Raster near = Picture(site, wall(100)), far = Picture(site, wall(5000));
  double largest = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 16; x < 48; ++x) {
      largest = std::max(largest, (near.Rgb(x, y) - far.Rgb(x, y)).cwiseAbs().maxCoeff());
    }
  }
  EXPECT_LT(largest, 0.02);
}

}  // namespace
}  // namespace insitu
