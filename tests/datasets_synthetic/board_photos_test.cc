// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/board_photos.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace insitu::demo {
namespace {

// Wherever the boards were held, each part of the frame has seen one: its squares vary strongly.
TEST(BoardPhotos, FillTheFrameTogether) {
  const Lens lens = DemoLens(240, 160);
  const std::vector<Raster> photos = BoardPhotos(lens);
  EXPECT_GE(photos.size(), 12u);
  constexpr int kCell = 40;  // [px]
  for (int y0 = 0; y0 < lens.height; y0 += kCell) {
    for (int x0 = 0; x0 < lens.width; x0 += kCell) {
      float widest = 0;
      for (const Raster& photo : photos) {
        float low = 1, high = 0;
        for (int y = y0; y < y0 + kCell; ++y) {
          for (int x = x0; x < x0 + kCell; ++x) {
            low = std::min(low, *photo.At(x, y));
            high = std::max(high, *photo.At(x, y));
          }
        }
        widest = std::max(widest, high - low);
      }
      EXPECT_GT(widest, 0.5f) << x0 << " " << y0;
    }
  }
}

TEST(BoardPhotos, AreTheSameEveryTime) {
  const Lens lens = DemoLens(192, 128);
  EXPECT_EQ(BoardPhotos(lens)[3].data, BoardPhotos(lens)[3].data);
}

}  // namespace
}  // namespace insitu::demo
