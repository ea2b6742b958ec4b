// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/board_corners.h"

#include <algorithm>

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
  ScratchFolder folder_;
};

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

// A board of which the first corner is hidden is a board all the same.
TEST_F(BoardCorners, PointsThatAreNotSeenKeepTheirLine) {
  fs::remove_all(folder_.path() / "photos");
  fs::create_directories(folder_.path() / "photos");
  WriteBoardPhotos(folder_.path() / "photos", CharucoBoard());
  const fs::path first = folder_.path() / "photos/board_1.png";
  Raster photo = ReadPhotograph(first).linear;
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width / 2; ++x) photo.SetRgb(x, y, {0.2, 0.2, 0.2});
  }
  WritePng(first, photo, Encoding::kSrgb8);
  const fs::path corners = FindBoardCorners(CharucoBoard(), folder_.path());
  const std::string table = ReadWhole(corners);
  EXPECT_NE(table.find("photos/board_1.png - - -\n"), std::string::npos);
  EXPECT_EQ(PhotosWithBoard(corners).size(), 8u);
  EXPECT_EQ(std::ranges::count(table, '\n'), 1 + 8 * 35);
}

}  // namespace
}  // namespace insitu
