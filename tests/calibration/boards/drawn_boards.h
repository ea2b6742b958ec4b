// SPDX-License-Identifier: GPL-3.0-or-later
// Synthetic photographs of boards, ray by ray, seen through a known lens.
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "calibration/boards/board.h"
#include "calibration/lens/camera.h"

namespace insitu {

// 640x480 px, radial distortion.
Camera BoardPhotosLens();

// 10x10 interior corners, 0.08 m.
Board BoardPhotosBoard();

// 10x7, else the same.
Board RectangularBoard();

// 7x5 inner corners of 8x6 squares, 0.11 m, markers of DICT_4X4_50.
Board CharucoBoard();

// 9x6 circles, 0.09 m; 4 circles in each of 9 rows, 0.14 m.
Board CirclesBoard();
Board AsymmetricCirclesBoard();

// Where a point of the grid is, about the board's centre [m].
Eigen::Vector2d PlaceOf(const Board& board, size_t point);

// Board 1 looks straight at the board's middle at this place of the frame, from 1.35 m.
constexpr double kFirstBoardDistance = 1.35;  // [m]
inline const Eigen::Vector2d kFirstBoardPixel = {320, 240};

// Writes eight photographs board_1.png ... board_8.png, the whole board visible in each.
void WriteBoardPhotos(const std::filesystem::path& folder, const Board& board = BoardPhotosBoard());

}  // namespace insitu
