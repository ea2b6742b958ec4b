// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/live/one_ray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reconstruction/adjustment/adjusted_unknowns.h"
#include "reconstruction/adjustment/find_start_values.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

constexpr double kPlaneSigma = 0.005;  // [m], as AdjustmentOptions has it

SolvedSurvey SolvedOf(const SyntheticNetwork& network, const Survey& survey,
                      const std::vector<PhotoLens>& lenses = {}) {
  return SolveSurvey(survey, FindStartValues(survey, network.photos, network.cameras), lenses, {});
}

// As if nobody had said yet that "single" is a vertex of the ground.
Survey WithoutSingle(Survey survey) {
  for (PolygonOutline& polygon : survey.polygons) std::erase(polygon.vertices, "single");
  std::erase_if(survey.observations, [](const auto& mark) { return mark.point == "single"; });
  return survey;
}

SingleMark MarkOf(const Survey& survey, const std::string& point) {
  const auto mark = std::find_if(survey.observations.begin(), survey.observations.end(),
                                 [&](const auto& each) { return each.point == point; });
  return {mark->photo, mark->pixel, mark->sigma_px};
}

AdjustedPoint Named(const std::vector<AdjustedPoint>& points, const std::string& name) {
  return *std::find_if(points.begin(), points.end(),
                       [&](const auto& point) { return point.name == name; });
}

// A vertex that one ray and its plane determine adds nothing to the rest: the adjustment with it
// gives what the prediction without it gives.
void ExpectWhatTheAdjustmentGives(const SyntheticNetwork& network,
                                  const std::vector<PhotoLens>& lenses) {
  const Survey with = WithNoise(network.survey, 5), without = WithoutSingle(with);
  const SolvedSurvey whole = SolvedOf(network, with, lenses);
  const SolvedSurvey solved = SolvedOf(network, without, lenses);
  const AdjustedPoint expected =
      Named(AdjustedPoints(whole.survey_network.network, whole.solution), "single");
  const auto point =
      WhereRayMeets(solved, MarkOf(with, "single"), without.polygons[0], kPlaneSigma);
  ASSERT_TRUE(point);
  EXPECT_LT((point->position - expected.position).norm(), 1e-5);
  EXPECT_LT((point->covariance - expected.covariance).norm(), 2e-3 * expected.covariance.norm())
      << point->covariance << "\n\n"
      << expected.covariance;
}

TEST(WhereRayMeets, IsWhatTheAdjustmentOfAVertexGives) {
  ExpectWhatTheAdjustmentGives(MakeSyntheticNetwork(), {});
}

TEST(WhereRayMeets, KnowsHowSureTheLensIs) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  Eigen::VectorXd sigmas = Eigen::VectorXd::Zero(12);
  sigmas.head<6>() << 2, 2, 3, 3, 1e-3, 1e-3;
  const PhotoLens lens{"camera", sigmas.cwiseAbs2().asDiagonal()};
  ExpectWhatTheAdjustmentGives(network, std::vector<PhotoLens>(network.photos.size(), lens));
}

TEST(WhereRayMeets, IsImagedOnTheMarkItself) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const Survey with = WithNoise(network.survey, 5), without = WithoutSingle(with);
  const SolvedSurvey solved = SolvedOf(network, without);
  const SingleMark mark = MarkOf(with, "single");
  const auto point = WhereRayMeets(solved, mark, without.polygons[0], kPlaneSigma);
  ASSERT_TRUE(point);
  const ImageUncertainty& image = point->images.at(mark.photo);
  EXPECT_LT((image.pixel - mark.pixel).norm(), 1e-6);
  EXPECT_NEAR(image.major_px, 0.4 * solved.solution.sigma0, 1e-4);
  EXPECT_NEAR(image.minor_px, 0.4 * solved.solution.sigma0, 1e-4);
}

// A triangle has no plane of its own among the unknowns: its corners hold it.
TEST(WhereRayMeets, TakesATriangleByItsCorners) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const Survey survey = WithNoise(network.survey, 5);
  const SolvedSurvey solved = SolvedOf(network, survey);
  const auto& points = solved.survey_network.index_of_point;
  const PolygonOutline sail{"sail", {"b4", "b5", "c4"}, {}, "stone", {}, {}};
  // Through a corner itself, the ray without errors of its own meets that corner.
  const int corner = points.at("b5"), photo = solved.survey_network.index_of_photo.at("P2");
  const NetworkPhoto& taken = solved.survey_network.network.photos[photo];
  const Eigen::Vector3d position = solved.survey_network.network.points[corner].position;
  const auto pixel = network.cameras[1].Project(taken.cam_from_local * (position - taken.center));
  ASSERT_TRUE(pixel);
  const auto point = WhereRayMeets(solved, {"P2", *pixel, 1e-6}, sail, 0);
  ASSERT_TRUE(point);
  const AdjustedPoint expected =
      Named(AdjustedPoints(solved.survey_network.network, solved.solution), "b5");
  EXPECT_LT((point->position - expected.position).norm(), 1e-8);
  const Eigen::Vector3d normal = (network.points.at("b5") - network.points.at("b4"))
                                     .cross(network.points.at("c4") - network.points.at("b4"))
                                     .normalized();
  EXPECT_NEAR(normal.dot(point->covariance * normal), normal.dot(expected.covariance * normal),
              2e-2 * normal.dot(expected.covariance * normal));
}

}  // namespace
}  // namespace insitu
