// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_solution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/writer.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "reconstruction/adjustment/adjust.h"
#include "reconstruction/geometry/projection_uncertainty.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

using testing::HasSubstr;

LiveInput InputOf(const SyntheticNetwork& network, const Survey& survey) {
  LiveInput input;
  input.survey = survey;
  for (size_t i = 0; i < network.photos.size(); ++i) {
    input.photos.push_back({network.photos[i], network.cameras[i]});
  }
  return input;
}

TEST(LiveSolution, SaysWhatAdjustSays) {
  const SyntheticNetwork network = MakeSyntheticNetwork({.has_extras = true});
  const Survey survey = WithNoise(network.survey, 5);
  const Adjustment whole = Adjust(survey, network.photos, network.cameras);
  const Json::Value message = LiveSolution(InputOf(network, survey));
  EXPECT_TRUE(message["failed"].isNull());
  EXPECT_EQ(message["sigma0"].asDouble(), whole.sigma0);
  EXPECT_EQ(message["redundancy"].asInt(), whole.redundancy);
  EXPECT_EQ(message["p"].asDouble(), whole.chi_square_p);
  EXPECT_EQ(message["left_out"].size(), 0u);
  EXPECT_EQ(message["photos"].size(), 4u);
  EXPECT_EQ(message["photos"]["P2"]["rms_px"].asDouble(), whole.poses[1].rms_px);
  EXPECT_EQ(message["marks"].size(), survey.observations.size());
  for (Json::ArrayIndex i = 0; i < message["marks"].size(); ++i) {  // the rows' first are the marks
    const ObservationResidual &x = whole.residuals[size_t{2} * i],
                              &y = whole.residuals[size_t{2} * i + 1];
    const Json::Value& mark = message["marks"][i];
    ASSERT_EQ(mark["point"].asString(), x.subject);
    EXPECT_EQ(mark["r"].asDouble(), std::min(x.redundancy, y.redundancy));
    if (!x.w || !y.w) continue;
    EXPECT_EQ(std::abs(mark["w"].asDouble()), std::max(std::abs(*x.w), std::abs(*y.w)));
    EXPECT_EQ(mark["detectable"].asDouble(), std::max(*x.detectable, *y.detectable));
  }
  for (const AdjustedPoint& point : whole.points) {
    EXPECT_EQ(message["points"][point.name]["xyz"][0].asDouble(), point.position.x());
    EXPECT_EQ(message["points"][point.name]["rays"].asInt(), point.rays);
  }
  EXPECT_EQ(message["control"].size(), whole.control.size() + whole.check.size());
  EXPECT_EQ(message["polygons"].size(), survey.polygons.size());
  EXPECT_EQ(message["sun"]["pairs"].asInt(), 2);
  EXPECT_EQ(message["zenith"]["pairs"].asInt(), 6);
  EXPECT_NEAR(message["zenith"]["tilt_deg"].asDouble(), 0.006 * 180 / M_PI, 0.05);
}

// The marks of an image: residual = adjusted - observed, and the prediction is what is adjusted.
TEST(LiveSolution, PredictsWhereTheResidualsLead) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const Survey survey = WithNoise(network.survey, 5);
  const Json::Value message = LiveSolution(InputOf(network, survey));
  ASSERT_EQ(message["marks"].size(), survey.observations.size());
  for (Json::ArrayIndex i = 0; i < message["marks"].size(); ++i) {
    const Json::Value& mark = message["marks"][i];
    const ImageObservation& observed = survey.observations[i];
    ASSERT_EQ(mark["point"].asString(), observed.point);
    const Json::Value& image = message["points"][observed.point]["images"][observed.photo];
    if (image.isNull()) continue;  // adjusted off the frame
    EXPECT_NEAR(image["x"].asDouble(), observed.pixel.x() + mark["vx"].asDouble(), 1e-6);
    EXPECT_NEAR(image["y"].asDouble(), observed.pixel.y() + mark["vy"].asDouble(), 1e-6);
    // The adjusted image cannot be known worse than its own mark: sigma 0.4.
    EXPECT_LT(image["major"].asDouble(), 2.4477 * 0.4 * message["sigma0"].asDouble() * 1.0001);
  }
}

// A point that one photo does not show: its ellipse holds the true place, over many surveys.
TEST(LiveSolution, PredictsMarksNotMadeYet) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  double squares = 0;
  int count = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Survey survey = WithNoise(network.survey, seed);
    std::erase_if(survey.observations, [](const ImageObservation& mark) {
      return mark.photo == "P3" && (mark.point == "c5" || mark.point == "b6");
    });
    const Json::Value message = LiveSolution(InputOf(network, survey));
    for (const char* point : {"c5", "b6"}) {
      const Json::Value& image = message["points"][point]["images"]["P3"];
      ASSERT_FALSE(image.isNull());
      const Eigen::Vector2d truth =
          *network.cameras[2].Project(network.cam_from_world[2] * network.points.at(point));
      const Eigen::Vector2d off =
          Eigen::Vector2d(image["x"].asDouble(), image["y"].asDouble()) - truth;
      const double angle = image["angle"].asDouble(), scale = 2.4477 * message["sigma0"].asDouble();
      const double along = off.x() * std::cos(angle) + off.y() * std::sin(angle);
      const double across = -off.x() * std::sin(angle) + off.y() * std::cos(angle);
      squares += std::pow(along / image["major"].asDouble() * 2.4477, 2) +
                 std::pow(across / image["minor"].asDouble() * 2.4477, 2);
      EXPECT_GT(scale, 0);
      count += 2;
    }
  }
  EXPECT_GT(squares / count, 0.7);
  EXPECT_LT(squares / count, 1.35);
}

TEST(LiveSolution, DrawsPolygonsThroughTheLens) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const Json::Value message = LiveSolution(InputOf(network, network.survey));
  const Json::Value& roof = message["polygons"]["b_roof"];
  EXPECT_NEAR(roof["area_m2"].asDouble(), 30, 1e-6);
  EXPECT_TRUE(roof["off_vertical_deg"].isNull());
  EXPECT_NEAR(message["polygons"]["b_wall0"]["off_vertical_deg"].asDouble(), 0, 1e-4);
  ASSERT_EQ(roof["images"].size(), 4u);
  const Json::Value& line = roof["images"]["P1"][0];
  const Eigen::Vector2d corner =
      *network.cameras[0].Project(network.cam_from_world[0] * network.points.at("b4"));
  EXPECT_NEAR(line[0][0].asDouble(), corner.x(), 0.006);
  EXPECT_NEAR(line[0][1].asDouble(), corner.y(), 0.006);
}

TEST(LiveSolution, OfNothingIsNoFailure) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const LiveResult result = SolveLive(InputOf(network, {}));
  EXPECT_FALSE(result.solved);
  EXPECT_TRUE(result.message["failed"].isNull());
  EXPECT_FALSE(result.message["photos"]["P1"]["oriented"].asBool());
  EXPECT_EQ(result.message["photos"]["P1"]["why"].asString(), "needs three control points");
  EXPECT_EQ(result.message["left_out"].size(), 4u);
  EXPECT_TRUE(LiveSolution({}).isMember("points"));
}

TEST(LiveSolution, PredictsControlThatNobodyMarked) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  Survey survey = network.survey;
  std::erase_if(survey.observations,
                [](const ImageObservation& mark) { return mark.point == "g1"; });
  const Json::Value message = LiveSolution(InputOf(network, survey));
  const Json::Value& point = message["points"]["g1"];
  EXPECT_EQ(point["rays"].asInt(), 0);
  const Eigen::Vector2d truth =
      *network.cameras[1].Project(network.cam_from_world[1] * network.points.at("g1"));
  EXPECT_NEAR(point["images"]["P2"]["x"].asDouble(), truth.x(), 0.1);
}

TEST(LiveSolution, SaysOnceThatALensIsMissing) {
  const SyntheticNetwork network = MakeSyntheticNetwork({.has_extras = true});
  LiveInput input = InputOf(network, network.survey);
  input.photos[2].camera.reset();
  input.photos[2].no_lens_because = Sentence("noLens", "run insitu-calibrate");
  const Json::Value message = LiveSolution(input);
  EXPECT_FALSE(message["photos"]["P3"]["oriented"].asBool());
  EXPECT_EQ(message["photos"]["P3"]["why"].asString(), "run insitu-calibrate");
  EXPECT_TRUE(message["photos"]["P4"]["oriented"].asBool());
  ASSERT_EQ(message["left_out"].size(), 1u);
}

TEST(LiveSolution, DiagnosesExchangedMarks) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  Survey survey = network.survey;
  std::vector<ImageObservation*> marks;
  for (ImageObservation& mark : survey.observations) {
    if (mark.photo == "P2" && (mark.point == "g0" || mark.point == "g8")) marks.push_back(&mark);
  }
  std::swap(marks.at(0)->pixel, marks.at(1)->pixel);
  const Json::Value message = LiveSolution(InputOf(network, survey));
  ASSERT_GT(message["diagnoses"].size(), 0u);
  EXPECT_EQ(message["diagnoses"][0]["kind"].asString(), "fault");
  EXPECT_EQ(message["diagnoses"][0]["photo"].asString(), "P2");
  EXPECT_THAT(message["diagnoses"][0]["point"].asString(), testing::AnyOf("g0", "g8"));
}

// What was found serves as start values the next time, and changes nothing.
TEST(LiveSolution, IsTheSameFromTheLastPoses) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  LiveInput input = InputOf(network, WithNoise(network.survey, 7));
  const LiveResult first = SolveLive(input);
  ASSERT_TRUE(first.solved);
  input.last_poses = first.poses;
  const LiveResult second = SolveLive(input);
  EXPECT_NEAR(first.message["sigma0"].asDouble(), second.message["sigma0"].asDouble(), 1e-9);
}

TEST(LiveSolution, HoldsTheSunAgainstTheAlmanac) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  LiveInput input = InputOf(network, network.survey);
  LiveSite site{
      {47.4, 8.5, 500}, Eigen::Vector3d::UnitY(), JulianDayOf("2024-05-15T09:45:00+02:00")};
  input.site = site;
  const Json::Value sun = LiveSolution(input)["sun"];
  const SunPosition truth = PositionOfDirection(network.sun, site.true_north, network.zenith);
  EXPECT_NEAR(sun["azimuth_deg"].asDouble(), truth.azimuth * 180 / M_PI, 1e-3);
  EXPECT_NEAR(sun["elevation_deg"].asDouble(), truth.elevation * 180 / M_PI, 1e-3);
  EXPECT_GT(sun["sigma_deg"].asDouble(), 0);
  EXPECT_LE(sun["ephemeris"]["clock_difference_deg"].asDouble(),
            sun["ephemeris"]["difference_deg"].asDouble() + 1e-9);
  input.site->julian_day.reset();
  EXPECT_TRUE(LiveSolution(input)["sun"]["ephemeris"].isNull());
}

// Whatever has been marked so far, in whatever order, with slips: always a message.
TEST(LiveSolution, TakesAnyUnfinishedSurvey) {
  const SyntheticNetwork network = MakeSyntheticNetwork({.has_extras = true});
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  int solved = 0, failed = 0;
  for (int trial = 0; trial < 100; ++trial) {
    Survey survey = WithNoise(network.survey, static_cast<unsigned>(trial));
    const double keep = uniform(generator), slips = uniform(generator) < 0.3 ? 0.05 : 0;
    const auto is_missing = [&](const auto&) { return uniform(generator) > keep; };
    std::erase_if(survey.observations, is_missing);
    if (trial % 2 == 0) std::erase_if(survey.control_points, is_missing);
    if (trial % 3 == 0) std::erase_if(survey.polygons, is_missing);
    for (ImageObservation& mark : survey.observations) {
      if (uniform(generator) < slips) mark.pixel.y() += 2000 * (uniform(generator) - 0.5);
    }
    const LiveResult result = SolveLive(InputOf(network, survey));
    if (result.solved) ++solved;
    if (!result.message["failed"].isNull()) ++failed;
  }
  EXPECT_GT(solved, 50);
  EXPECT_LE(failed, 2);
}

// What one ray shows on an adjusted polygon is predicted as the adjustment would find it there: as
// a vertex of the polygon.
TEST(LiveSolution, PredictsAPointOfOneMarkFromThePolygonItStandsOn) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  Survey without = WithNoise(network.survey, 5);
  const auto at = [&](const char* name) { return network.points.at(name); };
  const Eigen::Vector3d spot =
      0.5 * (at("south") + at("single")) + 0.1 * (at("north") - at("south"));
  const auto pixel = network.cameras[1].Project(network.cam_from_world[1] * spot);
  ASSERT_TRUE(pixel && network.cameras[1].Sees(*pixel));
  without.observations.push_back({"P2", "spot", *pixel, 0.4, {"observations.csv", 999}});
  Survey with = without;
  auto& ground = with.polygons[0].vertices;
  ground.insert(ground.begin() + 1, "spot");
  const Json::Value whole = LiveSolution(InputOf(network, with))["points"]["spot"];
  const Json::Value message = LiveSolution(InputOf(network, without));
  const Json::Value& point = message["points"]["spot"];
  EXPECT_EQ(point["plane"], "ground");
  EXPECT_TRUE(whole["plane"].isNull());
  EXPECT_EQ(point["rays"].asInt(), 1);
  ASSERT_GT(whole["images"].size(), 1u);
  ASSERT_EQ(point["images"].size(), whole["images"].size());
  for (const std::string& photo : whole["images"].getMemberNames()) {
    for (const char* key : {"x", "y", "major", "minor", "angle"}) {
      const bool is_round = photo == "P2" && key == std::string("angle");  // the mark's own photo
      if (is_round) continue;
      const double expected = whole["images"][photo][key].asDouble();
      EXPECT_NEAR(point["images"][photo][key].asDouble(), expected, 2e-3 * std::abs(expected))
          << photo << " " << key;
    }
  }
  ASSERT_EQ(message["left_out"].size(), 1u);  // it still is, and is said to be
  EXPECT_EQ(message["left_out"][0]["name"], "spot");
  EXPECT_EQ(message["left_out"][0]["reason"], "one ray, needs a second photograph");
}

}  // namespace
}  // namespace insitu
