// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/site_calibration.h"

#include <Eigen/Eigenvalues>

#include "calibration/calibration_report.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/lens/undistort.h"
#include "calibration/photo/photograph.h"
#include "calibration/site_undistortion.h"
#include "tests/calibration/boards/drawn_boards.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/calibration/program/drawn_page.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr char kBoard[] =
    "type chessboard\ninterior_corners_x 10\ninterior_corners_y 10\nsquare_m 0.08\n";

class Site : public testing::Test {
 protected:
  void BringCamera() {
    WritePosedCamera(site_.brought_camera(), {"", BoardPhotosLens(), Rigid3()}, "brought");
  }
  void AddPhoto(const std::string& name, int width = 640, int height = 480) {
    Raster photo(width, height);
    for (int x = 0; x < width; ++x) photo.SetRgb(x, height / 2, {0.5, 0.25, 1});
    WritePng(site_.photos() / name, photo, Encoding::kSrgb8);
  }
  ScratchFolder folder_;
  const SitePaths site_{folder_.path()};
};

TEST_F(Site, BoardsGiveTheLensBack) {
  WriteBoardPhotos(site_.boards());
  folder_.Write("calibration/board.txt", kBoard);
  const CameraCalibration calibration =
      CalibrateSite(site_, {.lens_model = "LENSMODEL_OPENCV4", .focal_px = 500}).cameras.front();
  ASSERT_TRUE(calibration.boards);
  EXPECT_EQ(calibration.boards->boards_found, 8);
  EXPECT_LT(calibration.lens->rms_px, 0.3);
  EXPECT_NEAR(calibration.camera.focal_px(), 560, 0.005 * 560);
  const Camera truth = BoardPhotosLens();
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(320, 240), Eigen::Vector2d(150, 120)}) {
    const double cosine = calibration.camera.Unproject(pixel).dot(truth.Unproject(pixel));
    EXPECT_LT(std::acos(std::min(cosine, 1.0)), 1.0 / 560);  // one pixel
  }

  const JsonNode report = JsonNode::Load(site_.calibration_report());
  EXPECT_EQ(report.At("source").Text(), "boards");
  EXPECT_EQ(report.At("boards_found").Integer(), 8);
  EXPECT_TRUE(report.At("boards_not_found").Items().empty());
  EXPECT_EQ(report.At("points").Integer() + report.At("outliers").Integer(), 800);
  const auto grid = report.At("uncertainty").At("sigma_px").Items();
  EXPECT_EQ(grid.size(), 9u);
  EXPECT_EQ(grid[0].Numbers().size(), 13u);
  // The splined model, with its many parameters, never claims to know more than the lean one.
  EXPECT_GT(report.At("splined_uncertainty").At("center_px").Number(),
            report.At("uncertainty").At("center_px").Number());
  EXPECT_NE(ReadWhole(site_.camera()).find("optimization_inputs"), std::string::npos);

  // The boards' own accounts add up, and their photographs are named.
  int corners = 0;
  for (const BoardView& board : calibration.lens->boards) {
    corners += board.corners;
    EXPECT_TRUE(board.photo.starts_with("board_")) << board.photo;
  }
  EXPECT_EQ(corners, report.At("points").Integer());
  EXPECT_NEAR(calibration.lens->boards[0].distance_m, 1.35, 0.02);
  EXPECT_LT(calibration.lens->boards[0].tilt_deg, 2);
  EXPECT_NEAR(calibration.lens->boards[1].tilt_deg, 29, 1);  // cos 0.5 cos 0.1

  // Two halves of eight boards: another lens, but not a wholly other one.
  EXPECT_GT(report.At("cross_validation").At("rms_px").Number(), 0);
  EXPECT_LT(report.At("cross_validation").At("rms_px").Number(), 10);

  const auto covariance = ReadIntrinsicsCovariance(site_, "");
  ASSERT_TRUE(covariance);
  ASSERT_EQ(covariance->rows(), 8);
  EXPECT_LT((*covariance - covariance->transpose()).norm(), 1e-9 * covariance->norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(*covariance).eigenvalues().minCoeff(),
            0);
  EXPECT_LT(std::abs(calibration.camera.focal_px() - 560), 5 * std::sqrt((*covariance)(0, 0)));

  const std::string page = ReadWhole(site_.calibration_page());
  EXPECT_NE(page.find("\"cross_validation\""), std::string::npos);
  const std::string drawn = Drawn(page);  // to its last section
  EXPECT_NE(drawn.find("<svg"), std::string::npos);
  EXPECT_NE(drawn.find("<h2>Interior orientation</h2>"), std::string::npos);

  // The same boards give the same bytes: no date, no random start.
  const std::string first = ReadWhole(site_.camera());
  CalibrateSite(site_, {.lens_model = "LENSMODEL_OPENCV4", .focal_px = 500});
  EXPECT_EQ(ReadWhole(site_.camera()), first);
}

// A brought model that holds its solution is assessed again, and gives the same covariance.
TEST_F(Site, RectangularBoardsAndABroughtSolution) {
  WriteBoardPhotos(site_.boards(), RectangularBoard());
  // Copied twice by a file manager, which puts blanks into names.
  for (const char number : {'1', '2', '3'}) {
    fs::rename(site_.boards() / (std::string("board_") + number + ".png"),
               site_.boards() / (std::string("board_ (") + number + ").png"));
  }
  folder_.Write("calibration/board.txt",
                "type chessboard\ninterior_corners_x 10\ninterior_corners_y 7\nsquare_m 0.08\n");
  const CameraCalibration made =
      CalibrateSite(site_, {.lens_model = "LENSMODEL_OPENCV4", .focal_px = 500}).cameras.front();
  EXPECT_EQ(made.boards->boards_found, 8);
  EXPECT_TRUE(made.boards->not_found.empty());
  ASSERT_EQ(made.lens->boards.size(), 8u);
  EXPECT_EQ(made.lens->boards[0].photo, "board_ (1).png");
  EXPECT_EQ(made.lens->boards[3].photo, "board_4.png");
  EXPECT_LT(made.lens->rms_px, 0.2);
  EXPECT_NEAR(made.camera.focal_px(), 560, 0.01 * 560);
  const auto covariance = ReadIntrinsicsCovariance(site_, "");
  ASSERT_TRUE(covariance);

  fs::copy_file(site_.camera(), site_.brought_camera());
  const CameraCalibration brought = CalibrateSite(site_).cameras.front();
  EXPECT_FALSE(brought.boards);
  ASSERT_TRUE(brought.lens);
  EXPECT_EQ(brought.lens->rms_px, made.lens->rms_px);
  EXPECT_EQ(brought.lens->boards[0].photo, "board 1");
  EXPECT_LT((*ReadIntrinsicsCovariance(site_, "") - *covariance).norm(), 1e-9 * covariance->norm());
}

// Half of the first photograph is covered: a part of a ChArUco board counts too.
TEST_F(Site, CharucoBoards) {
  WriteBoardPhotos(site_.boards(), CharucoBoard());
  const fs::path first = site_.boards() / "board_1.png";
  Raster photo = ReadPhotograph(first).linear;
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width / 2; ++x) photo.SetRgb(x, y, {0.2, 0.2, 0.2});
  }
  WritePng(first, photo, Encoding::kSrgb8);
  folder_.Write("calibration/board.txt",
                "type charuco\nsquares_x 8\nsquares_y 6\nsquare_m 0.11\nmarker_m 0.085\n"
                "dictionary DICT_4X4_50\n");
  const CameraCalibration made =
      CalibrateSite(site_, {.lens_model = "LENSMODEL_OPENCV4", .focal_px = 500}).cameras.front();
  EXPECT_EQ(made.boards->boards_found, 8);
  ASSERT_EQ(made.lens->boards.size(), 8u);
  EXPECT_EQ(made.lens->boards[0].photo, "board_1.png");
  EXPECT_LT(made.lens->boards[0].corners, 21);
  EXPECT_LT(made.lens->outliers, 5);
  EXPECT_LT(made.lens->rms_px, 0.25);
  EXPECT_NEAR(made.camera.focal_px(), 560, 0.01 * 560);
}

TEST_F(Site, SquaresCountedForCorners) {
  WriteBoardPhotos(site_.boards(), RectangularBoard());
  folder_.Write("calibration/board.txt",
                "type chessboard\ninterior_corners_x 11\ninterior_corners_y 8\nsquare_m 0.08\n");
  EXPECT_EQ(
      InputErrorOf([&] { CalibrateSite(site_); }),
      site_.boards().string() +
          ": whole boards found in 0 of 8 photos, expected at least 3; board_1.png shows a board "
          "of 10x7 interior corners: board.txt must count interior corners, not squares");
}

TEST_F(Site, BroughtCameraIsTakenAsItIs) {
  BringCamera();
  const CameraCalibration calibration = CalibrateSite(site_).cameras.front();
  EXPECT_FALSE(calibration.boards);
  EXPECT_FALSE(ReadIntrinsicsCovariance(site_, ""));
  EXPECT_EQ(ReadWhole(site_.camera()), ReadWhole(site_.brought_camera()));
  EXPECT_EQ(JsonNode::Load(site_.calibration_report()).At("source").Text(), "brought");
}

TEST_F(Site, BadBroughtCameraWritesNothing) {
  folder_.Write("calibration/camera.cameramodel", "garbled");
  EXPECT_EQ(InputErrorOf([&] { CalibrateSite(site_); }).find(site_.brought_camera().string()), 0u);
  EXPECT_FALSE(fs::exists(folder_.path() / "work"));
}

TEST_F(Site, NeitherCameraNorBoards) {
  EXPECT_EQ(InputErrorOf([&] { CalibrateSite(site_); }),
            site_.boards().string() +
                ": no calibration, expected camera.cameramodel, or board_* photos and board.txt");
}

TEST_F(Site, UndistortsEveryPhotograph) {
  BringCamera();
  CalibrateSite(site_);
  AddPhoto("b.png");
  AddPhoto("a.png");
  const SiteUndistortion result = UndistortSite(site_);
  EXPECT_EQ(result.photos, 2);
  EXPECT_EQ(ReadCamera(site_.pinhole_camera()).intrinsics(), result.pinholes[0].intrinsics());
  const Photograph input = ReadPhotograph(site_.input_image("a"));
  EXPECT_EQ(input.encoding, Encoding::kLinear);
  const Raster original = ReadPhotograph(site_.photos() / "a.png").linear;
  EXPECT_EQ(input.linear.data, Reproject(original, BoardPhotosLens(), result.pinholes[0]).data);
}

TEST_F(Site, PhotographOfAnotherSizeStopsBeforeAnyIsWritten) {
  BringCamera();
  CalibrateSite(site_);
  AddPhoto("a.png");
  AddPhoto("b.png", 480, 640);
  EXPECT_EQ(InputErrorOf([&] { UndistortSite(site_); }),
            (site_.photos() / "b.png").string() +
                ": is 480x640 px, expected 640x480 px as its camera was calibrated");
  EXPECT_FALSE(fs::exists(site_.input_image("a")));
}

TEST_F(Site, UndistortNeedsTheCalibration) {
  AddPhoto("a.png");
  EXPECT_EQ(InputErrorOf([&] { UndistortSite(site_); }),
            site_.camera().string() + ": no such file, expected insitu-calibrate to have made it");
}

TEST_F(Site, ListsPhotographsByName) {
  AddPhoto("c.png");
  AddPhoto("a.PNG");
  folder_.Write("photos/b.JPG", "");
  folder_.Write("photos/.hidden.jpg", "");
  folder_.Write("photos/notes.txt", "");
  const std::vector<fs::path> expected = {site_.photos() / "a.PNG", site_.photos() / "b.JPG",
                                          site_.photos() / "c.png"};
  EXPECT_EQ(ListPhotographs(site_), expected);
}

TEST_F(Site, FaultsOfThePhotosFolder) {
  EXPECT_EQ(InputErrorOf([&] { ListPhotographs(site_); }),
            site_.photos().string() + ": no such folder, expected the site's photographs in it");
  fs::create_directories(site_.photos());
  EXPECT_EQ(
      InputErrorOf([&] { ListPhotographs(site_); }),
      site_.photos().string() + ": no photographs, expected JPEG, PNG, TIFF, EXR or raw files");
  folder_.Write("photos/a.jpg", "");
  folder_.Write("photos/a.png", "");
  EXPECT_EQ(InputErrorOf([&] { ListPhotographs(site_); }),
            (site_.photos() / "a.png").string() +
                ": has the same name as a.jpg, expected each photograph's name once");
}

}  // namespace
}  // namespace insitu
