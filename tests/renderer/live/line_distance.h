// SPDX-License-Identifier: GPL-3.0-or-later
// How far a pixel lies from a line as the page is told of it.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <algorithm>
#include <limits>

namespace insitu {

// [px], from [[x, y]...]; infinite: it has fewer than two places.
inline double DistanceToLine(const Json::Value& line, const Eigen::Vector2d& pixel) {
  double least = std::numeric_limits<double>::infinity();
  for (Json::ArrayIndex i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector2d a(line[i][0].asDouble(), line[i][1].asDouble());
    const Eigen::Vector2d b(line[i + 1][0].asDouble(), line[i + 1][1].asDouble());
    const double share = std::clamp((pixel - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a + share * (b - a) - pixel).norm());
  }
  return least;
}

}  // namespace insitu
