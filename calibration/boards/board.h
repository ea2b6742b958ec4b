// SPDX-License-Identifier: GPL-3.0-or-later
// The chessboard that a camera is calibrated with.
#pragma once

#include <filesystem>

namespace insitu {

// board.txt: one "key value" a line (type, interior_corners_x, interior_corners_y, square_m, note).
// Interior corners are those where four squares meet: one less than squares, each way. Which count
// stands first does not matter, a board may be turned.
struct Board {
  int interior_corners_x = 0;
  int interior_corners_y = 0;
  double square_m = 0;
  std::filesystem::path path;  // where this was read, for messages
};
Board ReadBoard(const std::filesystem::path& path);  // throws InputError

}  // namespace insitu
