// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/acis/uv_ring.h"

namespace insitu {

double SignedArea(const std::vector<Eigen::Vector2d>& points, const std::vector<int>& ring) {
  double area = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d &a = points[ring[i]], &b = points[ring[(i + 1) % ring.size()]];
    area += a.x() * b.y() - a.y() * b.x();
  }
  return area / 2;
}

Eigen::Vector2d MeanOf(const std::vector<Eigen::Vector2d>& points, const std::vector<int>& ring) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const int at : ring) sum += points[at];
  return sum / static_cast<double>(ring.size());
}

bool IsWithin(const std::vector<Eigen::Vector2d>& points, const std::vector<int>& ring,
              const Eigen::Vector2d& place) {
  bool inside = false;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d &a = points[ring[i]], &b = points[ring[(i + 1) % ring.size()]];
    if ((a.y() > place.y()) == (b.y() > place.y())) continue;
    const double at_x = a.x() + (place.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (place.x() < at_x) inside = !inside;
  }
  return inside;
}

}  // namespace insitu
