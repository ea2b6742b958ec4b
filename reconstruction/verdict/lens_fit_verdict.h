// SPDX-License-Identifier: GPL-3.0-or-later
// Residuals as a function of radius and of place in the frame: those of a lens that fits have the
// mean zero everywhere.
#pragma once

#include <string>
#include <vector>

#include "calibration/program/finding.h"
#include "reconstruction/adjustment/adjusted_survey.h"

namespace insitu {

struct LensMisfit {
  int camera = 0;         // index into Adjustment::cameras
  std::string by;         // "radius" or "place in the frame"
  double statistic = 0;   // sum of squared means over their variances, of the a posteriori variance
  double limit = 0;       // that chance exceeds once in ten thousand
  double largest_px = 0;  // the largest mean residual of a ring or cell
  std::string where;      // in words
};

// One for each camera whose lens does not fit; cameras with few marks are not judged.
std::vector<LensMisfit> FindLensMisfits(const Adjustment& adjustment);

void JudgeLensFit(const Adjustment& adjustment, std::vector<Finding>* findings);

}  // namespace insitu
