// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/measure_image_quality.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/radiometry/measure/edge_picture.h"

namespace insitu {
namespace {

// A card of one grey before a black field, `turn` [rad] about the line of sight, 2 m off.
SceneGeometry CardScene(int size, double turn) {
  SceneGeometry scene;
  const Camera camera = Camera::Pinhole(size, size, (size - 1) / 2.0, (size - 1) / 2.0, size, size);
  scene.cameras = {{"photo", camera, Rigid3{}}};
  Polygon card;
  for (const auto& [x, y] : {std::pair(-0.8, -0.8), {0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}}) {
    card.vertices.emplace_back(std::cos(turn) * x - std::sin(turn) * y,
                               std::sin(turn) * x + std::cos(turn) * y, 2);
  }
  card.normal = {0, 0, -1};
  scene.polygons = {card};
  return scene;
}

// Sigma [px] at a share of the squared half diagonal.
using Spread = double (*)(double share);

// The card as a lens of that spread draws it, edge by edge: exact but within 3 sigma of corners.
Photograph DrawCard(int size, double turn, Spread spread) {
  Photograph photo{Raster(size, size), Encoding::kLinear};
  const double half = 0.4 * size, middle = (size - 1) / 2.0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double u = std::cos(turn) * (x - middle) + std::sin(turn) * (y - middle);
      const double v = -std::sin(turn) * (x - middle) + std::cos(turn) * (y - middle);
      const double share =
          (std::pow(x - middle, 2) + std::pow(y - middle, 2)) / (size * size / 2.0);
      const double scale = spread(share) * std::numbers::sqrt2;
      const auto inside = [&](double t) {
        return 0.25 * std::erfc(-(t + half) / scale) * std::erfc((t - half) / scale);
      };
      photo.linear.SetRgb(x, y, Eigen::Vector3d::Constant(0.1 + 0.6 * inside(u) * inside(v)));
    }
  }
  return photo;
}

double Even(double) { return 0.7; }
double WorseOutside(double share) { return std::sqrt(0.25 + share); }

TEST(MeasurePointSpread, OfACard) {
  const SceneGeometry scene = CardScene(400, 0.1);
  const auto spread = MeasurePointSpread(DrawCard(400, 0.1, Even), EdgePiecesIn(scene, 0));
  ASSERT_TRUE(spread);
  EXPECT_NEAR(spread->center_sigma, 0.7, 0.02);
  EXPECT_EQ(spread->corner_sigma, spread->center_sigma);
  EXPECT_GE(spread->edges, 30);
  EXPECT_LT(spread->sigma_error, 0.02);
}

TEST(MeasurePointSpread, FollowsItsGrowthTowardsTheCorners) {
  const SceneGeometry scene = CardScene(800, 0.1);
  const auto spread = MeasurePointSpread(DrawCard(800, 0.1, WorseOutside), EdgePiecesIn(scene, 0));
  ASSERT_TRUE(spread);
  EXPECT_NEAR(spread->center_sigma, 0.5, 0.05);
  EXPECT_NEAR(spread->corner_sigma, std::sqrt(1.25), 0.06);
  EXPECT_NEAR(spread->SigmaAt({399.5, 399.5}, 800, 800), spread->center_sigma, 1e-9);
  EXPECT_NEAR(spread->SigmaAt({-0.5, 799.5}, 800, 800), spread->corner_sigma, 1e-9);
}

TEST(MeasurePointSpread, SaysSoWhereNoEdgeTells) {
  const SceneGeometry scene = CardScene(400, 0.1);
  EXPECT_FALSE(MeasurePointSpread(DrawCard(400, 0.1, Even), {}));
  const Photograph grey{Raster(400, 400), Encoding::kLinear};
  EXPECT_FALSE(MeasurePointSpread(grey, EdgePiecesIn(scene, 0)));
  // Along rows and columns no edge meets the pixels at all their phases.
  EXPECT_TRUE(EdgePiecesIn(CardScene(400, 0), 0).empty());
}

// One of a river or a road that goes on to where the photographer stands.
TEST(EdgePieces, AnEdgeToTheCamerasOwnPlaneIsSeenWhereItIsInTheFrame) {
  SceneGeometry scene = CardScene(400, 0.1);
  scene.polygons[0].vertices = {{0.02, 0.001, 1e-13}, {0, 0, 50}, {0.1, 0.3, 40}};
  const std::vector<EdgePiece> pieces = EdgePiecesIn(scene, 0);
  EXPECT_GE(pieces.size(), 3u);
  EXPECT_LE(pieces.size(), 20u);
}

// The same edge of two polygons is one.
TEST(EdgePieces, CountsAPlaceOnce) {
  SceneGeometry scene = CardScene(400, 0.1);
  const size_t once = EdgePiecesIn(scene, 0).size();
  scene.polygons.push_back(scene.polygons[0]);
  EXPECT_EQ(EdgePiecesIn(scene, 0).size(), once);
}

// A ramp of radiance with grain.
Photograph GrainyRamp(const Grain& grain) {
  Photograph photo{Raster(512, 512), Encoding::kLinear};
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x) {
      const Eigen::Vector3d rgb = Eigen::Vector3d::Constant(0.1 + 0.8 * y / 511);
      const Eigen::Vector3d noise =
          grain.Variance(rgb).cwiseSqrt().cwiseProduct(UnitGrain(grain, x, y, 1));
      photo.linear.SetRgb(x, y, rgb + noise);
    }
  }
  return photo;
}

TEST(MeasureGrain, FindsWhatWasPutIn) {
  Grain truth;
  truth.floor = {1e-5, 2e-5, 3e-5};
  truth.slope = {4e-5, 4e-5, 8e-5};
  truth.length = 0.6;
  truth.shared = 0.5;
  const auto grain = MeasureGrain(GrainyRamp(truth));
  ASSERT_TRUE(grain);
  for (const double radiance : {0.2, 0.8}) {
    const Eigen::Vector3d rgb = Eigen::Vector3d::Constant(radiance);
    const Eigen::Array3d ratio = grain->Variance(rgb).array() / truth.Variance(rgb).array();
    EXPECT_TRUE((ratio > 0.85).all() && (ratio < 1.15).all()) << ratio.transpose();
  }
  EXPECT_NEAR(grain->length, truth.length, 0.06);
  EXPECT_NEAR(grain->shared, truth.shared, 0.08);
}

TEST(MeasureGrain, NoneInWhatWasDrawn) {
  EXPECT_FALSE(MeasureGrain({Raster(512, 512), Encoding::kSrgb8}));
}

}  // namespace
}  // namespace insitu
