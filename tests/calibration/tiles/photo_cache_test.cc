// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/tiles/photo_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace insitu {
namespace {

// 100 x 75 pixels: 30000 bytes with all levels.
class PhotoCacheTest : public testing::Test {
 protected:
  std::shared_ptr<PhotoPyramid> Get(int photo, bool is_overview = false) {
    return cache_.Get({photo, is_overview}, [&] {
      ++decoded_;
      return std::make_shared<PhotoPyramid>(cv::Mat(75, 100, CV_8UC3), 0);
    });
  }
  int DecodedBy(int photo, bool is_overview = false) {
    const int before = decoded_;
    Get(photo, is_overview);
    return decoded_ - before;
  }

  PhotoCache cache_{100000};
  std::atomic<int> decoded_ = 0;
};

TEST_F(PhotoCacheTest, GivesUpWhatWasLeftLongest) {
  for (const int photo : {0, 1, 2}) EXPECT_EQ(DecodedBy(photo), 1);
  EXPECT_EQ(DecodedBy(0), 0);
  EXPECT_EQ(DecodedBy(3), 1);
  EXPECT_EQ(DecodedBy(0), 0);
  EXPECT_EQ(DecodedBy(2), 0);
  EXPECT_EQ(DecodedBy(1), 1);
  EXPECT_EQ(DecodedBy(3), 1);
}

TEST_F(PhotoCacheTest, KeepsOverviewsApart) {
  EXPECT_EQ(DecodedBy(0), 1);
  EXPECT_EQ(DecodedBy(0, true), 1);
  EXPECT_EQ(DecodedBy(0), 0);
  EXPECT_EQ(DecodedBy(0, true), 0);
}

TEST_F(PhotoCacheTest, WhatIsUsedOutlivesItsPlace) {
  const auto pyramid = Get(0);
  for (const int photo : {1, 2, 3}) Get(photo);
  EXPECT_EQ(pyramid->Level(1).cols, 50);
  EXPECT_EQ(DecodedBy(0), 1);
}

TEST(PhotoCache, OneThatIsLargerThanAllRoomIsKeptAlone) {
  PhotoCache cache(10);
  int decoded = 0;
  const auto get = [&](int photo) {
    return cache.Get({photo, false}, [&] {
      ++decoded;
      return std::make_shared<PhotoPyramid>(cv::Mat(75, 100, CV_8UC3), 0);
    });
  };
  for (const int photo : {0, 0, 1, 1, 0}) get(photo);
  EXPECT_EQ(decoded, 3);
}

TEST(PhotoCache, DecodesOnceForAllWhoAsk) {
  PhotoCache cache(1000000);
  std::atomic<int> decoded = 0;
  std::vector<std::thread> threads;
  std::vector<std::shared_ptr<PhotoPyramid>> pyramids(8);
  for (auto& pyramid : pyramids) {
    threads.emplace_back([&cache, &decoded, &pyramid] {
      pyramid = cache.Get({0, false}, [&] {
        ++decoded;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return std::make_shared<PhotoPyramid>(cv::Mat(75, 100, CV_8UC3), 0);
      });
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(decoded, 1);
  for (const auto& pyramid : pyramids) EXPECT_EQ(pyramid, pyramids[0]);
}

TEST(PhotoCache, TellsAllOfAFaultAndTriesAgain) {
  PhotoCache cache(1000000);
  std::atomic<int> tried = 0, failed = 0;
  const auto get = [&] {
    try {
      cache.Get({0, false}, [&]() -> std::shared_ptr<PhotoPyramid> {
        ++tried;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        throw std::runtime_error("damaged");
      });
    } catch (const std::runtime_error&) {
      ++failed;
    }
  };
  std::thread other(get);
  get();
  other.join();
  const int before = tried;
  get();
  EXPECT_EQ(failed, 3);
  EXPECT_EQ(tried, before + 1);
}

}  // namespace
}  // namespace insitu
