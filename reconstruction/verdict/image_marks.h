// SPDX-License-Identifier: GPL-3.0-or-later
// The marks of an adjustment, x and y together again, tie points' among them.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reconstruction/adjustment/adjusted_survey.h"

namespace insitu {

struct ImageMark {
  int photo = 0;  // index into Adjustment::poses
  std::string point;
  Eigen::Vector2d pixel;     // as observed
  Eigen::Vector2d residual;  // [px], adjusted - observed
  std::optional<double> w;   // the larger |w| of its two; nullopt: not controlled
  bool is_tie_point = false;
};

// In the order of Adjustment::residuals.
std::vector<ImageMark> ImageMarks(const Adjustment& adjustment);

// The largest angle between the rays to each point that is marked twice or more [rad].
std::map<std::string, double> LargestRayAngles(const Adjustment& adjustment,
                                               const std::vector<ImageMark>& marks);

}  // namespace insitu
