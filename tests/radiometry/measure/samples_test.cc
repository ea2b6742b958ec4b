// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/samples.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "tests/calibration/files/wrong_field.h"
#include "tests/radiometry/measure/synthetic_site.h"

namespace insitu {
namespace {

class SamplesTest : public testing::Test {
 protected:
  void SetUp() override {
    synthetic_ = MakeSyntheticSite(std::string("samples_") +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
    for (const char* photo : {"A.exr", "B.exr"}) {
      photos_.push_back(ReadPhotograph(synthetic_.site.photos() / photo));
    }
  }

  LightSamples Read() const { return ReadSamples(synthetic_.site, synthetic_.scene, photos_); }

  std::string OnGround(const std::string& photo, double x, double y) const {
    return SampleEntry(synthetic_, photo, "ground", {x, y, 0});
  }

  // The message about a samples.json whose line 3 holds the first of four daylight samples.
  std::string ErrorWithDaylight(const std::string& first) {
    return ErrorOf("{\"horizon\": [{\"photo\": \"A\", \"x\": 450, \"y\": 20}],\n\"daylight\": [\n" +
                   first + ",\n" + OnGround("A", 0, -4) + ",\n" + OnGround("A", 0, 6) + ",\n" +
                   OnGround("A", 3, -1) + "]}\n");
  }

  std::string ErrorOf(const std::string& text) {
    WriteWhole(synthetic_.site.survey() / "samples.json", text);
    try {
      Read();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  SyntheticSite synthetic_;
  std::vector<Photograph> photos_;
};

void ExpectPlaceAndMessage(const std::string& error, int line, const std::string& message) {
  EXPECT_NE(error.find("samples.json:" + std::to_string(line) + ":"), std::string::npos) << error;
  EXPECT_NE(error.find(message), std::string::npos) << error;
}

TEST_F(SamplesTest, MeasuresColorPlaceAndDistance) {
  const LightSamples samples = Read();
  ASSERT_EQ(samples.horizon.size(), 1u);
  ASSERT_EQ(samples.haze.size(), 6u);
  ASSERT_EQ(samples.daylight.size(), 9u);
  EXPECT_LT((samples.horizon[0].rgb - synthetic_.horizon).norm(), 1e-6);
  EXPECT_FALSE(samples.horizon[0].polygon);
  const PixelSample& nearest = samples.haze[0];
  EXPECT_EQ(nearest.photo, 1);
  EXPECT_EQ(*nearest.polygon, 0);
  EXPECT_LT((nearest.point - synthetic_.scene.origin - Eigen::Vector3d(-7, -170, 0)).norm(), 1e-6);
  EXPECT_NEAR(nearest.distance, Eigen::Vector3d(7, 20, 5).norm(), 1e-6);
  EXPECT_EQ(nearest.place.line, 4);
  EXPECT_EQ(*samples.daylight_reflectance, Eigen::Vector3d::Constant(0.4));
}

TEST_F(SamplesTest, SigmaIsThatOfTheMeanWithAFloorOfOnePercent) {
  EXPECT_LT((Read().daylight[0].rgb_sigma - 0.01 * Read().daylight[0].rgb).norm(), 1e-12);
  Raster& image = photos_[0].linear;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {  // a checkerboard of 0.3 and 0.7
      image.SetRgb(x, y, Eigen::Vector3d::Constant((x + y) % 2 ? 0.3 : 0.7));
    }
  }
  const PixelSample sample = Read().daylight[0];
  const double mean = (13 * 0.5 + 12 * 0.5 + 0.2) / 25 - 0.2 / 25;
  EXPECT_NEAR(sample.rgb.x(), mean, 0.2 / 25 + 1e-6);
  EXPECT_NEAR(sample.rgb_sigma.x(), 0.2 / 5, 0.002);
}

TEST_F(SamplesTest, AsPrintedItIsTheImageFunctionAtTheSample) {
  Raster& image = photos_[0].linear;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      image.SetRgb(x, y, Eigen::Vector3d(0.001 * x, 0.001 * y, (x + y) % 2));
    }
  }
  const PixelSample sample =
      ReadSamples(synthetic_.site, synthetic_.scene, photos_, {.radius = 0}).daylight[0];
  ASSERT_EQ(sample.photo, 0);
  EXPECT_NEAR(sample.rgb.x(), 0.001 * sample.pixel.x(), 1e-6);
  EXPECT_NEAR(sample.rgb.y(), 0.001 * sample.pixel.y(), 1e-6);
}

TEST_F(SamplesTest, ColorComesFromTheSameSurfaceOnly) {
  // Half a pixel before the wall's foot the patch would reach onto the wall.
  Raster& image = photos_[0].linear;
  const Eigen::Vector3d ground = Eigen::Vector3d::Constant(0.25);
  const PosedCamera& camera = synthetic_.scene.cameras[0];
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto wall = PointOnPolygon(camera, Eigen::Vector2d(x, y), synthetic_.scene.polygons[1]);
      image.SetRgb(x, y, wall ? Eigen::Vector3d::Ones() : ground);
    }
  }
  WriteWhole(synthetic_.site.survey() / "samples.json",
             "{\"horizon\": [{\"photo\": \"A\", \"x\": 450, \"y\": 20}], \"daylight\": [" +
                 OnGround("A", 0, 9.9) + "," + OnGround("A", 1, 9.9) + "," + OnGround("A", 2, 9.9) +
                 "]}");
  for (const PixelSample& sample : Read().daylight) EXPECT_LT((sample.rgb - ground).norm(), 1e-6);
}

TEST_F(SamplesTest, HazeAndReflectanceMayBeMissing) {
  WriteWhole(synthetic_.site.survey() / "samples.json",
             "{\"horizon\": [{\"photo\": \"A\", \"x\": 450, \"y\": 20}], \"daylight\": [" +
                 OnGround("A", 0, -4) + "," + OnGround("A", 0, 6) + "," + OnGround("A", 3, -1) +
                 "]}");
  EXPECT_TRUE(Read().haze.empty());
  EXPECT_FALSE(Read().daylight_reflectance);
}

TEST_F(SamplesTest, ASampleOnSkyIsRefused) {
  ExpectPlaceAndMessage(
      ErrorWithDaylight(R"({"photo": "A", "x": 450, "y": 20, "polygon": "ground"})"), 3,
      "misses polygon \"ground\"");
}

TEST_F(SamplesTest, AHorizonSampleOnAPolygonIsRefused) {
  ExpectPlaceAndMessage(ErrorOf("{\n\"horizon\": [\n{\"photo\": \"A\", \"x\": 450, \"y\": 500}]}"),
                        3, "lies on polygon \"ground\", expected a pixel of the sky");
}

TEST_F(SamplesTest, ASampleBehindAnotherPolygonIsRefused) {
  std::string on_wall = SampleEntry(synthetic_, "A", "wall", {0, 10, 2});
  on_wall.replace(on_wall.find("wall"), 4, "ground");
  ExpectPlaceAndMessage(ErrorWithDaylight(on_wall), 3, "shows polygon \"wall\" before");
}

TEST_F(SamplesTest, AClippedSampleIsRefused) {
  photos_[0].encoding = Encoding::kSrgb8;
  Raster& image = photos_[0].linear;
  std::fill(image.data.begin(), image.data.end(), 0.5f);
  std::fill(image.data.begin() + image.data.size() / 3, image.data.end(), 1.0f);
  ExpectPlaceAndMessage(ErrorWithDaylight(OnGround("A", -3, -8)), 3, "is clipped");
}

TEST_F(SamplesTest, UnknownPhotoAndPolygonAreRefused) {
  ExpectPlaceAndMessage(
      ErrorWithDaylight(R"({"photo": "Z", "x": 450, "y": 500, "polygon": "ground"})"), 3,
      "unknown photo \"Z\"");
  ExpectPlaceAndMessage(
      ErrorWithDaylight(R"({"photo": "A", "x": 450, "y": 500, "polygon": "lake"})"), 3,
      "unknown polygon \"lake\"");
}

TEST_F(SamplesTest, ASampleOutsideThePhotographIsRefused) {
  ExpectPlaceAndMessage(
      ErrorWithDaylight(R"({"photo": "A", "x": 900, "y": 500, "polygon": "ground"})"), 3,
      "outside the photograph, expected a pixel of 900 x 600");
}

TEST_F(SamplesTest, NanIsRefused) {
  ExpectPlaceAndMessage(
      ErrorWithDaylight(R"({"photo": "A", "x": NaN, "y": 500, "polygon": "ground"})"), 3, "");
  ExpectPlaceAndMessage(
      ErrorWithDaylight(R"({"photo": "A", "x": "450", "y": 500, "polygon": "ground"})"), 3,
      "expected a number");
}

TEST_F(SamplesTest, TooFewSamplesAreRefused) {
  const std::string horizon = "{\"horizon\": [{\"photo\": \"A\", \"x\": 450, \"y\": 20}],\n";
  ExpectPlaceAndMessage(ErrorOf(horizon + "\"daylight\": [" + OnGround("A", 0, -4) + "]}"), 2,
                        "expected at least 3");
  ExpectPlaceAndMessage(ErrorOf(horizon + "\n\"haze\": [" + OnGround("A", 0, -4) + "]}"), 3,
                        "expected at least 2");
  ExpectPlaceAndMessage(
      ErrorOf(horizon + "\"haze\": [" + OnGround("A", 0, -4) + "," + OnGround("A", 0, -4) + "]}"),
      2, "at one distance");
  ExpectPlaceAndMessage(ErrorOf(horizon + "\"haze\": null}"), 1, "\"daylight\" is missing");
  ExpectPlaceAndMessage(ErrorOf("{\n\"horizon\": []}"), 2, "expected at least 1");
}

TEST_F(SamplesTest, OneRunTellsAllFaults) {
  const std::string error =
      ErrorOf("{\n\"haze\": [" + OnGround("A", 0, -4) + "],\n\"daylight\": [\n" +
              R"({"photo": "Z", "x": 450, "y": 500, "polygon": "lake"},)" + "\n" +
              R"({"photo": "A", "x": 450, "y": 20, "polygon": "ground"},)" + "\n" +
              R"({"photo": "A", "y": 20, "polygon": "ground"}],)" + "\n" +
              "\"daylight_reflectance_rgb\": [1, 2, 3]}");
  EXPECT_NE(error.find("7 faults"), std::string::npos) << error;
  ExpectPlaceAndMessage(error, 1, "\"horizon\" is missing");
  ExpectPlaceAndMessage(error, 2, "expected at least 2");
  ExpectPlaceAndMessage(error, 4, "unknown photo \"Z\"");
  ExpectPlaceAndMessage(error, 4, "unknown polygon \"lake\"");
  ExpectPlaceAndMessage(error, 5, "misses polygon");
  ExpectPlaceAndMessage(error, 6, "\"x\" is missing");
  ExpectPlaceAndMessage(error, 7, "above 0 and up to 1");
}

TEST_F(SamplesTest, WhileTheyAreChosenThoseAtFaultAreListed) {
  WriteWhole(synthetic_.site.survey() / "samples.json",
             "{\"horizon\": [],\n\"daylight\": [\n" + OnGround("A", 0, -4) + ",\n" +
                 R"({"photo": "A", "x": 450, "y": 500, "polygon": "roof"})" + "]}");
  std::vector<Sentence> faults;
  const LightSamples samples = ReadSamples(synthetic_.site, synthetic_.scene, photos_, {}, &faults);
  EXPECT_EQ(samples.daylight.size(), 1U);
  ASSERT_EQ(faults.size(), 1U);
  ExpectPlaceAndMessage(faults[0].text(), 4, "roof");
}

TEST_F(SamplesTest, AReflectanceOutsideZeroToOneIsRefused) {
  std::string text = ReadWhole(synthetic_.site.survey() / "samples.json");
  text.replace(text.find("[0.4, 0.4, 0.4]"), 15, "[0.4, 1.4, 0.4]");
  ExpectPlaceAndMessage(ErrorOf(text), 20, "above 0 and up to 1");
}

TEST(SampleOptions, NameTheFieldThatIsWrong) {
  EXPECT_EQ(WrongField(SampleOptions()), "");
  EXPECT_NE(WrongField(SampleOptions{.radius = -1}).find("radius"), std::string::npos);
}

}  // namespace
}  // namespace insitu
