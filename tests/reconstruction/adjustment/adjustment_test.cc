// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "reconstruction/adjustment/adjust.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

Adjustment AdjustNetwork(const SyntheticNetwork& network, const Survey& survey,
                         const AdjustmentOptions& options = {},
                         const std::vector<PhotoLens>& lenses = {}) {
  return Adjust(survey, network.photos, network.cameras, options, lenses);
}

// In the truth planes, plumb lines and the sun's rays are exact: these sigmas say so.
AdjustmentOptions ExactGeometry() {
  AdjustmentOptions options;
  options.plane_sigma = options.zenith_sigma = options.sun_sigma = 1e-4;
  return options;
}

const AdjustedPoint& PointNamed(const Adjustment& adjustment, const std::string& name) {
  return *std::find_if(adjustment.points.begin(), adjustment.points.end(),
                       [&](const AdjustedPoint& point) { return point.name == name; });
}

Eigen::Matrix<double, 6, 1> PoseError(const Rigid3& adjusted, const Rigid3& truth) {
  const Eigen::AngleAxisd increment(adjusted.rotation * truth.rotation.conjugate());
  Eigen::Matrix<double, 6, 1> error;
  error << increment.angle() * increment.axis(), Center(adjusted) - Center(truth);
  return error;
}

class NoiseFree : public testing::TestWithParam<Vector3d> {};

TEST_P(NoiseFree, ReturnsPosesVerticesAndDirections) {
  SyntheticNetworkOptions options;
  options.origin = GetParam();
  const SyntheticNetwork network = MakeSyntheticNetwork(options);
  const Adjustment adjustment = AdjustNetwork(network, network.survey);
  ASSERT_EQ(adjustment.poses.size(), network.photos.size());
  for (size_t i = 0; i < network.photos.size(); ++i) {
    const auto error = PoseError(adjustment.poses[i].cam_from_world, network.cam_from_world[i]);
    EXPECT_LT(error.tail<3>().norm(), 1e-8) << network.photos[i];
    EXPECT_LT(error.head<3>().norm(), 1e-8) << network.photos[i];
    EXPECT_LT(adjustment.poses[i].rms_px, 1e-6);
  }
  ASSERT_EQ(adjustment.points.size(), network.points.size());
  for (const AdjustedPoint& point : adjustment.points) {
    EXPECT_LT((point.position - network.points.at(point.name)).norm(), 1e-8) << point.name;
  }
  for (size_t i = 0; i < network.survey.polygons.size(); ++i) {
    const Polygon& polygon = adjustment.scene.polygons[i];
    for (size_t k = 0; k < polygon.vertices.size(); ++k) {
      const Vector3d truth = network.points.at(network.survey.polygons[i].vertices[k]);
      EXPECT_LT((polygon.vertices[k] - truth).norm(), 1e-8) << polygon.name;
    }
  }
  EXPECT_LT((adjustment.scene.sun->unit - network.sun).norm(), 1e-9);
  EXPECT_LT((adjustment.scene.zenith.unit - network.zenith).norm(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(OriginsNearAndNational, NoiseFree,
                         testing::Values(Vector3d(0, 0, 0), Vector3d(1000, 2000, 400),
                                         Vector3d(2600000, 1200000, 450)));

TEST(Adjust, OrientsPolygonsByTheirVertexOrder) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const Adjustment adjustment = AdjustNetwork(network, network.survey);
  for (const Polygon& polygon : adjustment.scene.polygons) {
    EXPECT_NEAR(polygon.normal.norm(), 1, 1e-12);
    if (polygon.name == "ground" || polygon.name == "c_roof") {
      EXPECT_LT((polygon.normal - network.zenith).norm(), 1e-8) << polygon.name;
    }
    if (polygon.name == "a_wall0") {
      EXPECT_LT(polygon.normal.y(), -0.9);
    }
    if (polygon.name == "a_wall1") {
      EXPECT_GT(polygon.normal.x(), 0.9);
    }
  }
}

// The vertices of a hole are observed on the polygon's plane as its own are.
TEST(Adjust, HoldsHolesInThePlane) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  const Adjustment before = Adjust(network.survey, network.photos, network.cameras);
  network.survey.polygons[0].holes = {{"c0", "c3", "c2", "c1"}};
  const Adjustment after = Adjust(network.survey, network.photos, network.cameras);
  EXPECT_EQ(after.observations, before.observations + 4);
  EXPECT_EQ(after.unknowns, before.unknowns);
  const Polygon& ground = after.scene.polygons[0];
  ASSERT_EQ(ground.holes.size(), 1u);
  EXPECT_LT((ground.holes[0][1] - network.points.at("c3")).norm(), 1e-6);
  EXPECT_EQ(ground.covariance.rows(), 27);
  EXPECT_NEAR(AreaOf(ground), AreaOf(before.scene.polygons[0]) - 28, 1e-6);
}

TEST(Adjust, CountsItsObservationsAndUnknowns) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const Adjustment adjustment = AdjustNetwork(network, WithNoise(network.survey, 1));
  const int planes = 1 + 3 * 5;  // the triangle has none
  const int vertices = 5 + 15 * 4;
  const int control = 9 + 8 + 1;
  const int marks = static_cast<int>(network.survey.observations.size());
  EXPECT_EQ(adjustment.observations, 2 * marks + 3 * control + vertices + 2 * (2 + 6));
  EXPECT_EQ(adjustment.unknowns,
            6 * 4 + 3 * static_cast<int>(network.points.size()) + 3 * planes + 2 + 2);
  EXPECT_EQ(adjustment.redundancy, adjustment.observations - adjustment.unknowns);
  double sum = 0;
  for (const ObservationResidual& row : adjustment.residuals) sum += row.redundancy;
  EXPECT_NEAR(sum, adjustment.redundancy, 1e-6);
}

TEST(Adjust, DeterminesAVertexOfOneRayByItsPolygon) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const Adjustment adjustment = AdjustNetwork(network, WithNoise(network.survey, 2));
  const AdjustedPoint& single = PointNamed(adjustment, "single");
  EXPECT_EQ(single.rays, 1);
  const double sigma = std::sqrt(single.covariance.trace());
  EXPECT_LT(sigma, 0.2);
  EXPECT_LT((single.position - network.points.at("single")).norm(), 4 * sigma);
}

TEST(Adjust, IsNotTouchedByCheckPoints) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const Survey survey = WithNoise(network.survey, 3);
  Survey moved = survey;
  for (ControlPoint& point : moved.control_points) {
    if (point.role == ControlRole::kCheck) point.position += Vector3d(5, -7, 3);
  }
  const Adjustment first = AdjustNetwork(network, survey);
  const Adjustment second = AdjustNetwork(network, moved);
  for (size_t i = 0; i < first.poses.size(); ++i) {
    EXPECT_EQ(first.poses[i].cam_from_world.rotation.coeffs(),
              second.poses[i].cam_from_world.rotation.coeffs());
    EXPECT_EQ(first.poses[i].cam_from_world.translation,
              second.poses[i].cam_from_world.translation);
  }
  EXPECT_EQ(first.sigma0, second.sigma0);
  EXPECT_LT(first.check_rms_over_sigma, 3);
  EXPECT_GT(second.check_rms_over_sigma, 100);
}

TEST(Adjust, ComparesCheckPointsWithTheCombinedSigma) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  Survey survey = network.survey;
  for (ControlPoint& point : survey.control_points) {
    if (point.name == "b4") point.position.x() += 0.03;
  }
  const Adjustment adjustment = AdjustNetwork(network, survey);
  ASSERT_EQ(adjustment.check.size(), 2u);
  EXPECT_EQ(adjustment.check[0].name, "b4");
  EXPECT_LT((adjustment.check[0].difference - Vector3d(-0.03, 0, 0)).norm(), 1e-7);
  // Without residuals sigma0 is 0 and the survey's 5 mm remain.
  EXPECT_LT((adjustment.check[0].sigma - Vector3d::Constant(0.005)).norm(), 1e-7);
  EXPECT_NEAR(adjustment.check_rms_over_sigma, 0.03 / 0.005 / std::sqrt(6), 1e-4);
}

// Over 30 noisy networks the errors, normalised by the reported covariances, must have the mean of
// chi-square: the degrees of freedom. Bounds: four standard deviations of a mean of 30.
TEST(Adjust, ErrorsFollowTheReportedCovariances) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const int seeds = 30;
  double pose_sum = 0, vertex_sum = 0, sun_sum = 0, zenith_sum = 0, sigma0_sum = 0, check_sum = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const Adjustment adjustment = AdjustNetwork(
        network, WithNoise(network.survey, 100 + static_cast<unsigned>(seed)), ExactGeometry());
    const auto pose = PoseError(adjustment.poses[2].cam_from_world, network.cam_from_world[2]);
    pose_sum += pose.dot(adjustment.poses[2].covariance.inverse() * pose);
    const AdjustedPoint& corner = PointNamed(adjustment, "c7");
    const Vector3d error = corner.position - network.points.at("c7");
    vertex_sum += error.dot(corner.covariance.inverse() * error);
    const auto across = [](const Direction& direction, const Vector3d& truth) {
      const Vector3d axis = truth.unitOrthogonal();
      const double e = axis.dot(direction.unit - truth);
      return e * e / axis.dot(direction.covariance * axis);
    };
    sun_sum += across(*adjustment.scene.sun, network.sun);
    zenith_sum += across(adjustment.scene.zenith, network.zenith);
    sigma0_sum += adjustment.sigma0 * adjustment.sigma0;
    check_sum += adjustment.check_rms_over_sigma * adjustment.check_rms_over_sigma;
  }
  const auto bound = [&](int freedom) { return 4 * std::sqrt(2.0 * freedom / seeds); };
  EXPECT_NEAR(pose_sum / seeds, 6, bound(6));
  EXPECT_NEAR(vertex_sum / seeds, 3, bound(3));
  EXPECT_NEAR(sun_sum / seeds, 1, bound(1));
  EXPECT_NEAR(zenith_sum / seeds, 1, bound(1));
  EXPECT_NEAR(sigma0_sum / seeds, 1, 4 * std::sqrt(2.0 / (100 * seeds)));
  EXPECT_NEAR(check_sum / seeds, 1, bound(1));
}

TEST(Adjust, GivesTheSameBytesTwice) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const Survey survey = WithNoise(network.survey, 4);
  const Adjustment first = AdjustNetwork(network, survey), second = AdjustNetwork(network, survey);
  for (size_t i = 0; i < first.points.size(); ++i) {
    EXPECT_EQ(first.points[i].position, second.points[i].position);
    EXPECT_EQ(first.points[i].covariance, second.points[i].covariance);
  }
}

TEST(Adjust, TakesTheZAxisForAnUnmeasuredZenithAndSaysSo) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  network.survey.zenith_pairs.clear();
  network.survey.sun_pairs.clear();
  const Adjustment adjustment = AdjustNetwork(network, network.survey);
  EXPECT_EQ(adjustment.scene.zenith.unit, Vector3d::UnitZ());
  EXPECT_FALSE(adjustment.scene.sun);
  ASSERT_EQ(adjustment.warnings.size(), 1u);
  EXPECT_NE(adjustment.warnings[0].find("zenith"), std::string::npos);
}

TEST(BriefReport, WarnsOfADatumThatIsFree) {
  Adjustment adjustment;
  adjustment.datum = "fixed by the survey";
  EXPECT_EQ(adjustment.BriefReport().find("warning"), std::string::npos);
  adjustment.datum = "free in 7 of 7";
  adjustment.datum_defect = 7;
  adjustment.warnings = {"careful"};
  EXPECT_NE(adjustment.BriefReport().find("warning: careful\nwarning: the datum is free in 7 of 7"),
            std::string::npos);
}

// Only three control points on a photo, and more points that the other photos determine: the pose
// is unique without any estimate.
TEST(Adjust, SettlesAThreePointResectionByTheOtherPhotos) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  const std::vector<std::string> kept = {"a0", "a5", "g4"};
  std::erase_if(network.survey.observations, [&](const ImageObservation& mark) {
    const bool is_control =
        mark.point[0] == 'g' || (mark.point[0] == 'a' && mark.point.size() == 2);
    return mark.photo == "P2" && is_control &&
           std::find(kept.begin(), kept.end(), mark.point) == kept.end();
  });
  const Adjustment adjustment = AdjustNetwork(network, network.survey);
  EXPECT_TRUE(adjustment.warnings.empty());
  EXPECT_LT(PoseError(adjustment.poses[1].cam_from_world, network.cam_from_world[1]).norm(), 1e-7);
}

TEST(Adjust, SelfCalibrationObservesTheCalibration) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  AdjustmentOptions options = ExactGeometry();
  options.is_self_calibrating = true;
  Eigen::VectorXd sigma(12);
  sigma << 1, 1, 1, 1, 1e-3, 1e-3, 1e-4, 1e-4, 1e-3, 1e-3, 1e-3, 1e-3;
  const std::vector<PhotoLens> lenses(network.photos.size(),
                                      {"wide", sigma.cwiseAbs2().asDiagonal()});
  const Adjustment adjustment =
      AdjustNetwork(network, WithNoise(network.survey, 4), options, lenses);
  const auto is_lens = [](const ObservationResidual& row) {
    return row.kind == ObservationKind::kLens;
  };
  EXPECT_EQ(std::count_if(adjustment.residuals.begin(), adjustment.residuals.end(), is_lens), 12);
  const auto first =
      std::find_if(adjustment.residuals.begin(), adjustment.residuals.end(), is_lens);
  EXPECT_EQ(first->subject, "wide fx");
  for (size_t i = 0; i < 12; ++i) {  // never worse than the calibration, up to sigma0
    const auto& parameter = adjustment.cameras[0].parameters[i];
    EXPECT_LT(parameter.sigma, 1.0001 * adjustment.sigma0 * sigma[static_cast<Eigen::Index>(i)])
        << parameter.name;
  }
}

TEST(Adjust, FlagsAGrossErrorAtItsObservation) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  Survey survey = WithNoise(network.survey, 5);
  ImageObservation& wrong = survey.observations[40];
  wrong.pixel.x() += 8;  // 20 sigma
  const Adjustment adjustment = AdjustNetwork(network, survey);
  double largest = 0;
  const ObservationResidual* worst = nullptr;
  for (const ObservationResidual& row : adjustment.residuals) {
    if (row.redundancy < 1e-6) continue;
    const double w = std::abs(row.residual / (row.sigma * std::sqrt(row.redundancy)));
    if (w > largest) worst = &row;
    largest = std::max(largest, w);
  }
  ASSERT_NE(worst, nullptr);
  EXPECT_EQ(worst->subject, wrong.point);
  EXPECT_EQ(worst->photo, wrong.photo);
  EXPECT_GT(largest, 10);
  EXPECT_LT(adjustment.chi_square_p, 1e-6);
}

// Camera positions, edges and constraints of each kind; the right angle is at a corner, which both
// of its edges share.
TEST(Adjust, TakesEdgesAndConstraints) {
  const SyntheticNetwork network = MakeSyntheticNetwork({.has_extras = true});
  const Adjustment adjustment = AdjustNetwork(network, network.survey);
  EXPECT_LT(adjustment.sigma0, 1e-4);
  for (const AdjustedPoint& point : adjustment.points) {
    EXPECT_LT((point.position - network.points.at(point.name)).norm(), 1e-5) << point.name;
  }
}

}  // namespace
}  // namespace insitu
