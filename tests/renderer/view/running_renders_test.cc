// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/running_renders.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

constexpr int kWidth = 100, kHeight = 70;  // 4 x 3 tiles

// All of a tile computed, green.
FinishedTile GreenTile(int index) {
  FinishedTile tile;
  tile.index = index;
  const int pixels = TileAt(kWidth, kHeight, index).pixels();
  tile.is_computed.assign(pixels, 1);
  for (int i = 0; i < pixels; ++i) tile.rgb.insert(tile.rgb.end(), {0, 1, 0});
  tile.unseen.assign(pixels, 0);
  return tile;
}

cv::Mat Decoded(const WebResponse& response) {
  const std::vector<uchar> bytes(response.body.begin(), response.body.end());
  return cv::imdecode(bytes, cv::IMREAD_COLOR);
}

// A black photograph that is rendered in part.
class RunningRendersTest : public testing::Test {
 protected:
  RunningRendersTest() { WritePng(photograph_, Raster(kWidth, kHeight), Encoding::kSrgb8); }
  std::vector<Json::Value> Poll() { return renders_.Poll({photograph_}); }

  ScratchFolder folder_;
  SitePaths site_{folder_.path()};
  std::filesystem::path photograph_ = site_.photos() / "photo.png";
  std::filesystem::path partial_ = site_.root / "work/render/photo.partial";
  PartialHeader header_{kWidth, kHeight, "photo", "abc"};
  RunningRenders renders_{site_};
};

TEST_F(RunningRendersTest, WhatIsNotRenderedIsHatchedAtEveryZoom) {
  PartialRender partial(partial_, header_);
  partial.Keep(GreenTile(5));  // the second of the second row
  Poll();
  const auto picture = renders_.Of("photo");
  ASSERT_TRUE(picture);
  const cv::Mat tile = Decoded(picture->Tile(0, 0, 0));
  int hatched = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto& pixel = tile.at<cv::Vec3b>(y, x);
      const bool is_done = x / 32 == 1 && y / 32 == 1;
      if (is_done) {
        ASSERT_EQ(pixel, cv::Vec3b(0, 255, 0)) << x << " " << y;
      } else if (pixel != cv::Vec3b(0, 0, 0)) {
        ++hatched;
      }
    }
  }
  EXPECT_NEAR(hatched, (kWidth * kHeight - 1024) / 3, 100);
  EXPECT_TRUE(picture->Value(3, 3)["unfinished"].asBool());
  EXPECT_EQ(picture->Value(40, 40)["encoded"][1].asDouble(), 1);
}

TEST_F(RunningRendersTest, NewsAreToldOnce) {
  EXPECT_TRUE(Poll().empty());
  {
    PartialRender partial(partial_, header_);
    partial.Keep(GreenTile(11));  // the last one, which is smaller
    const std::vector<Json::Value> news = Poll();
    ASSERT_EQ(news.size(), 1u);
    EXPECT_EQ(news[0]["state"].asString(), "running");
    EXPECT_TRUE(news[0]["anew"].asBool());
    EXPECT_EQ(news[0]["done"].asInt(), 1);
    EXPECT_EQ(news[0]["total"].asInt(), 12);
    ASSERT_EQ(news[0]["tiles"].size(), 1u);
    EXPECT_EQ(news[0]["tiles"][0][0].asInt(), 96);
    EXPECT_EQ(news[0]["tiles"][0][3].asInt(), 70);
    EXPECT_TRUE(Poll().empty());
  }
  EXPECT_EQ(Poll().at(0)["state"].asString(), "waiting");
  std::filesystem::remove(partial_);
  EXPECT_EQ(Poll().at(0)["state"].asString(), "none");
  EXPECT_FALSE(renders_.Of("photo"));
}

}  // namespace
}  // namespace insitu
