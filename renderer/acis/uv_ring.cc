// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/acis/uv_ring.h"

#include <algorithm>

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

std::vector<double> CrossingsAt(const std::vector<Eigen::Vector2d>& points,
                                const std::vector<int>& ring, double y) {
  std::vector<double> crossings;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d &a = points[ring[i]], &b = points[ring[(i + 1) % ring.size()]];
    if ((a.y() > y) == (b.y() > y)) continue;
    crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::ranges::sort(crossings);
  return crossings;
}

bool IsWithin(const std::vector<Eigen::Vector2d>& points, const std::vector<int>& ring,
              const Eigen::Vector2d& place) {
  const std::vector<double> crossings = CrossingsAt(points, ring, place.y());
  return (crossings.end() - std::ranges::upper_bound(crossings, place.x())) % 2 == 1;
}

}  // namespace insitu
