// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/acis/curved_face.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "renderer/acis/uv_grid.h"
#include "renderer/acis/uv_mesh.h"
#include "renderer/acis/uv_ring.h"
#include "renderer/mesh/outline_with_holes.h"

namespace insitu {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi, kTurn = 2 * kPi;
constexpr double kGrid = 1e-9;  // of a chord
constexpr char kGoesAround[] = "goes around its surface in a way that is not read";

// A loop in parameters, followed over the cut where angles jump.
struct UvRing {
  std::vector<int> at;  // points
  int turns_x = 0, turns_y = 0;
};

// Parameters here are x and y: u and v, mirrored where the face looks inwards, so that the face is
// on the left of its loops; turned where the loops go about a torus' tube. Both count in chords.
class FaceCutter {
 public:
  FaceCutter(const CurvedFace& face, double tolerance, std::vector<Vector3d>* vertices,
             std::vector<Eigen::Vector3i>* triangles)
      : surface_(face.surface),
        sign_(face.looks_inwards ? -1 : 1),
        vertices_(*vertices),
        triangles_(*triangles) {
    if (surface_.kind == AcisSurface::Kind::kSphere) {
      std::vector<Vector3d> directions;
      for (const auto& ring : face.rings) {
        for (const int vertex : ring) {
          directions.push_back((vertices_[vertex] - surface_.origin).normalized());
        }
      }
      surface_.axes = AxesAwayFrom(directions);
    }
    const bool is_torus = surface_.kind == AcisSurface::Kind::kTorus;
    const double largest = LargestRadius(face);
    step_ = {ChordAngle(largest, tolerance),
             ChordAngle(is_torus ? surface_.tube : largest, tolerance)};
    for (const auto& ring : face.rings) {
      UvRing unwrapped = Unwrapped(ring);
      if (unwrapped.at.size() >= 3) rings_.push_back(std::move(unwrapped));  // a pole's has none
    }
    TurnIfAboutTube();
  }

  std::string Cut() {
    std::vector<const UvRing*> around, outer, holes;
    for (const UvRing& ring : rings_) {
      if (ring.turns_y != 0 || std::abs(ring.turns_x) > 1) return kGoesAround;
      (ring.turns_x != 0                  ? around
       : SignedArea(points_, ring.at) > 0 ? outer
                                          : holes)
          .push_back(&ring);
    }
    if (around.size() > 2 || (!around.empty() && !outer.empty())) return kGoesAround;
    if (!outer.empty()) return CutPieces(outer, holes);
    for (int i = 0; i < kCuts; ++i) {
      std::vector<int> outline = Opened(around, i);
      if (outline.empty()) break;
      if (const auto shifted = Within(outline, holes)) return Triangulated(outline, *shifted);
    }
    return kGoesAround;
  }

 private:
  static constexpr int kCuts = 24;  // places that are tried for the cut

  double LargestRadius(const CurvedFace& face) const {
    if (surface_.kind == AcisSurface::Kind::kSphere) return surface_.radius;
    if (surface_.kind == AcisSurface::Kind::kTorus) return surface_.radius + surface_.tube;
    double largest = 1e-9;
    for (const auto& ring : face.rings) {
      for (const int vertex : ring) {
        const Vector3d local = surface_.axes.transpose() * (vertices_[vertex] - surface_.origin);
        largest = std::max(largest, local.head<2>().norm());
      }
    }
    return largest;
  }

  int Add(const Vector2d& xy, int vertex) {
    points_.push_back(xy);
    vertex_of_point_.push_back(vertex);
    return static_cast<int>(points_.size()) - 1;
  }

  UvRing Unwrapped(std::vector<int> ring) {
    UvRing result;
    const auto is_pole = [&](int vertex) { return surface_.IsPole(vertices_[vertex]); };
    const auto first = std::ranges::find_if_not(ring, is_pole);
    if (first == ring.end()) return result;
    std::rotate(ring.begin(), first, ring.end());
    Vector2d last(sign_ * surface_.ParametersOf(vertices_[ring[0]]).x(),
                  surface_.ParametersOf(vertices_[ring[0]]).y());
    const Vector2d start = last;
    ring.push_back(ring[0]);
    std::vector<int> pole;  // the one that was just passed
    for (size_t i = 0; i < ring.size(); ++i) {
      Vector2d xy = surface_.ParametersOf(vertices_[ring[i]]);
      xy.x() = sign_ * xy.x();
      xy.x() += kTurn * std::round((last.x() - xy.x()) / kTurn);
      if (surface_.kind == AcisSurface::Kind::kTorus) {
        xy.y() += kTurn * std::round((last.y() - xy.y()) / kTurn);
      }
      if (is_pole(ring[i])) {
        xy.x() = last.x();
        pole = {ring[i]};
      } else if (!pole.empty()) {  // on its other side
        result.at.push_back(Add({xy.x(), last.y()}, pole[0]));
        pole.clear();
      }
      if (i + 1 < ring.size()) result.at.push_back(Add(xy, ring[i]));
      last = xy;
    }
    result.turns_x = static_cast<int>(std::lround((last.x() - start.x()) / kTurn));
    result.turns_y = static_cast<int>(std::lround((last.y() - start.y()) / kTurn));
    return result;
  }

  void TurnIfAboutTube() {
    const bool about_tube = std::ranges::any_of(rings_, [](const UvRing& r) { return r.turns_y; });
    const bool about_axis = std::ranges::any_of(rings_, [](const UvRing& r) { return r.turns_x; });
    if (!about_tube || about_axis) return;
    is_turned_ = true;
    for (Vector2d& point : points_) point = {point.y(), -point.x()};
    for (UvRing& ring : rings_) {
      ring.turns_x = ring.turns_y;
      ring.turns_y = 0;
    }
    std::swap(step_.x(), step_.y());
  }

  Vector3d Lifted(Vector2d xy) const {
    if (is_turned_) xy = {-xy.y(), xy.x()};
    return surface_.PointAt({sign_ * xy.x(), xy.y()});
  }

  // Copies of points, `shift` away.
  std::vector<int> Shifted(const std::vector<int>& ring, const Vector2d& shift) {
    if (shift.isZero(0)) return ring;
    std::vector<int> copies;
    for (const int at : ring) copies.push_back(Add(points_[at] + shift, vertex_of_point_[at]));
    return copies;
  }

  // New points of the line between two, as many as its arc needs.
  std::vector<int> Between(int from, int to) {
    const Vector2d a = points_[from], b = points_[to];
    const bool is_straight = surface_.kind == AcisSurface::Kind::kCone;
    const Vector2d chords = (b - a).cwiseAbs().cwiseQuotient(step_);
    const int count = is_straight ? 1 : std::max(1, static_cast<int>(std::ceil(chords.maxCoeff())));
    std::vector<int> between;
    for (int i = 1; i < count; ++i) {
      const Vector2d xy = a + (b - a) * i / count;
      vertices_.push_back(Lifted(xy));
      between.push_back(Add(xy, static_cast<int>(vertices_.size()) - 1));
    }
    return between;
  }

  void Append(const std::vector<int>& points, std::vector<int>* outline) const {
    outline->insert(outline->end(), points.begin(), points.end());
  }

  // y of the pole above or below; nullopt: there is none that way.
  std::optional<double> PoleOf(bool is_above) const {
    if (surface_.kind == AcisSurface::Kind::kSphere) return is_above ? kPi / 2 : -kPi / 2;
    if (surface_.kind != AcisSurface::Kind::kCone || surface_.slope == 0) return std::nullopt;
    if ((surface_.slope < 0) != is_above) return std::nullopt;
    return -surface_.radius / surface_.slope;
  }

  // The loops that go around, or none, joined by a cut to one outline; the cut is the `attempt`-th
  // of several. Empty: the surface ends nowhere.
  std::vector<int> Opened(const std::vector<const UvRing*>& around, int attempt) {
    const UvRing *below = nullptr, *above = nullptr;  // the face is on the left of both
    for (const UvRing* ring : around) (ring->turns_x > 0 ? below : above) = ring;
    if (around.size() == 2 && (!below || !above)) return {};
    if (surface_.kind == AcisSurface::Kind::kTorus) {
      if (around.size() == 1) return {};
      return around.empty() ? WholeTorus(attempt) : Band(*below, *above, attempt);
    }
    if (around.size() == 2) return Band(*below, *above, attempt);
    return Cap(below, above, attempt);
  }

  // From its point at a share of its length, around, to that point again.
  std::vector<int> OnceAround(const UvRing& ring, size_t begin) {
    std::vector<int> way;
    const size_t n = ring.at.size();
    const Vector2d turn(kTurn * ring.turns_x, 0);
    for (size_t i = 0; i <= n; ++i) {
      const int at = ring.at[(begin + i) % n];
      way.push_back(begin + i < n ? at : Add(points_[at] + turn, vertex_of_point_[at]));
    }
    return way;
  }

  std::vector<int> Band(const UvRing& below, const UvRing& above, int attempt) {
    std::vector<int> outline = OnceAround(below, below.at.size() * attempt / kCuts);
    const Vector2d corner = points_[outline.back()];
    size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < above.at.size(); ++i) {
      const double off = std::abs(std::remainder(points_[above.at[i]].x() - corner.x(), kTurn));
      if (off >= least) continue;
      least = off;
      nearest = i;
    }
    const Vector2d& there = points_[above.at[nearest]];
    Vector2d shift(kTurn * std::round((corner.x() - there.x()) / kTurn), 0);
    if (surface_.kind == AcisSurface::Kind::kTorus) {
      shift.y() =
          kTurn *
          std::ceil((MeanOf(points_, below.at).y() - MeanOf(points_, above.at).y()) / kTurn);
    }
    const std::vector<int> back = Shifted(OnceAround(above, nearest), shift);
    return Joined(std::move(outline), back);
  }

  // `there` to the right, a cut up, `back` to the left, the same cut down.
  std::vector<int> Joined(std::vector<int> there, const std::vector<int>& back) {
    const Vector2d turn = points_[there.front()] - points_[there.back()];
    const std::vector<int> up = Between(there.back(), back.front());
    std::vector<int> down = Shifted(up, turn);
    std::ranges::reverse(down);
    Append(up, &there);
    Append(back, &there);
    Append(down, &there);
    return there;
  }

  // Of a loop that goes around, or of none, to the poles.
  std::vector<int> Cap(const UvRing* below, const UvRing* above, int attempt) {
    const auto top = PoleOf(true), bottom = PoleOf(false);
    const auto pole = [&](double x, double y, double turn) {
      vertices_.push_back(Lifted({x, y}));
      const int vertex = static_cast<int>(vertices_.size()) - 1;
      const int first = Add({x, y}, vertex);
      return std::vector<int>{first, Add({x + turn, y}, vertex)};
    };
    if (below) {
      if (!top) return {};
      std::vector<int> outline = OnceAround(*below, below->at.size() * attempt / kCuts);
      return Joined(outline, pole(points_[outline.back()].x(), *top, -kTurn));
    }
    if (above) {
      if (!bottom) return {};
      const std::vector<int> back = OnceAround(*above, above->at.size() * attempt / kCuts);
      return Joined(pole(points_[back.back()].x(), *bottom, kTurn), back);
    }
    if (!top || !bottom) return {};
    const double x = kTurn * attempt / kCuts;
    return Joined(pole(x, *bottom, kTurn), pole(x + kTurn, *top, -kTurn));
  }

  std::vector<int> WholeTorus(int attempt) {
    const double x = kTurn * attempt / kCuts;
    vertices_.push_back(Lifted({x, x}));
    const int vertex = static_cast<int>(vertices_.size()) - 1;
    std::vector<int> there = {Add({x, x}, vertex)};
    const int right = Add({x + kTurn, x}, vertex);
    Append(Between(there[0], right), &there);
    there.push_back(right);
    std::vector<int> back = Shifted(there, {0, kTurn});
    std::ranges::reverse(back);
    return Joined(there, back);
  }

  // The holes, a turn away where need be so that they lie within; nullopt: one crosses the cut.
  std::optional<std::vector<std::vector<int>>> Within(const std::vector<int>& outline,
                                                      const std::vector<const UvRing*>& holes) {
    std::vector<std::vector<int>> within;
    const bool is_torus = surface_.kind == AcisSurface::Kind::kTorus;
    for (const UvRing* hole : holes) {
      const int reach = is_torus ? 2 : 0;
      std::optional<Vector2d> found;
      for (int i = -2; i <= 2 && !found; ++i) {
        for (int j = -reach; j <= reach && !found; ++j) {
          const Vector2d shift(kTurn * i, kTurn * j);
          const auto is_inside = [&](int at) {
            return IsWithin(points_, outline, points_[at] + shift);
          };
          if (std::ranges::all_of(hole->at, is_inside)) found = shift;
        }
      }
      if (!found) return std::nullopt;
      within.push_back(Shifted(hole->at, *found));
    }
    return within;
  }

  std::string CutPieces(const std::vector<const UvRing*>& outer,
                        const std::vector<const UvRing*>& holes) {
    size_t used = 0;
    for (const UvRing* ring : outer) {
      std::vector<std::vector<int>> own;
      for (const UvRing* hole : holes) {
        if (const auto within = Within(ring->at, {hole})) own.push_back(within->front());
      }
      used += own.size();
      const std::string failure = Triangulated(ring->at, own);
      if (!failure.empty()) return failure;
    }
    return used == holes.size() ? "" : kGoesAround;
  }

  std::string Triangulated(const std::vector<int>& outline,
                           const std::vector<std::vector<int>>& holes) {
    Eigen::AlignedBox2d box;
    for (const int at : outline) box.extend(points_[at]);
    Vector2d unit = step_;
    if (surface_.kind == AcisSurface::Kind::kCone) unit.y() = std::max(1e-12, box.sizes().y());
    std::vector<Vector2d> scaled;
    std::vector<Vector3d> flat;
    for (const Vector2d& point : points_) {
      // Rounded, so that points of one rim lie on one line.
      scaled.emplace_back((point.cwiseQuotient(unit) / kGrid).array().round().matrix() * kGrid);
      flat.emplace_back(scaled.back().x(), scaled.back().y(), 0);
    }
    int lost = 0;
    const std::vector<int> joined = OutlineWithHoles(flat, outline, holes, &lost);
    UvMesh mesh(std::move(scaled), joined);
    if (lost > 0 || mesh.triangles().empty()) return "has loops that cross";
    if (surface_.kind != AcisSurface::Kind::kCone) {
      for (const Vector2d& p : GridWithin(points_, joined, step_))
        mesh.Insert(p.cwiseQuotient(step_));
    }
    for (size_t i = points_.size(); i < mesh.points().size(); ++i) {
      vertices_.push_back(Lifted(mesh.points()[i].cwiseProduct(unit)));
      vertex_of_point_.push_back(static_cast<int>(vertices_.size()) - 1);
    }
    for (const Eigen::Vector3i& t : mesh.triangles()) {
      const Eigen::Vector3i corners(vertex_of_point_[t[0]], vertex_of_point_[t[1]],
                                    vertex_of_point_[t[2]]);
      const bool is_pole =
          corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
      if (!is_pole) triangles_.push_back(corners);
    }
    vertex_of_point_.resize(points_.size());
    return "";
  }

  AcisSurface surface_;
  double sign_;
  std::vector<Vector3d>& vertices_;
  std::vector<Eigen::Vector3i>& triangles_;
  Vector2d step_;
  bool is_turned_ = false;
  std::vector<UvRing> rings_;
  std::vector<Vector2d> points_;
  std::vector<int> vertex_of_point_;
};

}  // namespace

std::string AddCurvedFace(const CurvedFace& face, double tolerance, std::vector<Vector3d>* vertices,
                          std::vector<Eigen::Vector3i>* triangles) {
  return FaceCutter(face, tolerance, vertices, triangles).Cut();
}

}  // namespace insitu
