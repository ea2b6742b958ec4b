// SPDX-License-Identifier: GPL-3.0-or-later
// The board that a camera is calibrated with: a flat grid of points that can be found.
#pragma once

#include <filesystem>
#include <string>

namespace insitu {

enum class BoardPattern { kChessboard, kCharuco, kCircles, kAsymmetricCircles };

// board.txt: one "key value" a line; `type`, `note`, and by type:
// - chessboard: interior_corners_x, interior_corners_y, square_m. Interior corners are those where
//   four squares meet: one less than squares, each way. Which count stands first does not matter.
// - charuco: squares_x, squares_y, square_m, marker_m, dictionary (OpenCV's, as DICT_5X5_100).
//   Drawn as OpenCV 4.6 and later do: the second square of the first row has a marker.
// - circles: circles_x, circles_y, spacing_m between centres.
// - asymmetric_circles: circles_x in a row, spacing_m apart; circles_y rows, half of that apart,
//   each second one half of it aside.
struct Board {
  // The grid of points; of asymmetric circles twice as many columns as circles, every second one
  // empty.
  int points_x = 0;
  int points_y = 0;
  double spacing_m = 0;        // of this grid
  std::filesystem::path path;  // where this was read, for messages
  BoardPattern pattern = BoardPattern::kChessboard;
  double marker_m = 0;  // of charuco
  std::string dictionary = {};
};
Board ReadBoard(const std::filesystem::path& path);  // throws InputError

}  // namespace insitu
