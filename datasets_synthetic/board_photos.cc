// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/board_photos.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibration/files/error.h"
#include "datasets_synthetic/random.h"

namespace insitu::demo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHalfBoard = 0.5 * (kBoardCorners + 1) * kBoardSquare;  // [m], squares
constexpr double kBorder = 0.07;                                         // [m], white

// How one photograph was taken: where in the frame the board's centre should lie (it is pushed
// inwards until the whole board shows), how far away, and its turn about the camera's axes.
struct BoardPose {
  double column, row;  // share of the frame
  double distance;     // [m]
  double turn_x_deg, turn_y_deg, turn_z_deg;
};

const std::vector<BoardPose>& Poses() {
  static const std::vector<BoardPose> poses = {
      {0.50, 0.50, 1.75, 22, 0, 3},    {0.50, 0.50, 1.80, -24, 8, -4}, {0.45, 0.50, 1.85, 6, 30, 5},
      {0.56, 0.50, 1.85, -5, -31, -6}, {0, 0, 2.35, 18, 24, 4},        {1, 0, 2.35, 17, -25, -5},
      {0, 1, 2.35, -19, 23, -3},       {1, 1, 2.35, -18, -24, 6},      {0, 0, 2.60, -12, -20, 2},
      {1, 0, 2.60, -14, 19, -2},       {0, 1, 2.60, 15, -21, -2},      {1, 1, 2.60, 13, 22, 1},
      {0.50, 0, 2.30, 24, 10, 15},     {0.50, 1, 2.30, -26, -10, -20}, {0, 0.50, 2.10, 5, -34, 12},
      {1, 0.50, 2.10, -6, 34, -12}};
  return poses;
}

struct PlacedBoard {
  Eigen::Matrix3d cam_from_board;
  Vector3d center;  // camera frame
};

Eigen::AlignedBox2d Outline(const Lens& lens, const PlacedBoard& board) {
  Eigen::AlignedBox2d outline;
  for (const double u : {-1.0, 1.0}) {
    for (const double v : {-1.0, 1.0}) {
      const Vector3d corner = (kHalfBoard + kBorder) * Vector3d(u, v, 0);
      const auto pixel = Project(lens, board.cam_from_board * corner + board.center);
      INSITU_CHECK(pixel.has_value());
      outline.extend(*pixel);
    }
  }
  return outline;
}

PlacedBoard PlaceBoard(const Lens& lens, const BoardPose& pose) {
  const Vector2d low(4, 4), high(lens.width - 5, lens.height - 5);  // the margin kept
  const Eigen::Matrix3d turned = (Eigen::AngleAxisd(pose.turn_x_deg * kDegree, Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(pose.turn_y_deg * kDegree, Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(pose.turn_z_deg * kDegree, Vector3d::UnitZ()))
                                     .toRotationMatrix();
  Vector2d pixel(pose.column * (lens.width - 1), pose.row * (lens.height - 1));
  PlacedBoard board{turned, Vector3d::Zero()};
  for (int i = 0; i < 20; ++i) {
    const Vector2d seen((pixel.x() - lens.center_x) / lens.focal_x,
                        (pixel.y() - lens.center_y) / lens.focal_y);
    board.center = pose.distance * Undistort(lens, seen).homogeneous();
    const Eigen::AlignedBox2d outline = Outline(lens, board);
    pixel += (low - outline.min()).cwiseMax(0) - (outline.max() - high).cwiseMax(0);
  }
  const Eigen::AlignedBox2d outline = Outline(lens, board);
  INSITU_CHECK(outline.min().minCoeff() > 2 && (outline.max() - high).maxCoeff() < 2);
  return board;
}

// Position on the board's plane [m] of a sight.
Vector2d OnBoard(const PlacedBoard& board, const Vector2d& tangents) {
  const Vector3d direction = board.cam_from_board.transpose() * tangents.homogeneous();
  const Vector3d origin = -(board.cam_from_board.transpose() * board.center);
  return (origin - origin.z() / direction.z() * direction).head<2>();
}

double Reflectance(const Vector2d& at) {
  const double reach = at.cwiseAbs().maxCoeff();
  if (reach > kHalfBoard + kBorder) return 0.22;  // the room behind
  if (reach > kHalfBoard) return 0.78;
  const Eigen::Array2d square = ((at.array() + kHalfBoard) / kBoardSquare).floor();
  return static_cast<int>(square.sum()) % 2 == 0 ? 0.04 : 0.78;
}

double PixelValue(const PlacedBoard& board, const SightTable& sights, int x, int y) {
  constexpr int kGrid = 4;
  double sum = 0;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const int column = i % kGrid, row = i / kGrid;
    const Vector2d offset((column + 0.5) / kGrid - 0.5, (row + 0.5) / kGrid - 0.5);
    sum += Reflectance(OnBoard(board, sights.Tangents(Vector2d(x, y) + offset)));
  }
  return sum / (kGrid * kGrid);
}

Raster BoardPhoto(const Lens& lens, const SightTable& sights, const PlacedBoard& board,
                  uint64_t number) {
  constexpr double kNoise = 0.004;
  Raster photo(lens.width, lens.height);
  tbb::parallel_for(0, lens.height, [&](int y) {
    Random random(number, 5, y);
    for (int x = 0; x < lens.width; ++x) {
      const double window = 0.85 + 0.2 * (x - 0.6 * y) / lens.width;  // light from one side
      const double value = window * PixelValue(board, sights, x, y) + kNoise * random.Gaussian();
      photo.SetRgb(x, y, Vector3d::Constant(std::clamp(value, 0.0, 1.0)));
    }
  });
  return photo;
}

}  // namespace

std::vector<Raster> BoardPhotos(const Lens& lens) {
  const SightTable sights(lens);
  std::vector<Raster> photos;
  for (const BoardPose& pose : Poses()) {
    const PlacedBoard board = PlaceBoard(lens, pose);
    photos.push_back(BoardPhoto(lens, sights, board, photos.size()));
  }
  return photos;
}

}  // namespace insitu::demo
