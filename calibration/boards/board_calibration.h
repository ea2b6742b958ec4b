// SPDX-License-Identifier: GPL-3.0-or-later
// Board calibration: photographs of a board -> interior orientation, by mrcal's own programs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/boards/board.h"
#include "calibration/boards/lens_assessment.h"
#include "calibration/lens/projection_difference.h"

namespace insitu {

struct BoardCalibrationOptions {
  std::string lens_model = "LENSMODEL_OPENCV8";
  double focal_px = 0;  // start value; 0: from EXIF, else a 50 degree field of view

  // Throws CheckError that names the field: a name that is none of mrcal's models, a focal length
  // below 0 or not finite.
  void Check() const;
};

struct BoardCalibration {
  std::filesystem::path model;  // the .cameramodel, optimization inputs and all
  std::string lens_model, splined_lens_model;
  int board_photos = 0, boards_found = 0;
  std::vector<std::string> not_found;          // the photos in which no board was found
  LensAssessment lens;                         // of the lens model asked for
  LensAssessment splined;                      // of mrcal's splined model on the same boards
  ProjectionDifference splined_difference;     // between those two
  std::optional<ProjectionDifference> halves;  // between the lenses of two halves of the
                                               // boards; nullopt: fewer than six were found
  std::string BriefReport() const;
};

// Calibrates from `board_photos` with mrgingham or OpenCV's finders (FindBoardCorners) and
// mrcal-calibrate-cameras. The model is written to `output_model`; corners, logs and the other
// models stay in the folder boards/ beside it, where photos go by their number. Throws InputError:
// fewer than three boards found, photos of unequal size or unreadable, mrcal's programs missing or
// failing.
BoardCalibration CalibrateFromBoards(const std::vector<std::filesystem::path>& board_photos,
                                     const Board& board, const std::filesystem::path& output_model,
                                     const BoardCalibrationOptions& options = {});

}  // namespace insitu
