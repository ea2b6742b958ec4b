// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/triangulate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "calibration/files/error.h"
#include "reconstruction/geometry/plane.h"

namespace insitu {
namespace {

using Outline = std::vector<Eigen::Vector2d>;

// Twice the signed area of a triangle: positive if a, b, c turn left.
double Turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double TwiceArea(const Outline& outline) {
  double area = 0;
  for (size_t i = 1; i + 1 < outline.size(); ++i)
    area += Turn(outline[0], outline[i], outline[i + 1]);
  return area;
}

bool SegmentsCross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                   const Eigen::Vector2d& d) {
  return Turn(a, b, c) * Turn(a, b, d) < 0 && Turn(c, d, a) * Turn(c, d, b) < 0;
}

bool CrossesItself(const Outline& outline) {
  const size_t n = outline.size();
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = i + 2; j < n; ++j) {
      if (SegmentsCross(outline[i], outline[i + 1], outline[j], outline[(j + 1) % n])) return true;
    }
  }
  return false;
}

// Finds ears, and remembers of each corner which vertex stood in the way: while that one and the
// neighbours stay, the corner is none. Else outlines of thousands of corners would take minutes.
class Ears {
 public:
  Ears(const Outline& outline, double slack)
      : outline_(outline),
        slack_(slack),
        obstacle_(outline.size(), kUnknown),
        is_gone_(outline.size(), false) {}

  // Whether the corner at `ring[k]` can be cut off: it turns left by more than `slack`, and no
  // other vertex lies in or on the triangle. Vertices at the place of a corner (a hole reached by a
  // double edge) do not count.
  bool IsEar(const std::vector<int>& ring, size_t k) {
    int& obstacle = obstacle_[ring[k]];
    if (obstacle == kTurnsRight || (obstacle >= 0 && !is_gone_[obstacle])) return false;
    const size_t n = ring.size();
    const Eigen::Vector2d &a = outline_[ring[(k + n - 1) % n]], &b = outline_[ring[k]],
                          &c = outline_[ring[(k + 1) % n]];
    obstacle = kTurnsRight;
    if (Turn(a, b, c) <= slack_) return false;
    const auto found = std::find_if(ring.begin(), ring.end(), [&](int index) {
      const Eigen::Vector2d& p = outline_[index];
      if (p == a || p == b || p == c) return false;
      return Turn(a, b, p) >= 0 && Turn(b, c, p) >= 0 && Turn(c, a, p) >= 0;
    });
    obstacle = found == ring.end() ? kUnknown : *found;
    return found == ring.end();
  }

  // To be called before `ring[k]` is cut off.
  void Forget(const std::vector<int>& ring, size_t k) {
    const size_t n = ring.size();
    is_gone_[ring[k]] = true;
    obstacle_[ring[(k + n - 1) % n]] = obstacle_[ring[(k + 1) % n]] = kUnknown;
  }

 private:
  static constexpr int kUnknown = -1, kTurnsRight = -2;
  const Outline& outline_;
  double slack_;
  std::vector<int> obstacle_;  // by vertex
  std::vector<bool> is_gone_;
};

// The vertex that makes the least bend, for removal without a triangle when only collinear ones
// are left; nullopt if even that one bends by more than `slack`.
std::optional<size_t> CollinearVertex(const Outline& outline, const std::vector<int>& ring,
                                      double slack) {
  const size_t n = ring.size();
  for (size_t k = 0; k < n; ++k) {
    const double turn =
        Turn(outline[ring[(k + n - 1) % n]], outline[ring[k]], outline[ring[(k + 1) % n]]);
    if (std::abs(turn) <= slack) return k;
  }
  return std::nullopt;
}

std::optional<std::vector<Eigen::Vector3i>> ClipEars(const Outline& outline, std::vector<int> ring,
                                                     double slack) {
  std::vector<Eigen::Vector3i> triangles;
  Ears ears(outline, slack);
  while (ring.size() >= 3) {
    const size_t n = ring.size();
    size_t k = 0;
    while (k < n && !ears.IsEar(ring, k)) ++k;
    if (k < n) {
      triangles.emplace_back(ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]);
    } else if (const std::optional<size_t> flat = CollinearVertex(outline, ring, slack)) {
      k = *flat;
    } else {
      return std::nullopt;
    }
    ears.Forget(ring, k);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return triangles;
}

}  // namespace

std::optional<std::vector<Eigen::Vector3i>> Triangulate(
    const std::vector<Eigen::Vector3d>& vertices, const Eigen::Vector3d& normal) {
  INSITU_CHECK(vertices.size() >= 3);
  const Outline outline = ProjectOutline(vertices, normal, vertices[0]);
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : outline) box.extend(p);
  const double area = TwiceArea(outline);
  const double slack = 1e-12 * box.diagonal().squaredNorm();  // rounding of a turn
  if (!(std::abs(area) > slack) || CrossesItself(outline)) return std::nullopt;
  std::vector<int> ring(vertices.size());
  std::iota(ring.begin(), ring.end(), 0);
  if (area < 0) std::reverse(ring.begin(), ring.end());  // triangles wind about `normal`
  return ClipEars(outline, ring, slack);
}

}  // namespace insitu
