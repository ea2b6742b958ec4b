// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/edge_spread.h"

#include <gtest/gtest.h>

#include "tests/radiometry/measure/edge_picture.h"

namespace insitu {
namespace {

TEST(MeasureEdgeSpread, FindsTheSigmaWithinFivePercentAtAnyAngleAndNoise) {
  for (const double angle : {0.03, 0.1, 0.6, std::numbers::pi / 4, 1.3, 1.6, 2.5, -2.8}) {
    for (const double sigma : {0.4, 0.6, 0.9, 1.4}) {
      for (const double noise : {0.0, 0.002, 0.01}) {
        const EdgePicture picture{.angle = angle, .sigma = sigma, .noise = noise};
        const auto spread = MeasureEdgeSpread(picture.Draw(), picture.Piece(80));
        ASSERT_TRUE(spread) << angle << " " << sigma << " " << noise;
        EXPECT_NEAR(spread->sigma, sigma, 0.05 * sigma) << angle << " " << noise;
      }
    }
  }
}

TEST(MeasureEdgeSpread, ItsErrorIsThatOfRepetition) {
  const EdgePicture picture{.sigma = 0.6, .noise = 0.01};
  const auto spread = MeasureEdgeSpread(picture.Draw(), picture.Piece(80));
  ASSERT_TRUE(spread);
  EXPECT_LT(std::abs(spread->sigma - 0.6), 4 * spread->sigma_error);
  EXPECT_LT(spread->sigma_error, 0.02);
}

// The survey's place of an edge is off by a fraction of a pixel.
TEST(MeasureEdgeSpread, DoesNotNeedTheExactPlace) {
  const EdgePicture picture{.sigma = 0.5};
  EdgePiece piece = picture.Piece(60);
  piece[0] += Eigen::Vector2d(0, 1.1);
  piece[1] += Eigen::Vector2d(0, 0.8);
  piece[2] += Eigen::Vector2d(0, 0.5);
  const auto spread = MeasureEdgeSpread(picture.Draw(), piece);
  ASSERT_TRUE(spread);
  EXPECT_NEAR(spread->sigma, 0.5, 0.025);
}

TEST(MeasureEdgeSpread, RefusesWhatIsNoSuchEdge) {
  EdgePicture faint{.bright = 0.22};
  EXPECT_FALSE(MeasureEdgeSpread(faint.Draw(), faint.Piece(80)));
  EdgePicture rough{.noise = 0.1};  // texture
  EXPECT_FALSE(MeasureEdgeSpread(rough.Draw(), rough.Piece(80)));
  EdgePicture along_rows{.angle = 0.002};
  EXPECT_FALSE(MeasureEdgeSpread(along_rows.Draw(), along_rows.Piece(100)));
  EdgePicture edge;
  EXPECT_FALSE(MeasureEdgeSpread(edge.Draw(), edge.Piece(158)));  // leaves the frame
  EdgePiece away = edge.Piece(80);
  for (Eigen::Vector2d& point : away) point.y() += 3.5;
  EXPECT_FALSE(MeasureEdgeSpread(edge.Draw(), away));
  Photograph clipped = edge.Draw();
  clipped.encoding = Encoding::kSrgb8;
  clipped.linear.SetRgb(80, 83, Eigen::Vector3d::Ones());
  EXPECT_FALSE(MeasureEdgeSpread(clipped, edge.Piece(80)));
}

// A bar two pixels wide is two edges too close to tell.
TEST(MeasureEdgeSpread, RefusesABar) {
  const EdgePicture first, second{.dark = 0, .bright = 0.5};
  Photograph bar = first.Draw();
  const Photograph other = second.Draw();
  for (int y = 2; y < EdgePicture::kSize; ++y) {
    for (int x = 0; x < EdgePicture::kSize; ++x) {
      bar.linear.SetRgb(x, y, bar.linear.Rgb(x, y) - other.linear.Rgb(x, y - 2));
    }
  }
  EXPECT_FALSE(MeasureEdgeSpread(bar, first.Piece(80)));
}

TEST(SlantedLength, CrossesARowOfPixels) {
  EXPECT_EQ(SlantedLength({std::sqrt(0.5), std::sqrt(0.5)}), 32);
  EXPECT_NEAR(*SlantedLength({0.02, 1}), 60, 1);
  EXPECT_FALSE(SlantedLength({1, 0}));
}

}  // namespace
}  // namespace insitu
