// SPDX-License-Identifier: GPL-3.0-or-later
// Synthetic photographs of a chessboard, ray by ray, seen through a known lens.
#pragma once

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

// Writes eight photographs board_1.png ... board_8.png, the whole board visible in each.
void WriteBoardPhotos(const std::filesystem::path& folder, const Board& board = BoardPhotosBoard());

}  // namespace insitu
