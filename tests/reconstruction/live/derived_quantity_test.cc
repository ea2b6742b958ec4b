// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/live/derived_quantity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reconstruction/adjustment/find_start_values.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

SolvedSurvey SolvedOf(const SyntheticNetwork& network, const Survey& survey) {
  return SolveSurvey(survey, FindStartValues(survey, network.photos, network.cameras), {}, {});
}

TEST(DerivedQuantity, IsTrueOfASurveyWithoutError) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const SolvedSurvey solved = SolvedOf(network, network.survey);
  EXPECT_NEAR(AdjustedDistance(solved, "b4", "b5")->value, 6, 1e-6);
  EXPECT_NEAR(AdjustedHeight(solved, "c0", "c4")->value, 12, 1e-6);
  EXPECT_NEAR(AdjustedHeight(solved, "c4", "c0")->value, -12, 1e-6);
  EXPECT_NEAR(AdjustedAngle(solved, "b4", "b5", "b6")->value, M_PI / 2, 1e-6);
  EXPECT_FALSE(AdjustedDistance(solved, "b4", "nobody"));
  EXPECT_FALSE(AdjustedDistance(solved, "b4", "b4"));
  EXPECT_FALSE(AdjustedAngle(solved, "b4", "b4", "b5"));
}

// A distance observed with sigma S has the adjusted sigma S sqrt(1 - r); at S far above it, that of
// the network without this observation.
TEST(DerivedQuantity, HasTheSigmaThatAnObservationOfItWouldHave) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const SolvedSurvey solved = SolvedOf(network, network.survey);
  for (const bool is_height : {false, true}) {
    const DerivedQuantity derived =
        is_height ? *AdjustedHeight(solved, "b1", "c6") : *AdjustedDistance(solved, "b1", "c6");
    Survey with = network.survey;
    const auto kind =
        is_height ? GeometricConstraint::Kind::kHeight : GeometricConstraint::Kind::kDistance;
    const double large = 100 * derived.sigma / solved.solution.sigma0;
    with.constraints = {{kind, {}, {"b1", "c6"}, derived.value, large, {}}};
    const SolvedSurvey again = SolvedOf(network, with);
    const double redundancy = again.solution.redundancy_numbers[again.solution.rows.size() - 1];
    const double sigma = large * std::sqrt(1 - redundancy) * solved.solution.sigma0;
    EXPECT_NEAR(sigma / derived.sigma, 1, 2e-4) << is_height;
  }
}

// The scatter of 300 surveys with errors of their sigmas: chi-square of 300 within 0.1 %.
TEST(DerivedQuantity, HasTheSigmaOfItsScatter) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  network.survey.polygons.clear();  // these and the pairs are observed, but have no errors here
  network.survey.sun_pairs.clear();
  network.survey.zenith_pairs.clear();
  std::erase_if(network.survey.observations,
                [](const ImageObservation& mark) { return mark.point == "single"; });
  constexpr int kTrials = 300;
  double squares[3] = {0, 0, 0};
  const SolvedSurvey exact = SolvedOf(network, network.survey);
  const double truth[] = {AdjustedDistance(exact, "b1", "c6")->value,
                          AdjustedHeight(exact, "b1", "c6")->value,
                          AdjustedAngle(exact, "b4", "b5", "c6")->value};
  for (int trial = 0; trial < kTrials; ++trial) {
    const Survey survey = WithNoise(network.survey, 100 + trial);
    const SolvedSurvey solved = SolvedOf(network, survey);
    const double sigma0 = solved.solution.sigma0;
    const DerivedQuantity values[] = {*AdjustedDistance(solved, "b1", "c6"),
                                      *AdjustedHeight(solved, "b1", "c6"),
                                      *AdjustedAngle(solved, "b4", "b5", "c6")};
    for (int i = 0; i < 3; ++i) {
      squares[i] += std::pow((values[i].value - truth[i]) / (values[i].sigma / sigma0), 2);
    }
  }
  for (const double sum : squares) {
    EXPECT_GT(sum, 228);
    EXPECT_LT(sum, 383);
  }
}

}  // namespace
}  // namespace insitu
