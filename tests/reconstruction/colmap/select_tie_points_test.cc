// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/select_tie_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "calibration/files/error.h"
#include "tests/reconstruction/survey/synthetic_tie_points.h"

namespace insitu {
namespace {

TEST(SelectTiePoints, NamesTheOptionThatIsWrong) {
  const auto fault = [](const TiePointSelection& selection) {
    TiePoints none;
    try {
      SelectTiePoints({}, selection, &none);
    } catch (const CheckError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(fault({.points_per_photo = -1}).find("points_per_photo"), std::string::npos);
  EXPECT_NE(fault({.columns = 0}).find("columns"), std::string::npos);
  EXPECT_NE(fault({.rows = 0}).find("rows"), std::string::npos);
  EXPECT_NE(fault({.min_angle = -1}).find("min_angle"), std::string::npos);
  EXPECT_NE(fault({.limit_sigma = 0}).find("limit_sigma"), std::string::npos);
}

TEST(SelectTiePoints, DropsWhatIsOffAndWhatIsWeakAndCountsIt) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  TiePoints tie_points = ModelOf(network, 400);
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 0.5);
  for (TiePoint& point : tie_points.points) {
    for (TiePointMark& mark : point.marks) {
      mark.pixel += Eigen::Vector2d(normal(generator), normal(generator));
    }
  }
  tie_points.points[0].marks[0].pixel.x() += 40;
  tie_points.points[1].position = ModelFromWorld() * Eigen::Vector3d(1000, 9000, 400);
  for (TiePointMark& mark : tie_points.points[1].marks) {  // far away: rays are all but parallel
    const size_t photo = static_cast<size_t>(mark.photo[1] - '1');
    mark.pixel = *network.cameras[photo].Project(network.cam_from_world[photo] *
                                                 Eigen::Vector3d(1000, 9000, 400));
  }
  const size_t found = tie_points.points.size();
  const TiePointCounts counts = SelectTiePoints(CamerasOf(network), {}, &tie_points);
  EXPECT_EQ(counts.found, static_cast<int>(found));
  EXPECT_GE(counts.marks_off, 1);
  EXPECT_LE(counts.marks_off, 10);  // four sigma of 1500 marks
  EXPECT_EQ(counts.weak_angle, 1);
  EXPECT_EQ(counts.kept + counts.crowded + counts.weak_angle + counts.too_few_rays, counts.found);
}

// Residuals of noise alone about the true points: their redundancy is higher than SelectTiePoints
// reckons with (it takes points and poses for adjusted), by 2n / (2n - 3p - 6m + 7).
TEST(SelectTiePoints, MeasuresSigma) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  TiePoints tie_points = ModelOf(network, 2000);
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 0.5);
  size_t marks = 0;
  for (TiePoint& point : tie_points.points) {
    for (TiePointMark& mark : point.marks) {
      mark.pixel += Eigen::Vector2d(normal(generator), normal(generator));
    }
    marks += point.marks.size();
  }
  const double n = static_cast<double>(marks), p = static_cast<double>(tie_points.points.size());
  SelectTiePoints(CamerasOf(network), {.points_per_photo = 0, .limit_sigma = 6}, &tie_points);
  const double expected = 0.5 * std::sqrt(2 * n / (2 * n - 3 * p - 6 * 4 + 7));
  EXPECT_NEAR(tie_points.sigma_px, expected, 0.05 * expected);
}

TEST(SelectTiePoints, KeepsThePointsOfMostRaysWellSpread) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  TiePoints tie_points = ModelOf(network, 3000);
  const TiePoints all = tie_points;
  const TiePointSelection selection{.points_per_photo = 100, .columns = 10, .rows = 10};
  SelectTiePoints(CamerasOf(network), selection, &tie_points);
  std::map<std::string, int> count;
  for (const TiePoint& point : tie_points.points) {
    for (const TiePointMark& mark : point.marks) count[mark.photo] += 1;
  }
  for (const auto& [photo, points] : count) {
    EXPECT_LE(points, 100) << photo;
    EXPECT_GE(points, 20) << photo;
  }
  const auto rays = [](const TiePoints& points) {
    double sum = 0;
    for (const TiePoint& point : points.points) sum += static_cast<double>(point.marks.size());
    return sum / static_cast<double>(points.points.size());
  };
  EXPECT_GE(rays(tie_points), rays(all) - 0.2);
}

}  // namespace
}  // namespace insitu
