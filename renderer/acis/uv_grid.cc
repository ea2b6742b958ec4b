// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/acis/uv_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "renderer/acis/uv_ring.h"

namespace insitu {
namespace {

using Eigen::Vector2d;

constexpr double kClose = 0.6, kMostRows = 256;  // of a step; of points

// The corners of an outline by cells as wide as what is close.
class Rim {
 public:
  Rim(const std::vector<Vector2d>& points, const std::vector<int>& outline, const Vector2d& step)
      : cell_(kClose * step) {
    for (const int at : outline) {
      const Vector2d place = points[at].cwiseQuotient(cell_);
      corners_[KeyOf(CellOf(place))].push_back(place);
    }
  }

  bool IsClose(const Vector2d& point) const {
    const Vector2d place = point.cwiseQuotient(cell_);
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        const auto found = corners_.find(KeyOf(CellOf(place) + Cell(i, j)));
        if (found == corners_.end()) continue;
        for (const Vector2d& corner : found->second) {
          if ((corner - place).squaredNorm() < 1) return true;
        }
      }
    }
    return false;
  }

 private:
  using Cell = Eigen::Matrix<int64_t, 2, 1>;

  static Cell CellOf(const Vector2d& place) { return place.array().floor().cast<int64_t>(); }
  static uint64_t KeyOf(const Cell& cell) {
    return static_cast<uint64_t>(cell.x()) << 32 ^ (static_cast<uint64_t>(cell.y()) & 0xFFFFFFFF);
  }

  Vector2d cell_;
  std::unordered_map<uint64_t, std::vector<Vector2d>> corners_;  // places in cells
};

}  // namespace

std::vector<Vector2d> GridWithin(const std::vector<Vector2d>& points,
                                 const std::vector<int>& outline, const Vector2d& step) {
  Eigen::AlignedBox2d box;
  for (const int at : outline) box.extend(points[at]);
  const Eigen::Array2d counts = box.sizes().cwiseQuotient(step).array().ceil().min(kMostRows);
  const Rim rim(points, outline, step);
  std::vector<Vector2d> grid;
  for (int i = 1; i < counts.y(); ++i) {
    const double y = box.min().y() + box.sizes().y() * i / counts.y();
    const std::vector<double> crossings = CrossingsAt(points, outline, y);
    for (int j = 0; j < counts.x(); ++j) {
      const double stagger = i % 2 == 0 ? 0.25 : 0.75;
      const Vector2d p(box.min().x() + box.sizes().x() * (j + stagger) / counts.x(), y);
      const auto beyond = crossings.end() - std::ranges::upper_bound(crossings, p.x());
      if (beyond % 2 == 1 && !rim.IsClose(p)) grid.push_back(p);
    }
  }
  return grid;
}

}  // namespace insitu
