// SPDX-License-Identifier: GPL-3.0-or-later
// The points of boards found in photographs, in the table that mrcal's programs read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/boards/board.h"

namespace insitu {

// Finds the board in every file of folder/photos and writes folder/corners.vnl, sorted by photo: a
// line "photo x y level" a point, "photo - - -" of a point that is not seen, and the one line
// "photo - -" where there is no board. A chessboard of as many corners each way is found by
// mrgingham, else, and every other board, by FindBoard. Throws InputError: an unreadable
// photograph, mrgingham missing or failing, what FindBoard refuses.
std::filesystem::path FindBoardCorners(const Board& board, const std::filesystem::path& folder);

// The photos, as the table names them, whose board was found.
std::vector<std::string> PhotosWithBoard(const std::filesystem::path& corners);

// Writes the part of a corner table that is of every second photo with a board, from the first
// (part 0) or from the second on (part 1).
void WriteHalf(const std::filesystem::path& corners, int part, const std::filesystem::path& half);

}  // namespace insitu
