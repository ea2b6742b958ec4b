// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/align_tie_points.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "calibration/files/error.h"
#include "tests/reconstruction/survey/synthetic_tie_points.h"

namespace insitu {
namespace {

double LargestCenterError(const SyntheticNetwork& network,
                          const std::map<std::string, Rigid3>& poses) {
  double largest = 0;
  for (size_t i = 0; i < network.photos.size(); ++i) {
    const Eigen::Vector3d truth = Center(network.cam_from_world[i]);
    largest = std::max(largest, (Center(poses.at(network.photos[i])) - truth).norm());
  }
  return largest;
}

TEST(AlignTiePoints, PutsTheModelWhereControlHasIt) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  TiePoints tie_points = ModelOf(network, 30);
  const auto alignment = AlignTiePoints(network.survey, CamerasOf(network), &tie_points);
  ASSERT_TRUE(alignment.fit);
  EXPECT_TRUE(alignment.warnings.empty());
  EXPECT_NEAR(alignment.world_from_model.scale, 12, 1e-6);
  EXPECT_LT(LargestCenterError(network, tie_points.cam_from_model), 1e-5);
}

TEST(AlignTiePoints, NamesAControlPointOfTheWrongName) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  for (ControlPoint& point : network.survey.control_points) {
    if (point.name == "g4") point.position += Eigen::Vector3d(3, 0, 0);
  }
  TiePoints tie_points = ModelOf(network, 30);
  const auto alignment = AlignTiePoints(network.survey, CamerasOf(network), &tie_points);
  ASSERT_EQ(alignment.warnings.size(), 1u);
  EXPECT_NE(alignment.warnings[0].find("control point 'g4' is 3 m from"), std::string::npos)
      << alignment.warnings[0];
  EXPECT_LT(LargestCenterError(network, tie_points.cam_from_model), 1e-5);
}

TEST(AlignTiePoints, RefusesAMirrorImage) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  for (ControlPoint& point : network.survey.control_points) {
    std::swap(point.position.x(), point.position.y());
  }
  TiePoints tie_points = ModelOf(network, 30);
  EXPECT_THROW(AlignTiePoints(network.survey, CamerasOf(network), &tie_points), InputError);
}

TEST(AlignTiePoints, UsesCameraPositionsWhereThereIsNoControl) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  Survey survey;
  for (size_t i = 0; i < network.photos.size(); ++i) {
    survey.camera_positions.push_back({network.photos[i],
                                       Center(network.cam_from_world[i]),
                                       Eigen::Vector3d::Constant(0.01),
                                       PositionRole::kWeighted,
                                       {}});
  }
  TiePoints tie_points = ModelOf(network, 30);
  EXPECT_TRUE(AlignTiePoints(survey, CamerasOf(network), &tie_points).fit);
  EXPECT_LT(LargestCenterError(network, tie_points.cam_from_model), 1e-5);

  survey.camera_positions.resize(2);
  tie_points = ModelOf(network, 30);
  const auto alignment = AlignTiePoints(survey, CamerasOf(network), &tie_points);
  EXPECT_FALSE(alignment.fit);
  EXPECT_NEAR(alignment.world_from_model.scale, 12, 1e-6);
  for (int i = 0; i < 2; ++i) {
    const auto& pose = tie_points.cam_from_model.at(network.photos[i]);
    EXPECT_LT((Center(pose) - survey.camera_positions[i].position).norm(), 1e-6);
  }
  EXPECT_NE(alignment.warnings.at(0).find("the rotation about the line"), std::string::npos);
}

}  // namespace
}  // namespace insitu
