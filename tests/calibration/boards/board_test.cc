// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/boards/board.h"

#include "calibration/boards/board_calibration.h"
#include "calibration/photo/photograph.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

constexpr char kBoard[] =
    "type chessboard\n"
    "interior_corners_x 10\n"
    "interior_corners_y 9\r\n"
    "# a remark\n"
    "\n"
    "square_m 0.080\n"
    "note flat to 0.1 mm; same focus\n";

class BoardFile : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& text) { return folder_.Write("board.txt", text); }
  std::string ErrorOf(const std::string& from, const std::string& to) {
    std::string text = kBoard;
    text.replace(text.find(from), from.size(), to);
    const auto path = Write(text);
    const std::string message = InputErrorOf([&] { ReadBoard(path); });
    EXPECT_EQ(message.find(path.string()), 0u) << message;
    return message.substr(path.string().size());
  }
  ScratchFolder folder_;
};

TEST_F(BoardFile, ReadsItsKeys) {
  const Board board = ReadBoard(Write(kBoard));
  EXPECT_EQ(board.points_x, 10);
  EXPECT_EQ(board.points_y, 9);
  EXPECT_EQ(board.spacing_m, 0.08);
}

TEST_F(BoardFile, FaultsNameTheLine) {
  EXPECT_EQ(
      ErrorOf("chessboard", "checkers"),
      ":1: \"checkers\" as type, expected chessboard, charuco, circles or asymmetric_circles");
  EXPECT_EQ(ErrorOf("0.080", "-1"), ":6: \"-1\" as square_m, expected a positive number");
  EXPECT_EQ(ErrorOf("0.080", "nan"), ":6: \"nan\" as square_m, expected a positive number");
  EXPECT_EQ(ErrorOf("0.080", "8 cm"), ":6: \"8 cm\" as square_m, expected a positive number");
  EXPECT_EQ(ErrorOf("_x 10", "_x 10.5"),
            ":2: \"10.5\" as interior_corners_x, expected a positive number");
  EXPECT_EQ(ErrorOf("_x 10", "_x"), ":2: \"\" as interior_corners_x, expected a positive number");
  EXPECT_EQ(ErrorOf("note flat", "square_m 0.08"), ":7: square_m stands twice, expected it once");
  EXPECT_EQ(ErrorOf("square_m", "square_mm"),
            ":6: \"square_mm\" is unknown, expected type, interior_corners_x, interior_corners_y, "
            "square_m or note");
  EXPECT_EQ(ErrorOf("square_m 0.080\n", ""), ": square_m is missing");
}

TEST_F(BoardFile, EveryTypeHasItsKeys) {
  const Board charuco = ReadBoard(
      Write("type charuco\nsquares_x 8\nsquares_y 6\nsquare_m 0.04\nmarker_m 0.03\ndictionary "
            "DICT_5X5_100\n"));
  EXPECT_EQ(charuco.pattern, BoardPattern::kCharuco);
  EXPECT_EQ(charuco.points_x, 7);
  EXPECT_EQ(charuco.points_y, 5);
  EXPECT_EQ(charuco.spacing_m, 0.04);
  EXPECT_EQ(charuco.marker_m, 0.03);
  EXPECT_EQ(charuco.dictionary, "DICT_5X5_100");
  const Board circles =
      ReadBoard(Write("type circles\ncircles_x 9\ncircles_y 6\nspacing_m 0.02\n"));
  EXPECT_EQ(circles.pattern, BoardPattern::kCircles);
  EXPECT_EQ(circles.points_x, 9);
  EXPECT_EQ(circles.spacing_m, 0.02);
  const Board asymmetric =
      ReadBoard(Write("type asymmetric_circles\ncircles_x 4\ncircles_y 11\nspacing_m 0.04\n"));
  EXPECT_EQ(asymmetric.pattern, BoardPattern::kAsymmetricCircles);
  EXPECT_EQ(asymmetric.points_x, 8);
  EXPECT_EQ(asymmetric.points_y, 11);
  EXPECT_EQ(asymmetric.spacing_m, 0.02);
  EXPECT_NE(InputErrorOf([&] {
              ReadBoard(
                  Write("type charuco\nsquares_x 8\nsquares_y 6\nsquare_m 0.04\nmarker_m "
                        "0.04\ndictionary DICT_5X5_100\n"));
            }).find(":5: marker_m is not smaller than square_m"),
            std::string::npos);
  EXPECT_NE(InputErrorOf([&] {
              ReadBoard(Write("type circles\ncircles_x 9\ncircles_y 6\nsquare_m 0.02\n"));
            }).find(":4: \"square_m\" is unknown, expected type, circles_x, circles_y, spacing_m"),
            std::string::npos);
}

TEST_F(BoardFile, Missing) {
  const auto path = folder_.path() / "none.txt";
  const std::string expected =
      path.string() + ": no such file, expected it beside the board photos";
  EXPECT_EQ(InputErrorOf([&] { ReadBoard(path); }).find(expected), 0u);
}

class BoardPhotos : public testing::Test {
 protected:
  std::filesystem::path BlankPhoto(const std::string& name, int width) {
    const auto path = folder_.path() / name;
    WritePng(path, Raster(width, 48), Encoding::kSrgb8);
    return path;
  }
  ScratchFolder folder_;
  const std::filesystem::path model_ = folder_.path() / "work/camera.cameramodel";
};

TEST_F(BoardPhotos, UnequalSizes) {
  const std::vector<std::filesystem::path> photos = {BlankPhoto("a.png", 64),
                                                     BlankPhoto("b.png", 65)};
  EXPECT_EQ(InputErrorOf([&] {
              CalibrateFromBoards(photos, {10, 10, 0.08, ""}, model_);
            }),
            photos[1].string() +
                ": is 65x48 px, expected 64x48 px as a.png; boards of another camera or another "
                "format belong in a folder of their own");
}

TEST_F(BoardPhotos, TooFewBoardsFound) {
  const std::vector<std::filesystem::path> photos = {BlankPhoto("a.png", 64),
                                                     BlankPhoto("b.png", 64)};
  EXPECT_EQ(InputErrorOf([&] {
              CalibrateFromBoards(photos, {10, 10, 0.08, ""}, model_);
            }),
            folder_.path().string() +
                ": whole boards found in 0 of 2 photos, expected at least 3; each photo must show "
                "the whole board with its white border, sharp, and board.txt must count its "
                "interior corners; a lens needs 20 to 40 photos of the board: near, tilted, and "
                "into every corner of the frame");
  EXPECT_FALSE(std::filesystem::exists(model_));
}

TEST_F(BoardPhotos, OnePhoto) {
  const auto photo = BlankPhoto("a.png", 64);
  const std::string message = InputErrorOf([&] {
    CalibrateFromBoards({photo}, {7, 5, 0.08, ""}, model_);
  });
  EXPECT_EQ(message.find(folder_.path().string() + ": whole boards found in 0 of 1 photos, "), 0u)
      << message;
  EXPECT_NE(message.find("a lens needs 20 to 40"), std::string::npos) << message;
}

TEST_F(BoardPhotos, APngThatIsNone) {
  const auto photo = folder_.Write("a.png", "no picture");
  EXPECT_EQ(InputErrorOf([&] {
              CalibrateFromBoards({photo}, {7, 5, 0.08, ""}, model_);
            }).find(photo.string() + ": not a readable image"),
            0u);
}

}  // namespace
}  // namespace insitu
