// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/find_start_values.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "calibration/files/error.h"
#include "reconstruction/adjustment/adjust.h"
#include "tests/reconstruction/survey/synthetic_tie_points.h"

namespace insitu {
namespace {

StartValues Start(const SyntheticNetwork& network, const Survey& survey) {
  return FindStartValues(survey, network.photos, network.cameras);
}

TEST(FindStartValues, TakesPosesAndTiePointsFromTheAlignedModel) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  network.survey.tie_points = ModelOf(network, 30);
  const StartValues start = Start(network, network.survey);
  ASSERT_EQ(start.tie_points.size(), network.survey.tie_points->points.size());
  EXPECT_EQ(start.tie_points[0].name, "tie_000001");
  EXPECT_EQ(start.tie_point_sigma_px, 0.5);
  for (const StartTiePoint& point : start.tie_points) {
    for (const StartTiePoint::Mark& mark : point.marks) {
      const PosedCamera& posed = start.cameras[mark.photo];
      const auto pixel = posed.camera.Project(posed.cam_from_world * point.position);
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - mark.pixel).norm(), 1e-3);
    }
  }
}

// P4, which image matching left out, shows no control: it is resected from what the others tell.
TEST(FindStartValues, ResectsAPhotoThatMatchingLeftOut) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  network.survey.tie_points = ModelOf(network, 30);
  TiePoints& tie_points = *network.survey.tie_points;
  tie_points.cam_from_model.erase("P4");
  for (TiePoint& point : tie_points.points) {
    std::erase_if(point.marks, [](const TiePointMark& mark) { return mark.photo == "P4"; });
  }
  std::erase_if(network.survey.observations, [](const ImageObservation& mark) {
    return mark.photo == "P4" && (mark.point[0] == 'g' || mark.point[0] == 'a');
  });
  const StartValues start = Start(network, network.survey);
  EXPECT_LT((Center(start.cameras[3].cam_from_world) - Center(network.cam_from_world[3])).norm(),
            1e-4);

  std::erase_if(network.survey.observations,
                [](const ImageObservation& mark) { return mark.photo == "P4"; });
  EXPECT_THROW(Start(network, network.survey), InputError);
}

TEST(FindStartValues, IntersectsTiePointsWhereTheirModelCannotBeAligned) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  TiePoints model = ModelOf(network, 30);
  for (const char* photo : {"P2", "P3", "P4"}) model.cam_from_model.erase(photo);  // no two rays
  model.cam_from_model["P2"] = model.cam_from_model["P1"];
  for (TiePoint& point : model.points) {
    std::erase_if(point.marks, [](const TiePointMark& m) { return m.photo > "P2"; });
  }
  std::erase_if(model.points, [](const TiePoint& point) { return point.marks.size() < 2; });
  network.survey.tie_points = model;
  const StartValues start = Start(network, network.survey);
  ASSERT_GT(start.tie_points.size(), 10u);
  EXPECT_LT((Center(start.cameras[0].cam_from_world) - Center(network.cam_from_world[0])).norm(),
            1e-4);
}

TEST(FindStartValues, WithoutControlIsTheModelAsItIs) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  Survey survey;
  survey.tie_points = ModelOf(network, 30);
  const StartValues start = Start(network, survey);
  for (const PosedCamera& posed : start.cameras) {
    EXPECT_LT((posed.cam_from_world.translation -
               survey.tie_points->cam_from_model.at(posed.photo).translation)
                  .norm(),
              1e-9);
  }
  ASSERT_EQ(start.warnings.size(), 1u);
  EXPECT_NE(start.warnings[0].find("no control: position, orientation and scale are arbitrary"),
            std::string::npos);
}

// More observations of the same photographs: smaller sigmas, the truth still within them.
TEST(Adjust, GainsFromTiePoints) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  Survey survey = WithNoise(network.survey, 4);
  const Adjustment without = Adjust(survey, network.photos, network.cameras);
  survey.tie_points = ModelOf(network, 200);
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 0.5);
  for (TiePoint& point : survey.tie_points->points) {
    for (TiePointMark& mark : point.marks) {
      mark.pixel += Eigen::Vector2d(normal(generator), normal(generator));
    }
  }
  const Adjustment with = Adjust(survey, network.photos, network.cameras);
  for (size_t i = 0; i < 4; ++i) {
    const Eigen::Matrix3d covariance = with.poses[i].covariance.bottomRightCorner(3, 3);
    const Eigen::Matrix3d before = without.poses[i].covariance.bottomRightCorner(3, 3);
    EXPECT_LT(covariance.trace() / std::pow(with.sigma0, 2),
              before.trace() / std::pow(without.sigma0, 2));
    const Eigen::Vector3d error =
        Center(with.poses[i].cam_from_world) - Center(network.cam_from_world[i]);
    EXPECT_LT(error.dot(covariance.inverse() * error), 16.3);  // chi-square, 3, 0.1 %
  }
}

}  // namespace
}  // namespace insitu
