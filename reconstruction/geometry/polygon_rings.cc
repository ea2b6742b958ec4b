// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/polygon_rings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <tuple>

#include "reconstruction/geometry/plane.h"
#include "reconstruction/geometry/triangulate.h"

namespace insitu {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double TurnOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// More than 0 if it turns left.
double TwiceAreaOf(const Points& points, const std::vector<int>& ring) {
  double twice_area = 0;
  for (size_t i = 1; i + 1 < ring.size(); ++i)
    twice_area += TurnOf(points[ring[0]], points[ring[i]], points[ring[i + 1]]);
  return twice_area;
}

// Whether two segments have a point in common, ends included.
bool Meet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
          const Eigen::Vector2d& d) {
  const Eigen::AlignedBox2d first(a.cwiseMin(b), a.cwiseMax(b)),
      second(c.cwiseMin(d), c.cwiseMax(d));
  return first.intersects(second) && TurnOf(a, b, c) * TurnOf(a, b, d) <= 0 &&
         TurnOf(c, d, a) * TurnOf(c, d, b) <= 0;
}

bool RingsMeet(const Points& one, const Points& other) {
  for (size_t i = 0; i < one.size(); ++i) {
    for (size_t j = 0; j < other.size(); ++j) {
      if (Meet(one[i], one[(i + 1) % one.size()], other[j], other[(j + 1) % other.size()]))
        return true;
    }
  }
  return false;
}

std::optional<RingFault> FaultOf(const Ring& ring, std::optional<size_t> hole,
                                 const Eigen::Vector3d& normal) {
  if (Triangulate(ring, normal)) return std::nullopt;
  if (!hole) {
    return RingFault{hole, Sentence("ringOutline", "the outline crosses itself or has no area")};
  }
  return RingFault{hole, Sentence("ringHole", "hole {hole} crosses itself or has no area",
                                  {{"hole", Json::UInt64(*hole + 1)}})};
}

// Joins holes to the outline by edges gone along twice, until all are one ring.
class Bridges {
 public:
  Bridges(Points points, const std::vector<std::vector<int>>& rings)
      : points_(std::move(points)), ring_(rings[0]), holes_(rings.begin() + 1, rings.end()) {
    if (TwiceAreaOf(points_, ring_) < 0) std::reverse(ring_.begin(), ring_.end());
    for (std::vector<int>& hole : holes_) {
      if (TwiceAreaOf(points_, hole) > 0) std::reverse(hole.begin(), hole.end());
    }
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& point : points_) box.extend(point);
    slack_ = 1e-12 * box.diagonal().squaredNorm();
  }

  // nullopt: no hole left sees the ring, which rings without fault exclude.
  std::optional<std::vector<int>> Join() {
    while (!holes_.empty()) {
      if (!JoinNearest()) return std::nullopt;
    }
    return ring_;
  }

 private:
  bool JoinNearest() {
    std::vector<std::tuple<double, size_t, size_t, size_t>> bridges;  // length, hole, its vertex, k
    for (size_t h = 0; h < holes_.size(); ++h) {
      for (size_t j = 0; j < holes_[h].size(); ++j) {
        for (size_t k = 0; k < ring_.size(); ++k) {
          bridges.emplace_back((points_[holes_[h][j]] - points_[ring_[k]]).norm(), h, j, k);
        }
      }
    }
    std::sort(bridges.begin(), bridges.end());
    const auto free = std::find_if(bridges.begin(), bridges.end(), [&](const auto& bridge) {
      const auto& [length, h, j, k] = bridge;
      return IsFree(k, holes_[h][j]);
    });
    if (free == bridges.end()) return false;
    Insert(std::get<1>(*free), std::get<2>(*free), std::get<3>(*free));
    return true;
  }

  // Whether the way from a place in the ring to a vertex leads through the inside alone.
  bool IsFree(size_t k, int to) const {
    const size_t n = ring_.size();
    const Eigen::Vector2d &before = points_[ring_[(k + n - 1) % n]], &a = points_[ring_[k]],
                          &after = points_[ring_[(k + 1) % n]], &b = points_[to];
    const bool is_left_of_both = TurnOf(before, a, b) > 0 && TurnOf(a, after, b) > 0;
    const bool is_left_of_one = TurnOf(before, a, b) > 0 || TurnOf(a, after, b) > 0;
    if (!(TurnOf(before, a, after) > 0 ? is_left_of_both : is_left_of_one)) return false;
    if (Crosses(a, b, ring_)) return false;
    return std::none_of(holes_.begin(), holes_.end(),
                        [&](const std::vector<int>& hole) { return Crosses(a, b, hole); });
  }

  bool Crosses(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
               const std::vector<int>& ring) const {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d &c = points_[ring[i]], &d = points_[ring[(i + 1) % ring.size()]];
      if (IsWithin(a, b, c)) return true;
      if (c == a || c == b || d == a || d == b) continue;
      if (TurnOf(a, b, c) * TurnOf(a, b, d) < 0 && TurnOf(c, d, a) * TurnOf(c, d, b) < 0)
        return true;
    }
    return false;
  }

  // Whether c lies between a and b on their line.
  bool IsWithin(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                const Eigen::Vector2d& c) const {
    if (c == a || c == b || std::abs(TurnOf(a, b, c)) > slack_) return false;
    return (c - a).dot(b - a) > 0 && (c - b).dot(a - b) > 0;
  }

  void Insert(size_t hole, size_t vertex, size_t k) {
    std::vector<int> way = holes_[hole];
    std::rotate(way.begin(), way.begin() + static_cast<std::ptrdiff_t>(vertex), way.end());
    way.push_back(way[0]);
    way.push_back(ring_[k]);
    ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(k + 1), way.begin(), way.end());
    holes_.erase(holes_.begin() + static_cast<std::ptrdiff_t>(hole));
  }

  Points points_;
  std::vector<int> ring_;                // turns left
  std::vector<std::vector<int>> holes_;  // still to be joined; turn right
  double slack_ = 0;                     // rounding of a turn
};

// Every ring's vertices counted on from the ring before.
std::vector<std::vector<int>> Numbered(const Ring& outline, const std::vector<Ring>& holes) {
  std::vector<std::vector<int>> rings;
  int next = 0;
  const auto add = [&](size_t size) {
    std::vector<int> ring(size);
    std::iota(ring.begin(), ring.end(), next);
    rings.push_back(std::move(ring));
    next += static_cast<int>(size);
  };
  add(outline.size());
  for (const Ring& hole : holes) add(hole.size());
  return rings;
}

// Of rings without fault.
std::optional<std::vector<Eigen::Vector3i>> TrianglesWithin(const Ring& outline,
                                                            const std::vector<Ring>& holes,
                                                            const Eigen::Vector3d& normal) {
  if (holes.empty()) return Triangulate(outline, normal);
  Ring all = outline;
  for (const Ring& hole : holes) all.insert(all.end(), hole.begin(), hole.end());
  const auto ring =
      Bridges(ProjectOutline(all, normal, outline[0]), Numbered(outline, holes)).Join();
  if (!ring) return std::nullopt;
  Ring joined;
  for (const int vertex : *ring) joined.push_back(all[vertex]);
  auto triangles = Triangulate(joined, normal);
  if (!triangles) return std::nullopt;
  for (Eigen::Vector3i& triangle : *triangles) {
    for (int& corner : triangle) corner = (*ring)[corner];
  }
  return triangles;
}

}  // namespace

std::optional<RingFault> FaultOfRings(const Ring& outline, const std::vector<Ring>& holes,
                                      const Eigen::Vector3d& normal) {
  if (const auto fault = FaultOf(outline, std::nullopt, normal)) return fault;
  const Points around = ProjectOutline(outline, normal, outline[0]);
  std::vector<Points> inner;
  for (size_t h = 0; h < holes.size(); ++h) {
    if (const auto fault = FaultOf(holes[h], h, normal)) return fault;
    inner.push_back(ProjectOutline(holes[h], normal, outline[0]));
    if (!IsInside(around, inner[h][0]) || RingsMeet(around, inner[h])) {
      return RingFault{h, Sentence("ringOutside", "hole {hole} is not inside the outline",
                                   {{"hole", Json::UInt64(h + 1)}})};
    }
    for (size_t other = 0; other < h; ++other) {
      if (IsInside(inner[other], inner[h][0]) || IsInside(inner[h], inner[other][0]) ||
          RingsMeet(inner[other], inner[h])) {
        return RingFault{
            h, Sentence("ringsOverlap", "hole {hole} and hole {other} overlap",
                        {{"hole", Json::UInt64(h + 1)}, {"other", Json::UInt64(other + 1)}})};
      }
    }
  }
  if (holes.empty() || TrianglesWithin(outline, holes, normal)) return std::nullopt;
  return RingFault{0, Sentence("ringsNothing", "its holes leave nothing between them")};
}

std::optional<std::vector<Eigen::Vector3i>> TriangulateRings(const Ring& outline,
                                                             const std::vector<Ring>& holes,
                                                             const Eigen::Vector3d& normal) {
  if (!holes.empty() && FaultOfRings(outline, holes, normal)) return std::nullopt;
  return TrianglesWithin(outline, holes, normal);
}

}  // namespace insitu
