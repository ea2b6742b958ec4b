// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/colmap_subset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace insitu {
namespace {

using testing::ElementsAre;
using testing::Key;

// Point 1 on all three images, point 2 on the first and the last, point 3 twice on the first.
ColmapModel ThreeImages() {
  ColmapModel model;
  model.cameras[1] = {"SIMPLE_PINHOLE", 640, 480, {500, 320, 240}};
  model.cameras[2] = {"SIMPLE_PINHOLE", 800, 600, {700, 400, 300}};
  model.images[10] = {"a.jpg", 1, {}, {{{1, 1}, 1}, {{2, 2}, 2}, {{3, 3}, 3}, {{4, 4}, 3}}};
  model.images[11] = {"b.jpg", 1, {}, {{{5, 5}, 1}}};
  model.images[12] = {"c.jpg", 2, {}, {{{6, 6}, 2}, {{7, 7}, 1}}};
  model.points[1] = {{0, 0, 1}, {}, 0.5, {{10, 0}, {11, 0}, {12, 1}}};
  model.points[2] = {{0, 0, 2}, {}, 0.5, {{10, 1}, {12, 0}}};
  model.points[3] = {{0, 0, 3}, {}, 0.5, {{10, 2}, {10, 3}}};
  return model;
}

TEST(KeepImages, PointsOfTwoImagesStayWithTheirMarksThere) {
  ColmapModel model = ThreeImages();
  KeepImages({10, 11}, &model);
  EXPECT_THAT(model.images, ElementsAre(Key(10), Key(11)));
  EXPECT_THAT(model.cameras, ElementsAre(Key(1)));
  ASSERT_THAT(model.points, ElementsAre(Key(1)));
  EXPECT_THAT(model.points[1].track,
              ElementsAre(ColmapTrackElement{10, 0}, ColmapTrackElement{11, 0}));
  EXPECT_THAT(
      model.images[10].keypoints,
      ElementsAre(ColmapKeypoint{{1, 1}, 1}, ColmapKeypoint{{2, 2}, std::nullopt},
                  ColmapKeypoint{{3, 3}, std::nullopt}, ColmapKeypoint{{4, 4}, std::nullopt}));
}

TEST(KeepImages, AllOfThemLeaveOutWhatOneShowsAlone) {
  ColmapModel model = ThreeImages();
  KeepImages({10, 11, 12}, &model);
  EXPECT_THAT(model.points, ElementsAre(Key(1), Key(2)));
  EXPECT_THAT(model.cameras, ElementsAre(Key(1), Key(2)));
}

}  // namespace
}  // namespace insitu
