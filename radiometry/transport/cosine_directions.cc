// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/cosine_directions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr int kTogether = 16;

// Cut into bands of the square from -1 to 1, each in order of the other coordinate.
void PutNeighboursTogether(std::vector<Eigen::Vector3d>* directions) {
  const auto count = static_cast<double>(directions->size());
  const int bands = std::max(1, static_cast<int>(std::lround(std::sqrt(count / kTogether))));
  std::ranges::sort(*directions, {}, [](const Eigen::Vector3d& d) { return d.x(); });
  const size_t band = (directions->size() / bands + kTogether - 1) / kTogether * kTogether;
  for (size_t first = 0; first < directions->size(); first += band) {
    const size_t last = std::min(first + band, directions->size());
    std::ranges::sort(directions->begin() + static_cast<long>(first),
                      directions->begin() + static_cast<long>(last), {},
                      [](const Eigen::Vector3d& d) { return d.y(); });
  }
}

}  // namespace

CosineDirections::CosineDirections(int count) {
  INSITU_CHECK(count > 0);
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double squared = (i + 0.5) / count;  // of the radius
    const double radius = std::sqrt(squared), angle = i * golden_angle;
    about_z_.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                          std::sqrt(1 - squared));
  }
  PutNeighboursTogether(&about_z_);
}

std::vector<Eigen::Vector3d> CosineDirections::About(const Eigen::Vector3d& normal) const {
  Eigen::Matrix3d axes;
  const Eigen::Vector3d x = normal.unitOrthogonal();
  axes << x, normal.cross(x), normal;
  std::vector<Eigen::Vector3d> directions(about_z_.size());
  for (size_t i = 0; i < about_z_.size(); ++i) directions[i].noalias() = axes * about_z_[i];
  return directions;
}

}  // namespace insitu
