// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/json_file.h"
#include "tests/radiometry/measure/synthetic_site.h"

namespace insitu {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

class LiveLightTest : public testing::Test {
 protected:
  LiveLightTest() : path_(truth_.site.survey() / "samples.json"), samples_(ReadJson(path_)) {}

  // What is advised of the samples as they stand.
  std::vector<std::string> Advice() {
    WriteJson(path_, samples_);
    LinearPhotos photos(truth_.site);
    const Json::Value message = LiveLight(truth_.site, truth_.scene, photos, nullptr);
    EXPECT_TRUE(message["failed"].isNull()) << message["failed"].toStyledString();
    std::vector<std::string> advice;
    for (const Json::Value& one : message["advice"]) advice.push_back(one["text"].asString());
    return advice;
  }

  const SyntheticSite truth_ = MakeSyntheticSite("live_light");
  const std::filesystem::path path_;
  Json::Value samples_;
};

TEST_F(LiveLightTest, FurtherSamplesAreNamedByTheirLightAndDistance) {
  Json::Value& daylight = samples_["daylight"];
  const Json::Value all = daylight;
  daylight = Json::Value(Json::arrayValue);
  for (const int lit : {0, 1, 2}) daylight.append(all[lit]);
  daylight.append(all[3]);  // one in the shade
  samples_["haze"].resize(2);
  const std::vector<std::string> advice = Advice();
  EXPECT_THAT(advice, Contains(HasSubstr("daylight: one more sample in ")));
  EXPECT_THAT(advice, Contains(HasSubstr("haze: one more sample of the same material ")));
}

TEST_F(LiveLightTest, ASampleAcrossAnEdgeIsNamed) {
  EXPECT_THAT(Advice(), Each(Not(HasSubstr("texture"))));
  Json::Value& sample = samples_["daylight"][4];
  sample["x"] = sample["x"].asDouble() + 3;  // half of it shows the sky behind the patch
  EXPECT_THAT(Advice(), Contains(testing::AllOf(HasSubstr("daylight: the pixels about "),
                                                HasSubstr("texture or an edge"))));
}

}  // namespace
}  // namespace insitu
