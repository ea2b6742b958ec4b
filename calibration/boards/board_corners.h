// SPDX-License-Identifier: GPL-3.0-or-later
// Finding the corners of a chessboard in photographs, in the table that mrcal's programs read.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calibration/boards/board.h"
#include "calibration/photo/raster.h"

namespace insitu {

// The interior corners of one photograph, row by row, board.interior_corners_x of them in a row, so
// that x to y turns as the photograph's x to y does [px]; nullopt: not all of them are seen. By
// OpenCV's sector based finder [Duda & Frese 2018], else by its older one. `linear` as
// ReadPhotograph gives it.
std::optional<std::vector<Eigen::Vector2d>> FindChessboard(const Raster& linear,
                                                           const Board& board);

// Finds the board in every file of folder/photos and writes folder/corners.vnl ("photo x y level"
// or "photo - -", sorted by photo): mrgingham's corners of a square board, FindChessboard's of
// another. `while_running` is called while mrgingham works. Throws InputError: an unreadable
// photograph, mrgingham missing or failing.
std::filesystem::path FindBoardCorners(const Board& board, const std::filesystem::path& folder,
                                       const std::function<void()>& while_running = {});

// The photos, as the table names them, whose board was found.
std::vector<std::string> PhotosWithBoard(const std::filesystem::path& corners);

// Writes the part of a corner table that is of every second photo with a board, from the first
// (part 0) or from the second on (part 1).
void WriteHalf(const std::filesystem::path& corners, int part, const std::filesystem::path& half);

}  // namespace insitu
