// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calibration/boards/drawn_boards.h"

#include <algorithm>
#include <cmath>
#include <opencv2/aruco/charuco.hpp>
#include <string>
#include <vector>

#include "calibration/lens/sight_map.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

constexpr double kSquare = 0.08;  // [m]
constexpr int kSamples = 4;       // per pixel and direction

// Where the board's centre appears, how far away, and how it is turned.
struct View {
  double pixel_x, pixel_y, distance, tilt_x, tilt_y, roll;
};

constexpr View kViews[] = {
    {320, 240, 1.35, 0.0, 0.0, 0.0},   {320, 240, 1.45, 0.5, 0.1, 0.2},
    {250, 230, 1.60, -0.5, 0.3, 0.1},  {390, 250, 1.60, 0.2, -0.6, -0.2},
    {190, 190, 1.90, 0.3, 0.5, 0.0},   {450, 190, 1.90, 0.3, -0.4, 0.1},
    {190, 290, 1.90, -0.4, 0.4, -0.1}, {450, 290, 1.90, -0.3, -0.5, 0.0},
};

Rigid3 CamFromBoard(const View& view) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(view.tilt_x, Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(view.tilt_y, Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(view.roll, Eigen::Vector3d::UnitZ()));
  return {turn, view.distance * BoardPhotosLens().Unproject({view.pixel_x, view.pixel_y})};
}

constexpr double kWhite = 0.8, kBlack = 0.05, kGround = 0.2;
constexpr int kMarkerPixels = 60;  // of a square, of the drawn ChArUco board

double ChessboardLight(const Board& board, double x, double y) {
  const int columns = board.points_x + 1, rows = board.points_y + 1;  // squares
  const double u = x / board.spacing_m + columns / 2.0, v = y / board.spacing_m + rows / 2.0;
  if (std::min(u, v) < 0 || u >= columns || v >= rows) return kWhite;
  return (static_cast<int>(u) + static_cast<int>(v)) % 2 == 0 ? kBlack : kWhite;
}

// As OpenCV draws it.
double CharucoLight(const Board& board, double x, double y) {
  static const cv::Mat drawn = [&] {
    const auto charuco = cv::aruco::CharucoBoard::create(
        board.points_x + 1, board.points_y + 1, static_cast<float>(board.spacing_m),
        static_cast<float>(board.marker_m),
        cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50));
    cv::Mat image;
    charuco->draw({(board.points_x + 1) * kMarkerPixels, (board.points_y + 1) * kMarkerPixels},
                  image);
    return image;
  }();
  const double u = x / board.spacing_m + (board.points_x + 1) / 2.0;
  const double v = y / board.spacing_m + (board.points_y + 1) / 2.0;
  const int column = static_cast<int>(std::floor(u * kMarkerPixels));
  const int row = static_cast<int>(std::floor(v * kMarkerPixels));
  if (std::min(column, row) < 0 || column >= drawn.cols || row >= drawn.rows) return kWhite;
  return drawn.at<uchar>(row, column) > 127 ? kWhite : kBlack;
}

double CirclesLight(const Board& board, double x, double y) {
  const bool is_asymmetric = board.pattern == BoardPattern::kAsymmetricCircles;
  const double radius = (is_asymmetric ? 0.45 : 0.3) * board.spacing_m;
  for (size_t i = 0; i < static_cast<size_t>(board.points_x) * board.points_y; ++i) {
    const size_t column = i % board.points_x, row = i / board.points_x;
    if (is_asymmetric && column % 2 != row % 2) continue;
    if ((PlaceOf(board, i) - Eigen::Vector2d(x, y)).norm() < radius) return kBlack;
  }
  return kWhite;
}

// Reflected light at a point of the board's plane [m]: white border two thirds of a square wide.
double BoardLight(const Board& board, double x, double y) {
  const double border = (0.5 + 1.0 / 6) * board.spacing_m;
  const double half_x = board.points_x / 2.0 * board.spacing_m + border;
  const double half_y = board.points_y / 2.0 * board.spacing_m + border;
  if (std::abs(x) > half_x + board.spacing_m / 2 || std::abs(y) > half_y + board.spacing_m / 2)
    return kGround;
  switch (board.pattern) {
    case BoardPattern::kChessboard:
      return ChessboardLight(board, x, y);
    case BoardPattern::kCharuco:
      return CharucoLight(board, x, y);
    default:
      return CirclesLight(board, x, y);
  }
}

double LightOfPixel(const Board& board, const SightMap& sights, const Rigid3& board_from_cam, int x,
                    int y) {
  double sum = 0;
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const int column = i % kSamples, row = i / kSamples;
    const Eigen::Vector2d offset((column + 0.5) / kSamples, (row + 0.5) / kSamples);
    const Eigen::Vector3d sight =
        board_from_cam.rotation * sights.Direction(Eigen::Vector2d(x - 0.5, y - 0.5) + offset);
    const Eigen::Vector3d& center = board_from_cam.translation;
    const Eigen::Vector3d hit = center - center.z() / sight.z() * sight;
    sum += BoardLight(board, hit.x(), hit.y());
  }
  return sum / (kSamples * kSamples);
}

}  // namespace

Camera BoardPhotosLens() {
  return Camera("LENSMODEL_OPENCV4", {560, 560, 322, 237, -0.12, 0.02, 0, 0}, 640, 480);
}

Board BoardPhotosBoard() { return {10, 10, kSquare, "board.txt"}; }

Board RectangularBoard() { return {10, 7, kSquare, "board.txt"}; }

Board CharucoBoard() {
  return {7, 5, 0.11, "board.txt", BoardPattern::kCharuco, 0.085, "DICT_4X4_50"};
}

Board CirclesBoard() { return {9, 6, 0.09, "board.txt", BoardPattern::kCircles}; }

Board AsymmetricCirclesBoard() {
  return {8, 9, 0.07, "board.txt", BoardPattern::kAsymmetricCircles};
}

Eigen::Vector2d PlaceOf(const Board& board, size_t point) {
  const auto column = static_cast<double>(point % board.points_x);
  const auto row = static_cast<double>(point / board.points_x);
  return board.spacing_m *
         Eigen::Vector2d(column - (board.points_x - 1) / 2.0, row - (board.points_y - 1) / 2.0);
}

void WriteBoardPhotos(const std::filesystem::path& folder, const Board& board) {
  const Camera lens = BoardPhotosLens();
  const SightMap sights(lens);
  int number = 0;
  for (const View& view : kViews) {
    const Rigid3 board_from_cam = Inverse(CamFromBoard(view));
    Raster photo(lens.width(), lens.height());
    for (int y = 0; y < photo.height; ++y) {
      for (int x = 0; x < photo.width; ++x) {
        const double light = LightOfPixel(board, sights, board_from_cam, x, y);
        photo.SetRgb(x, y, Eigen::Vector3d::Constant(light));
      }
    }
    WritePng(folder / ("board_" + std::to_string(++number) + ".png"), photo, Encoding::kSrgb8);
  }
}

}  // namespace insitu
