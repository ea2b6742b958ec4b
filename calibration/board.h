// SPDX-License-Identifier: GPL-3.0-or-later
// Board calibration: photographs of a chessboard -> interior orientation, by mrcal's own programs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/camera.h"

namespace insitu {

// board.txt: one "key value" a line (type, interior_corners_x, interior_corners_y, square_m, note).
struct Board {
  int interior_corners_x = 0;
  int interior_corners_y = 0;
  double square_m = 0;
  std::filesystem::path path;  // where this was read, for messages
};
Board ReadBoard(const std::filesystem::path& path);  // throws InputError

struct BoardCalibrationOptions {
  std::string lens_model = "LENSMODEL_OPENCV8";
  double focal_px = 0;  // start value; 0: from EXIF, else a 50 degree field of view
};

struct ProjectionUncertainty {
  int columns = 0, rows = 0;
  std::vector<double> sigma_px;  // row-major over the frame, at infinity, worst direction
  double center_px = 0;          // at the image centre
};

struct BoardCalibration {
  std::filesystem::path model;  // the .cameramodel, optimization inputs and all
  std::string lens_model, splined_lens_model;
  int board_photos = 0, boards_found = 0;
  std::vector<std::string> not_found;  // the photos in which no board was found
  int points = 0, outliers = 0;        // corners used, corners refused
  double rms_px = 0;  // sqrt(sum |residual|^2 / points); mrcal prints it per coordinate, / sqrt(2)
  double worst_px = 0;                        // the largest |residual| of the points used
  ProjectionUncertainty uncertainty;          // of the lens model asked for
  ProjectionUncertainty splined_uncertainty;  // of mrcal's splined model on the same boards
  std::string BriefReport() const;
};

// Calibrates from `board_photos` with mrgingham and mrcal-calibrate-cameras. The model is written
// to `output_model`; corners, logs and the splined model stay in the folder boards/ beside it.
// Throws InputError: fewer than three boards found, photos of unequal size, a non-square board,
// mrcal's programs missing or failing.
BoardCalibration CalibrateFromBoards(const std::vector<std::filesystem::path>& board_photos,
                                     const Board& board, const std::filesystem::path& output_model,
                                     const BoardCalibrationOptions& options = {});

}  // namespace insitu
