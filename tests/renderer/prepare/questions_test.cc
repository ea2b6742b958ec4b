// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/questions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "calibration/files/error.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/reconstruction/survey/synthetic_network.h"
#include "tests/renderer/live/line_distance.h"

namespace insitu {
namespace {

class QuestionsTest : public testing::Test {
 protected:
  QuestionsTest() : network_(MakeSyntheticNetwork()) { Solve(network_.survey); }

  void Solve(const Survey& survey) {
    LiveInput input;
    input.survey = survey;
    for (size_t i = 0; i < network_.photos.size(); ++i) {
      input.photos.push_back({network_.photos[i], network_.cameras[i]});
    }
    live_.result = SolveLive(input);
  }

  std::optional<Eigen::Vector2d> Pixel(size_t photo, const std::string& point) const {
    const auto pixel =
        network_.cameras[photo].Project(network_.cam_from_world[photo] * network_.points.at(point));
    return pixel && network_.cameras[photo].Sees(*pixel) ? pixel : std::nullopt;
  }
  Json::Value At(size_t photo, const Eigen::Vector2d& pixel) const {
    Json::Value question;
    question["photo"] = network_.photos[photo];
    question["x"] = pixel.x();
    question["y"] = pixel.y();
    return question;
  }
  static Json::Value Names(const char* key, const std::vector<std::string>& names) {
    Json::Value question;
    for (const std::string& name : names) question[key].append(name);
    return question;
  }

  // Of the band at the curve's place nearest to a pixel [px].
  static double WidthAt(const Json::Value& answer, const Eigen::Vector2d& pixel) {
    double least = std::numeric_limits<double>::infinity(), width = 0;
    for (Json::ArrayIndex i = 0; i < answer["curve"].size(); ++i) {
      const auto vector = [&](const char* key) {
        return Eigen::Vector2d(answer[key][i][0].asDouble(), answer[key][i][1].asDouble());
      };
      const double distance = (vector("curve") - pixel).norm();
      if (distance >= least) continue;
      least = distance;
      width = vector("band").norm();
    }
    return width;
  }

  SyntheticNetwork network_;
  LiveState live_;
};

TEST_F(QuestionsTest, APixelSeesThePolygonBeforeTheOthers) {
  int found = 0;
  for (size_t photo = 0; photo < network_.photos.size(); ++photo) {
    const Eigen::Vector3d middle = (network_.points.at("b0") + network_.points.at("b1") +
                                    network_.points.at("b4") + network_.points.at("b5")) /
                                   4;
    const auto pixel = network_.cameras[photo].Project(network_.cam_from_world[photo] * middle);
    if (!pixel || !network_.cameras[photo].Sees(*pixel)) continue;
    found += PolygonAtAnswer(live_, At(photo, *pixel))["polygon"].asString() == "b_wall0";
    EXPECT_TRUE(PolygonAtAnswer(live_, At(photo, {pixel->x(), -1e6}))["polygon"].isNull());
  }
  EXPECT_GT(found, 0);
}

TEST_F(QuestionsTest, AnEpipolarCurvePassesThroughThePointsOtherImage) {
  int curves = 0;
  for (size_t other = 1; other < network_.photos.size(); ++other) {
    for (const auto& [name, position] : network_.points) {
      const auto here = Pixel(0, name), there = Pixel(other, name);
      if (!here || !there) continue;
      Json::Value question = At(0, *here);
      question["other"] = network_.photos[other];
      const Json::Value curve = EpipolarAnswer(live_, question)["curve"];
      if (curve.empty()) continue;  // taken from one place
      EXPECT_LT(DistanceToLine(curve, *there), 5)
          << name;  // the adjusted poses are not the true ones
      ++curves;
    }
  }
  EXPECT_GT(curves, 20);
}

// Of surveys with errors of their sigmas, and marks with theirs: the true image lies in the band as
// often as 95 % says, or a little more, for this town's planes have no errors.
TEST_F(QuestionsTest, TheBandHoldsTheImageOfNineteenInTwentyPoints) {
  std::mt19937 random(3);
  std::normal_distribution<double> error(0, 0.4);
  int inside = 0, all = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    Solve(WithNoise(network_.survey, seed));
    for (const auto& [name, position] : network_.points) {
      for (size_t other = 1; other < network_.photos.size(); ++other) {
        const auto here = Pixel(0, name), there = Pixel(other, name);
        if (!here || !there) continue;
        Json::Value question = At(0, *here + Eigen::Vector2d(error(random), error(random)));
        question["other"] = network_.photos[other];
        question["sigma"] = 0.4;
        const Json::Value answer = EpipolarAnswer(live_, question);
        ASSERT_EQ(answer["band"].size(), answer["curve"].size());
        if (answer["curve"].empty()) continue;
        ++all;
        inside += DistanceToLine(answer["curve"], *there) < WidthAt(answer, *there);
      }
    }
  }
  EXPECT_GT(all, 300);
  EXPECT_GT(inside, 0.93 * all) << inside << " of " << all;
  EXPECT_LT(inside, 0.985 * all) << inside << " of " << all;
}

TEST_F(QuestionsTest, ADistanceIsThatOfTheTruthWithinItsSigmas) {
  const Json::Value answer = MeasureAnswer(live_, Names("points", {"b0", "b1"}));
  const double truth = (network_.points.at("b0") - network_.points.at("b1")).norm();
  EXPECT_GT(answer["sigma_m"].asDouble(), 0);
  EXPECT_LT(std::abs(answer["distance_m"].asDouble() - truth), 4 * answer["sigma_m"].asDouble());
  const Json::Value corner = MeasureAnswer(live_, Names("points", {"b1", "b0", "b4"}));
  EXPECT_NEAR(corner["angle_deg"].asDouble(), 90, 4 * corner["sigma_deg"].asDouble() + 1e-9);
}

TEST_F(QuestionsTest, WhatIsNotKnownIsSaid) {
  EXPECT_THROW(MeasureAnswer(live_, Names("points", {"b0", "nobody"})), InputError);
  EXPECT_THROW(MeasureAnswer(live_, Names("points", {"b0"})), InputError);
  EXPECT_THROW(MeasureAnswer({}, Names("points", {"b0", "b1"})), InputError);
  EXPECT_THROW(BestPhotoAnswer(live_, Names("vertices", {"b0", "b1"})), InputError);
  Json::Value question = At(0, {10, 10});
  question["other"] = "nowhere";
  EXPECT_THROW(EpipolarAnswer(live_, question), InputError);
}

TEST_F(QuestionsTest, PhotosOfAPolygonComeBestFirst) {
  const Json::Value photos =
      BestPhotoAnswer(live_, Names("vertices", {"b0", "b1", "b5", "b4"}))["photos"];
  ASSERT_GT(photos.size(), 1U);
  for (Json::ArrayIndex i = 1; i < photos.size(); ++i) {
    EXPECT_GE(photos[i - 1]["score"].asDouble(), photos[i]["score"].asDouble());
  }
}

TEST(ImportAnswer, ReadsAPastedTable) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path() / "work/prepare");
  Json::Value question;
  question["text"] = "Name\tEast\tNorth\tHeight\nA\t2600000.125\t1200000.5\t431.25\n";
  const Json::Value answer = ImportAnswer({folder.path()}, question);
  ASSERT_EQ(answer["rows"].size(), 1U);
  EXPECT_EQ(answer["rows"][0]["name"], "A");
  EXPECT_EQ(answer["rows"][0]["x"].asDouble(), 2600000.125);
  EXPECT_EQ(answer["remarks"].size(), 1U);  // no sigma is stated
  question["text"] = "nothing that is a table";
  EXPECT_THROW(ImportAnswer({folder.path()}, question), InputError);
}

}  // namespace
}  // namespace insitu
