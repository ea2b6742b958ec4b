// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/questions.h"

#include <gtest/gtest.h>

#include <string>

#include "calibration/files/error.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

class QuestionsTest : public testing::Test {
 protected:
  QuestionsTest() : network_(MakeSyntheticNetwork()) {
    LiveInput input;
    input.survey = network_.survey;
    for (size_t i = 0; i < network_.photos.size(); ++i) {
      input.photos.push_back({network_.photos[i], network_.cameras[i]});
    }
    live_.result = SolveLive(input);
  }

  Json::Value PolygonAt(size_t photo, const Eigen::Vector2d& pixel) const {
    Json::Value question;
    question["photo"] = network_.photos[photo];
    question["x"] = pixel.x();
    question["y"] = pixel.y();
    return PolygonAtAnswer(live_, question)["polygon"];
  }

  SyntheticNetwork network_;
  LiveState live_;
};

// A wall that looks here, in its middle: what stands behind it is not meant, nor the ground.
TEST_F(QuestionsTest, NamesThePolygonThatAPixelSeesFirst) {
  int found = 0;
  for (size_t photo = 0; photo < network_.photos.size(); ++photo) {
    const auto point = [&](const char* name) { return network_.points.at(name); };
    const Eigen::Vector3d middle = (point("b0") + point("b1") + point("b4") + point("b5")) / 4;
    const auto pixel = network_.cameras[photo].Project(network_.cam_from_world[photo] * middle);
    if (!pixel || !network_.cameras[photo].Sees(*pixel)) continue;
    found += PolygonAt(photo, *pixel).asString() == "b_wall0";
  }
  EXPECT_GT(found, 1);
}

TEST_F(QuestionsTest, TheSkyIsNoPolygon) {
  EXPECT_TRUE(PolygonAt(0, {network_.cameras[0].width() / 2.0, 0}).isNull());
}

TEST_F(QuestionsTest, APhotoThatIsNotOrientedSeesNothingYet) {
  Json::Value question;
  question["photo"] = "P9";
  EXPECT_THROW(PolygonAtAnswer(live_, question), InputError);
}

}  // namespace
}  // namespace insitu
