// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/outline_with_holes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <tuple>

namespace insitu {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Ring = std::vector<int>;

Vector3d AreaOf(const std::vector<Vector3d>& vertices, const Ring& ring) {
  Vector3d area = Vector3d::Zero();
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    const Vector3d& first = vertices[ring[0]];
    area += (vertices[ring[i]] - first).cross(vertices[ring[i + 1]] - first);
  }
  return area;
}

double TurnOf(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// Of a face in its plane, the outline going left about it and the holes right.
class HoleJoiner {
 public:
  HoleJoiner(const std::vector<Vector3d>& vertices, const Ring& outline, const Vector3d& area)
      : vertices_(vertices), origin_(vertices[outline[0]]), ring_(outline) {
    x_ = area.unitOrthogonal();
    y_ = area.normalized().cross(x_);
  }

  // False: no edge reaches it.
  bool Join(const Ring& hole, const std::vector<Ring>& others) {
    std::vector<std::tuple<double, size_t, size_t>> bridges;
    for (size_t i = 0; i < ring_.size(); ++i) {
      for (size_t j = 0; j < hole.size(); ++j) {
        bridges.emplace_back((At(ring_[i]) - At(hole[j])).squaredNorm(), i, j);
      }
    }
    std::ranges::sort(bridges);
    for (const auto& [length, i, j] : bridges) {
      if (!IsFree(i, hole[j], hole, others)) continue;
      Ring joined(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      for (size_t k = 0; k <= hole.size(); ++k) joined.push_back(hole[(j + k) % hole.size()]);
      joined.insert(joined.end(), ring_.begin() + static_cast<std::ptrdiff_t>(i), ring_.end());
      ring_ = std::move(joined);
      return true;
    }
    return false;
  }
  const Ring& ring() const { return ring_; }

 private:
  Vector2d At(int vertex) const {
    const Vector3d from_origin = vertices_[vertex] - origin_;
    return {from_origin.dot(x_), from_origin.dot(y_)};
  }

  bool IsFree(size_t from, int to, const Ring& hole, const std::vector<Ring>& others) const {
    const Vector2d a = At(ring_[from]), b = At(to);
    const size_t n = ring_.size();
    const Vector2d before = At(ring_[(from + n - 1) % n]), after = At(ring_[(from + 1) % n]);
    const bool left_of_first = TurnOf(before, a, b) >= 0, left_of_second = TurnOf(a, after, b) >= 0;
    const bool is_convex = TurnOf(before, a, after) >= 0;
    if (!(is_convex ? left_of_first && left_of_second : left_of_first || left_of_second)) {
      return false;
    }
    return !Meets(a, b, ring_) && !Meets(a, b, hole) &&
           std::ranges::none_of(others, [&](const Ring& other) { return Meets(a, b, other); });
  }

  // Whether an edge of the ring crosses the segment, or a corner lies on it but for its ends.
  bool Meets(const Vector2d& a, const Vector2d& b, const Ring& ring) const {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vector2d c = At(ring[i]), d = At(ring[(i + 1) % ring.size()]);
      if (TurnOf(a, b, c) * TurnOf(a, b, d) < 0 && TurnOf(c, d, a) * TurnOf(c, d, b) < 0) {
        return true;
      }
      if (c == a || c == b || TurnOf(a, b, c) != 0) continue;
      const double along = (c - a).dot(b - a);
      if (along > 0 && along < (b - a).squaredNorm()) return true;
    }
    return false;
  }

  const std::vector<Vector3d>& vertices_;
  Vector3d origin_, x_, y_;
  Ring ring_;
};

}  // namespace

std::vector<int> OutlineWithHoles(const std::vector<Vector3d>& vertices, const Ring& outline,
                                  const std::vector<Ring>& holes, int* lost) {
  if (outline.size() < 3 || holes.empty()) return outline;
  const Vector3d area = AreaOf(vertices, outline);
  if (!(area.norm() > 0)) return outline;
  std::vector<Ring> left;
  for (Ring hole : holes) {
    if (hole.size() < 3) {
      ++*lost;
      continue;
    }
    if (AreaOf(vertices, hole).dot(area) > 0) std::ranges::reverse(hole);
    left.push_back(std::move(hole));
  }
  HoleJoiner joiner(vertices, outline, area);
  while (!left.empty()) {
    const Ring hole = std::move(left.back());
    left.pop_back();
    if (!joiner.Join(hole, left)) ++*lost;
  }
  return joiner.ring();
}

}  // namespace insitu
