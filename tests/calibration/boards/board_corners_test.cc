// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/board_corners.h"

#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/boards/drawn_boards.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

class BoardCorners : public testing::Test {
 protected:
  BoardCorners() {
    fs::create_directories(folder_.path() / "photos");
    WriteBoardPhotos(folder_.path() / "photos", RectangularBoard());
  }
  Raster Photo(int number) {
    return ReadPhotograph(folder_.path() / ("photos/board_" + std::to_string(number) + ".png"))
        .linear;
  }
  ScratchFolder folder_;
};

// board_1 looks straight at the board's middle from 1.35 m: corners are known to the pixel.
TEST_F(BoardCorners, StandWhereTheLensPutsThem) {
  const auto corners = FindChessboard(Photo(1), RectangularBoard());
  ASSERT_TRUE(corners);
  ASSERT_EQ(corners->size(), 70u);
  const Camera lens = BoardPhotosLens();
  const Eigen::Vector3d center = 1.35 * lens.Unproject({320, 240});
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (size_t i = 0; i < corners->size(); ++i) {
    Eigen::Vector3d place = center;
    const size_t column = i % 10, row = i / 10;
    place.x() += 0.08 * (static_cast<double>(column) - 4.5);
    place.y() += 0.08 * (static_cast<double>(row) - 3.0);
    // From either end of the board: it looks the same upside down.
    const Eigen::Vector3d turned = center - (place - center);
    const Eigen::Vector2d off = (*corners)[i] - *lens.Project(place);
    const Eigen::Vector2d off_turned = (*corners)[i] - *lens.Project(turned);
    const Eigen::Vector2d& error = off.norm() < off_turned.norm() ? off : off_turned;
    EXPECT_LT(error.norm(), 0.2) << i;
    mean += error / static_cast<double>(corners->size());
  }
  EXPECT_LT(mean.norm(), 0.03);  // no half pixel between OpenCV and us
}

TEST_F(BoardCorners, CountsMayBeExchanged) {
  const Board turned{7, 10, 0.08, ""};
  for (const int photo : {1, 2, 4}) {
    const auto corners = FindChessboard(Photo(photo), turned);
    ASSERT_TRUE(corners);
    const Eigen::Vector2d x = (*corners)[6] - (*corners)[0], y = (*corners)[63] - (*corners)[0];
    EXPECT_GT(x.x() * y.y() - x.y() * y.x(), 0);  // never a mirror image
  }
}

TEST_F(BoardCorners, AnotherBoardIsNotFound) {
  EXPECT_FALSE(FindChessboard(Photo(1), Board{11, 8, 0.08, ""}));
}

TEST_F(BoardCorners, TableNamesEveryPhoto) {
  WritePng(folder_.path() / "photos/board_0.png", Raster(64, 48), Encoding::kSrgb8);
  const fs::path corners = FindBoardCorners(RectangularBoard(), folder_.path());
  const std::string table = ReadWhole(corners);
  EXPECT_NE(table.find("photos/board_0.png - -\n"), std::string::npos);
  EXPECT_EQ(PhotosWithBoard(corners).size(), 8u);
  WriteHalf(corners, 0, folder_.path() / "half.vnl");
  EXPECT_EQ(PhotosWithBoard(folder_.path() / "half.vnl"),
            (std::vector<std::string>{"photos/board_1.png", "photos/board_3.png",
                                      "photos/board_5.png", "photos/board_7.png"}));
}

}  // namespace
}  // namespace insitu
