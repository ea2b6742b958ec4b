// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/photograph_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

constexpr size_t kBytes = 1200;  // of one photograph of 10 x 10 pixels

class PhotographSetTest : public testing::Test {
 protected:
  PhotographSetTest() {
    for (int i = 0; i < 4; ++i) {
      files_.push_back(folder_.path() / (std::to_string(i) + ".exr"));
      WriteExr(files_.back(), Grey(i));
    }
  }
  static Raster Grey(int i) {
    Raster grey(10, 10);
    std::ranges::fill(grey.data, 0.1f * static_cast<float>(i + 1));
    return grey;
  }

  ScratchFolder folder_;
  std::vector<std::filesystem::path> files_;
};

TEST_F(PhotographSetTest, GivesEachWhateverIsHeld) {
  for (const size_t most : {size_t{0}, 2 * kBytes, 4 * kBytes}) {
    const PhotographSet photos(files_, most);
    EXPECT_EQ(photos.IsAllHeld(), most == 4 * kBytes);
    for (const size_t i : {0, 1, 2, 3, 1, 0}) {
      EXPECT_EQ(photos[i]->linear.data, Grey(static_cast<int>(i)).data);
    }
  }
}

TEST_F(PhotographSetTest, LetsTheOneGoThatWasNotUsedForLongest) {
  const PhotographSet photos(files_, 2 * kBytes);
  const std::weak_ptr<const Photograph> first = photos[0], second = photos[1];
  EXPECT_FALSE(photos[0] == nullptr);
  const std::weak_ptr<const Photograph> third = photos[2];
  EXPECT_FALSE(first.expired());
  EXPECT_TRUE(second.expired());
  EXPECT_FALSE(third.expired());
}

TEST_F(PhotographSetTest, AFactorCountsHoweverOftenItIsRead) {
  PhotographSet photos(files_, kBytes);
  EXPECT_FLOAT_EQ(photos[1]->linear.data[4], 0.2f);
  photos.SetFactor(1, {1, 2, 3});
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_FLOAT_EQ(photos[1]->linear.data[4], 0.4f);
    EXPECT_FLOAT_EQ(photos[1]->linear.data[5], 0.6f);
    EXPECT_FLOAT_EQ(photos[2]->linear.data[5], 0.3f);
  }
}

TEST_F(PhotographSetTest, TakesThoseOfACaller) {
  const std::vector<Photograph> callers = {{Grey(0)}, {Grey(2)}};
  const PhotographSet photos = callers;
  EXPECT_TRUE(photos.IsAllHeld());
  EXPECT_EQ(photos[1].get(), &callers[1]);
}

}  // namespace
}  // namespace insitu
