// SPDX-License-Identifier: GPL-3.0-or-later
// Finding a board's points in a photograph, by OpenCV.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/boards/board.h"
#include "calibration/photo/raster.h"

namespace insitu {

// The board's points in one photograph, row by row, board.points_x of them in a row [px]; nullopt:
// a point that is not seen, or that the grid of asymmetric circles leaves empty.
using BoardPoints = std::vector<std::optional<Eigen::Vector2d>>;

// nullopt: the board is not seen. `linear` as ReadPhotograph gives it.
// A chessboard must be seen whole: by the sector based finder [Duda & Frese 2018], else by OpenCV's
// older one; x to y turns as the photograph's x to y does. Circles must be seen whole too, dark on
// light or light on dark; their centres are those of the blobs, which a steep view puts beside the
// circles' own. Of a ChArUco board [Garrido-Jurado et al. 2014] a part suffices: eight corners of
// two rows and two columns. Throws InputError: a dictionary that OpenCV has not, or one of too few
// markers.
std::optional<BoardPoints> FindBoard(const Raster& linear, const Board& board);

}  // namespace insitu
