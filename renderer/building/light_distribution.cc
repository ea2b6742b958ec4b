// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/light_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insitu {
namespace {

struct Between {
  size_t low = 0, high = 0;
  double share = 0;  // of high
};

// Between rising angles; beyond them the nearest.
Between Place(const std::vector<double>& angles, double angle) {
  const auto above = std::ranges::lower_bound(angles, angle);
  if (above == angles.begin()) return {};
  const auto high = static_cast<size_t>(above - angles.begin());
  if (above == angles.end()) return {high - 1, high - 1, 0};
  const double width = angles[high] - angles[high - 1];
  return {high - 1, high, width > 0 ? (angle - angles[high - 1]) / width : 0};
}

// C in the range that the table covers, by the symmetry that its last angle states (LM-63).
double FoldedC(double c, const std::vector<double>& angles) {
  const double last = angles.back();
  if (angles.size() == 1) return angles.front();
  if (last <= 90) c = c <= 180 ? c : 360 - c, c = c <= 90 ? c : 180 - c;
  if (last > 90 && last <= 180) c = c <= 180 ? c : 360 - c;
  return c;
}

}  // namespace

double LightDistribution::At(const Eigen::Vector3d& direction) const {
  constexpr double kDegrees = 180 / std::numbers::pi;
  const Eigen::Vector3d d = world_from_lamp.transpose() * direction;
  const double gamma = std::acos(std::clamp(d.z(), -1.0, 1.0)) * kDegrees;
  if (gamma > gamma_deg.back() + 1e-9) return 0;
  double c = std::atan2(d.y(), d.x()) * kDegrees;
  if (c < 0) c += 360;
  const Between row = Place(c_deg, FoldedC(c, c_deg)), column = Place(gamma_deg, gamma);
  const auto value = [&](size_t r) {
    const double* at = values.data() + r * gamma_deg.size();
    return (1 - column.share) * at[column.low] + column.share * at[column.high];
  };
  return (1 - row.share) * value(row.low) + row.share * value(row.high);
}

}  // namespace insitu
