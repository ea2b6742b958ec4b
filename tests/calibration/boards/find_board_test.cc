// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/find_board.h"

#include "calibration/photo/photograph.h"
#include "tests/calibration/boards/drawn_boards.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

class FindsBoards : public testing::Test {
 protected:
  // The photographs of a board.
  Raster Photo(const Board& board, int number) {
    const auto folder = folder_.path();
    WriteBoardPhotos(folder, board);
    return ReadPhotograph(folder / ("board_" + std::to_string(number) + ".png")).linear;
  }
  ScratchFolder folder_;
};

// Where the lens puts a point of the first photograph's board, seen from either end.
Eigen::Vector2d Projected(const Board& board, size_t point, bool is_turned) {
  const Camera lens = BoardPhotosLens();
  Eigen::Vector3d place = kFirstBoardDistance * lens.Unproject(kFirstBoardPixel);
  const Eigen::Vector2d on_board = (is_turned ? -1 : 1) * PlaceOf(board, point);
  place.head<2>() += on_board;
  return *lens.Project(place);
}

// Number and mean of the errors of what was found; each is below `most` [px].
struct Errors {
  int count = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
};

Errors ErrorsOf(const Board& board, const BoardPoints& points, bool may_be_turned, double most) {
  Errors errors;
  EXPECT_EQ(points.size(), static_cast<size_t>(board.points_x) * board.points_y);
  for (size_t i = 0; i < points.size(); ++i) {
    if (!points[i]) continue;
    Eigen::Vector2d error = *points[i] - Projected(board, i, false);
    const Eigen::Vector2d turned = *points[i] - Projected(board, i, true);
    if (may_be_turned && turned.norm() < error.norm()) error = turned;
    EXPECT_LT(error.norm(), most) << i;
    ++errors.count;
    errors.mean += error;
  }
  errors.mean /= std::max(1, errors.count);
  return errors;
}

TEST_F(FindsBoards, ChessboardsWhereTheLensPutsThem) {
  const auto points = FindBoard(Photo(RectangularBoard(), 1), RectangularBoard());
  ASSERT_TRUE(points);
  const Errors errors = ErrorsOf(RectangularBoard(), *points, true, 0.2);
  EXPECT_EQ(errors.count, 70);
  EXPECT_LT(errors.mean.norm(), 0.03);  // no half pixel between OpenCV and us
}

TEST_F(FindsBoards, CountsOfAChessboardMayBeExchanged) {
  const Board turned{7, 10, 0.08, ""};
  for (const int photo : {1, 2, 4}) {
    const auto points = FindBoard(Photo(RectangularBoard(), photo), turned);
    ASSERT_TRUE(points);
    const Eigen::Vector2d x = *(*points)[6] - *(*points)[0], y = *(*points)[63] - *(*points)[0];
    EXPECT_GT(x.x() * y.y() - x.y() * y.x(), 0);  // never a mirror image
  }
}

TEST_F(FindsBoards, AnotherChessboardIsNotFound) {
  EXPECT_FALSE(FindBoard(Photo(RectangularBoard(), 1), Board{11, 8, 0.08, ""}));
}

// Markers tell which corner is which: nothing is turned.
TEST_F(FindsBoards, CharucoCornersByTheirMarkers) {
  const auto points = FindBoard(Photo(CharucoBoard(), 1), CharucoBoard());
  ASSERT_TRUE(points);
  const Errors errors = ErrorsOf(CharucoBoard(), *points, false, 0.3);
  EXPECT_EQ(errors.count, 35);
  EXPECT_LT(errors.mean.norm(), 0.05);
}

TEST_F(FindsBoards, APartOfACharucoBoardSuffices) {
  Raster photo = Photo(CharucoBoard(), 1);
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width / 2; ++x) photo.SetRgb(x, y, {0.2, 0.2, 0.2});
  }
  const auto points = FindBoard(photo, CharucoBoard());
  ASSERT_TRUE(points);
  const Errors errors = ErrorsOf(CharucoBoard(), *points, false, 0.3);
  EXPECT_GE(errors.count, 12);
  EXPECT_LE(errors.count, 20);
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width * 4 / 5; ++x) photo.SetRgb(x, y, {0.2, 0.2, 0.2});
  }
  EXPECT_FALSE(FindBoard(photo, CharucoBoard()));
}

TEST_F(FindsBoards, CirclesByTheirCentres) {
  const auto points = FindBoard(Photo(CirclesBoard(), 1), CirclesBoard());
  ASSERT_TRUE(points);
  const Errors errors = ErrorsOf(CirclesBoard(), *points, true, 0.3);
  EXPECT_EQ(errors.count, 54);
  EXPECT_LT(errors.mean.norm(), 0.05);
}

// Every second place of the grid is empty.
TEST_F(FindsBoards, AsymmetricCircles) {
  const auto points = FindBoard(Photo(AsymmetricCirclesBoard(), 1), AsymmetricCirclesBoard());
  ASSERT_TRUE(points);
  EXPECT_EQ(ErrorsOf(AsymmetricCirclesBoard(), *points, false, 0.3).count, 36);
  EXPECT_FALSE((*points)[1]);
  EXPECT_FALSE((*points)[8]);
}

TEST_F(FindsBoards, WhatOpenCvHasNotIsRefused) {
  Board board = CharucoBoard();
  board.dictionary = "DICT_9X9";
  EXPECT_EQ(InputErrorOf([&] { FindBoard(Raster(64, 48), board); }),
            "board.txt: \"DICT_9X9\" as dictionary, expected one of OpenCV's, as DICT_5X5_100");
  board = {29, 19, 0.02, "board.txt", BoardPattern::kCharuco, 0.015, "DICT_4X4_50"};
  EXPECT_EQ(InputErrorOf([&] { FindBoard(Raster(64, 48), board); }),
            "board.txt: DICT_4X4_50 has 50 markers, the board needs 300");
}

}  // namespace
}  // namespace insitu
