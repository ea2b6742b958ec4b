// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calibration/boards/drawn_boards.h"

#include <cmath>
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

// Reflected light at a point of the board's plane [m]: white border two thirds of a square wide.
double BoardLight(const Board& board, double x, double y) {
  const int columns = board.interior_corners_x + 1, rows = board.interior_corners_y + 1;  // squares
  const double u = x / kSquare + columns / 2.0, v = y / kSquare + rows / 2.0;
  const double border = 2.0 / 3;
  if (std::min(u, v) < -border || u > columns + border || v > rows + border) return 0.2;
  if (std::min(u, v) < 0 || u >= columns || v >= rows) return 0.8;
  return (static_cast<int>(u) + static_cast<int>(v)) % 2 == 0 ? 0.05 : 0.8;
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
