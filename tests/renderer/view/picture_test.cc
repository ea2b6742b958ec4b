// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/picture.h"

#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/photo/montage_files.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

// A picture of 5 x 3 different pixels.
Raster Ramp() {
  Raster ramp(5, 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) ramp.SetRgb(x, y, {x / 8.0, y / 4.0, 0.5});
  }
  return ramp;
}

// As montages are turned, and every pixel where UprightPixel says that it is.
TEST(UprightImage, TurnsAsMontagesAreTurned) {
  const Raster ramp = Ramp();
  const cv::Mat stored(3, 5, CV_32FC3, const_cast<float*>(ramp.data.data()));
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const CodedPhotograph expected = Upright(CodesOf(ramp, Encoding::kLinear, {}), orientation);
    const cv::Mat turned = UprightImage(stored, orientation).clone();
    ASSERT_EQ(turned.cols, expected.width) << orientation;
    const auto& samples = std::get<std::vector<float>>(expected.samples);
    EXPECT_TRUE(std::equal(samples.begin(), samples.end(), turned.ptr<float>())) << orientation;
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 5; ++x) {
        const Eigen::Vector2d at = UprightPixel(Eigen::Vector2d(x, y), 5, 3, orientation);
        const auto& pixel =
            turned.at<cv::Vec3f>(static_cast<int>(at.y()), static_cast<int>(at.x()));
        EXPECT_EQ(pixel[0], ramp.At(x, y)[0]) << orientation;
        EXPECT_EQ(pixel[1], ramp.At(x, y)[1]) << orientation;
      }
    }
  }
}

TEST(FilePicture, TellsPixelsUprightAndReadsAnewWhatHasChanged) {
  const ScratchFolder folder;
  const auto file = folder.path() / "photo.exr";
  WriteExr(file, Ramp());
  FilePicture picture({file, 6});  // turned by 90 degrees clockwise
  EXPECT_EQ(picture.Size().width, 3);
  EXPECT_EQ(picture.Size().height, 5);
  const Json::Value value = picture.Value(2, 4);
  EXPECT_EQ(value["linear"][0].asDouble(), 0.5);  // x 4, y 0
  EXPECT_EQ(value["linear"][1].asDouble(), 0);
  EXPECT_NEAR(value["encoded"][0].asDouble(), SrgbFromLinear(0.5), 1e-9);
  EXPECT_EQ(picture.Tile(0, 0, 0).type, "image/png");
  EXPECT_THROW(picture.Value(3, 0), InputError);
  EXPECT_THROW(picture.Tile(0, 1, 0), InputError);
  EXPECT_THROW(picture.Tile(1, 0, 0), InputError);
  const std::string before = picture.Version();
  WriteExr(file, Raster(5, 3));
  EXPECT_NE(picture.Version(), before);
  EXPECT_EQ(picture.Value(2, 4)["linear"][0].asDouble(), 0);
}

}  // namespace
}  // namespace insitu
