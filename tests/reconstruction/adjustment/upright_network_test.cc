// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs without a surveyor: what turns their network upright and gives it metres.
#include <gmock/gmock.h>

#include <Eigen/LU>
#include <algorithm>
#include <random>

#include "reconstruction/adjustment/adjust.h"
#include "reconstruction/colmap/upright_model.h"
#include "tests/reconstruction/survey/synthetic_tie_points.h"

namespace insitu {
namespace {

using Kind = GeometricConstraint::Kind;

// The town without control, sun and polygons, with tie points and marks of its corners.
class TownWithoutControl : public testing::Test {
 protected:
  TownWithoutControl() {
    Survey survey = WithNoise(network_.survey, 7);
    survey.control_points.clear();
    survey.polygons.clear();
    survey.sun_pairs.clear();
    // Corners of the boxes alone: others may be marked on one photograph.
    std::erase_if(survey.observations, [](const ImageObservation& mark) {
      return mark.point.size() != 2 || std::string("abc").find(mark.point[0]) == std::string::npos;
    });
    pairs_ = survey.zenith_pairs;
    survey.zenith_pairs.clear();
    survey.tie_points = ModelOf(network_, 80);
    std::mt19937 generator(3);
    std::normal_distribution<double> normal(0, 0.5);
    for (TiePoint& point : survey.tie_points->points) {
      for (TiePointMark& mark : point.marks) {
        mark.pixel += Eigen::Vector2d(normal(generator), normal(generator));
      }
    }
    survey_ = survey;
  }
  double Distance(const std::string& a, const std::string& b) const {
    return (network_.points.at(a) - network_.points.at(b)).norm();
  }
  void AddDistance(const std::string& a, const std::string& b) {
    survey_.constraints.push_back({Kind::kDistance, {}, {a, b}, Distance(a, b), 0.003, {}});
  }
  Adjustment Solve() const { return Adjust(survey_, network_.photos, network_.cameras); }
  // Of the true zenith to where an adjustment says up is [rad], by the boxes' edges.
  double OffUpright(const Adjustment& adjustment) const {
    Eigen::Vector3d up = Eigen::Vector3d::Zero();
    for (const DirectionPair& pair : pairs_) {
      up += PositionOf(adjustment, pair.to) - PositionOf(adjustment, pair.from);
    }
    return std::acos(std::min(1.0, up.normalized().dot(adjustment.scene.zenith.unit)));
  }
  static Eigen::Vector3d PositionOf(const Adjustment& adjustment, const std::string& name) {
    return std::ranges::find(adjustment.points, name, &AdjustedPoint::name)->position;
  }

  SyntheticNetwork network_ = MakeSyntheticNetwork();
  std::vector<DirectionPair> pairs_;
  Survey survey_;
};

TEST_F(TownWithoutControl, GetsMetresByADistanceAndIsUprightByZenithPairs) {
  AddDistance("a0", "a1");
  survey_.zenith_pairs = pairs_;
  const Adjustment adjustment = Solve();
  EXPECT_TRUE(adjustment.is_converged);
  EXPECT_TRUE(adjustment.has_scale);
  EXPECT_NEAR((PositionOf(adjustment, "b0") - PositionOf(adjustment, "c0")).norm(),
              Distance("b0", "c0"), 0.05);
  EXPECT_EQ(adjustment.scene.zenith.unit, Eigen::Vector3d::UnitZ());
  EXPECT_LT(OffUpright(adjustment), 0.003);
  ASSERT_TRUE(adjustment.datum_worth.scale && adjustment.datum_worth.tilt);
  EXPECT_NEAR(*adjustment.datum_worth.scale, 0.003 / Distance("a0", "a1"), 2e-4);
  EXPECT_LT(*adjustment.datum_worth.tilt, 0.01);
  EXPECT_FALSE(adjustment.datum_worth.heading || adjustment.datum_worth.height);
  EXPECT_THAT(adjustment.warnings, testing::Contains(testing::HasSubstr("scale by 1 length")));
}

TEST_F(TownWithoutControl, IsUprightByVerticalEdges) {
  for (const DirectionPair& pair : pairs_) {
    survey_.constraints.push_back({Kind::kVertical, {}, {pair.to, pair.from}, 0, 0.002, {}});
  }
  const Adjustment adjustment = Solve();
  EXPECT_TRUE(adjustment.is_converged);
  EXPECT_LT(OffUpright(adjustment), 0.005);
  EXPECT_FALSE(adjustment.has_scale);
  EXPECT_THAT(adjustment.BriefReport(), testing::Not(testing::HasSubstr(" mm")));
  EXPECT_THAT(adjustment.BriefReport(), testing::HasSubstr("no scale, plumb to"));
}

// Nothing stated: as the cameras were held.
TEST_F(TownWithoutControl, IsNearlyUprightOfItself) {
  const Adjustment adjustment = Solve();
  EXPECT_LT(OffUpright(adjustment), 0.2);
  EXPECT_THAT(adjustment.warnings,
              testing::Contains(testing::HasSubstr("turned upright as the cameras were held")));
}

// An antenna a metre off the lens, whose place is told.
TEST_F(TownWithoutControl, TakesAntennasAtALeverArm) {
  const Eigen::Vector3d arm(0.2, -1, 0.3);
  for (size_t i = 0; i < network_.photos.size(); ++i) {
    const Rigid3& pose = network_.cam_from_world[i];
    const Eigen::Vector3d antenna = Center(pose) + pose.rotation.conjugate() * arm;
    survey_.camera_positions.push_back({network_.photos[i],
                                        antenna,
                                        Eigen::Vector3d::Constant(0.01),
                                        PositionRole::kWeighted,
                                        {},
                                        arm});
  }
  const Adjustment adjustment = Solve();
  for (size_t i = 0; i < network_.photos.size(); ++i) {
    EXPECT_LT(
        (Center(adjustment.poses[i].cam_from_world) - Center(network_.cam_from_world[i])).norm(),
        0.1);
  }
  EXPECT_LT((PositionOf(adjustment, "b0") - network_.points.at("b0")).norm(), 0.1);
}

// Satellite positions in a row tell no tilt.
TEST_F(TownWithoutControl, StaysUprightOnPositionsThatTellNoTilt) {
  for (size_t i = 0; i < network_.photos.size(); ++i) {
    const Eigen::Vector3d error(3 * std::sin(4.0 * i), 3 * std::cos(5.0 * i),
                                6 * std::sin(7.0 * i));
    survey_.camera_positions.push_back({network_.photos[i],
                                        Center(network_.cam_from_world[i]) + error,
                                        {5, 5, 10},
                                        PositionRole::kWeighted,
                                        {}});
  }
  survey_.zenith_pairs = pairs_;
  const Adjustment adjustment = Solve();
  EXPECT_TRUE(adjustment.is_converged);
  EXPECT_LT(OffUpright(adjustment), 0.02);
  EXPECT_GT(*adjustment.datum_worth.height, 4);
}

}  // namespace
}  // namespace insitu
