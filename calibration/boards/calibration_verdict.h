// SPDX-License-Identifier: GPL-3.0-or-later
// What a calibration is worth, in words, and what to photograph again.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/boards/board_calibration.h"
#include "calibration/program/finding.h"

namespace insitu {

// Empty: a good calibration. `size` of the photographs [px]. Judged are the boards' number, spread
// over the frame, tilts and distances; RMS and outliers; the two halves of the boards against each
// other and the lens model against the splined one, both where boards were seen and in proportion
// to the expected uncertainty.
std::vector<Finding> JudgeBoards(const BoardCalibration& calibration, const Eigen::Vector2i& size);

// The same for a solution that was brought, without its boards' photographs.
std::vector<Finding> JudgeLens(const LensAssessment& lens, const Eigen::Vector2i& size);

}  // namespace insitu
