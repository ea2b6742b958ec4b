// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf/dxf_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace insitu {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A point of the path with half its width there, to the left along `left` (a unit vector, or longer
// where two segments are mitred).
struct Station {
  Vector3d point;
  Vector2d left;
  double half_width = 0;
};
using Segment = std::vector<Station>;  // at least two

Vector2d LeftOf(const Vector2d& direction) { return {-direction.y(), direction.x()}; }

int ChordCount(double angle, double radius, double tolerance) {
  constexpr double kWidestChord = std::numbers::pi / 12;
  constexpr double kFinestChord = 2 * std::numbers::pi / 1024;
  const double sagitta = std::min(tolerance / radius, 1.0);
  const double step = std::clamp(2 * std::acos(1 - sagitta), kFinestChord, kWidestChord);
  return std::max(1, static_cast<int>(std::ceil(std::abs(angle) / step - 1e-9)));
}

// From a to b; a positive bulge turns counter-clockwise.
Segment SegmentBetween(const DxfPathVertex& a, const DxfPathVertex& b, double tolerance) {
  const Vector2d from = a.point.head<2>(), to = b.point.head<2>();
  const double chord = (to - from).norm();
  const Vector2d along = chord > 0 ? Vector2d((to - from) / chord) : Vector2d(1, 0);
  const double angle = 4 * std::atan(a.bulge);
  const bool is_arc = std::abs(angle) > 1e-9 && chord > 0;
  const double radius = is_arc ? chord / (2 * std::sin(std::abs(angle) / 2)) : 0;
  const int count = is_arc ? ChordCount(angle, radius, tolerance) : 1;
  const double turn = angle > 0 ? 1 : -1;
  const Vector2d center = (from + to) / 2 + LeftOf(along) * (turn * radius * std::cos(angle / 2));
  Segment segment;
  for (int i = 0; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    Station station;
    station.half_width = ((1 - share) * a.start_width + share * a.end_width) / 2;
    station.point = (1 - share) * a.point + share * b.point;
    station.left = LeftOf(along);
    if (is_arc) {
      const Eigen::Rotation2Dd rotation((share - 0.5) * angle);
      station.left = rotation * LeftOf(along);
      if (i > 0 && i < count) station.point.head<2>() = center - turn * radius * station.left;
    }
    segment.push_back(station);
  }
  return segment;
}

// Both ends of a bend share one edge, unless it is too sharp or the width jumps there.
void Mitre(Station* before, Station* after) {
  const double cosine = before->left.dot(after->left);
  if (before->half_width != after->half_width || cosine < -0.5) return;
  before->left = after->left = (before->left + after->left) / (1 + cosine);
}

std::vector<Segment> SegmentsOf(const DxfPath& path, double tolerance) {
  std::vector<Segment> segments;
  const size_t count = path.vertices.size();
  for (size_t i = 0; i + (path.closed ? 0 : 1) < count; ++i) {
    const DxfPathVertex &a = path.vertices[i], &b = path.vertices[(i + 1) % count];
    if (a.point == b.point && path.thickness == 0) continue;
    if ((a.point.head<2>() - b.point.head<2>()).norm() == 0 && a.point.z() == b.point.z()) continue;
    segments.push_back(SegmentBetween(a, b, tolerance));
  }
  for (size_t i = 0; i + 1 < segments.size(); ++i) {
    Mitre(&segments[i].back(), &segments[i + 1].front());
  }
  if (path.closed && segments.size() > 1) Mitre(&segments.back().back(), &segments.front().front());
  return segments;
}

class PathFaces {
 public:
  explicit PathFaces(const DxfPath& path) : path_(path) {}

  void AddWalls(const Segment& segment) {
    for (size_t i = 0; i + 1 < segment.size(); ++i) {
      AddFace({segment[i].point, segment[i + 1].point, Raised(segment[i + 1].point),
               Raised(segment[i].point)});
    }
  }

  // A ribbon, or a prism whose ends are closed where nothing follows.
  void AddWide(const Segment& segment, bool closes_start, bool closes_end) {
    const auto left = [](const Station& s) { return Offset(s, s.half_width); };
    const auto right = [](const Station& s) { return Offset(s, -s.half_width); };
    for (size_t i = 0; i + 1 < segment.size(); ++i) {
      const Vector3d a = right(segment[i]), b = right(segment[i + 1]), c = left(segment[i + 1]),
                     d = left(segment[i]);
      if (path_.thickness == 0) {
        AddFace({a, b, c, d});
        continue;
      }
      AddFace({d, c, b, a});
      AddFace({Raised(a), Raised(b), Raised(c), Raised(d)});
      AddFace({a, b, Raised(b), Raised(a)});
      AddFace({c, d, Raised(d), Raised(c)});
    }
    if (path_.thickness == 0) return;
    const Station &first = segment.front(), &last = segment.back();
    if (closes_start) {
      AddFace({left(first), right(first), Raised(right(first)), Raised(left(first))});
    }
    if (closes_end) AddFace({right(last), left(last), Raised(left(last)), Raised(right(last))});
  }

  void AddCaps(const std::vector<Segment>& segments) {
    std::vector<Vector3d> outline;
    for (const Segment& segment : segments) {
      for (size_t i = 0; i + 1 < segment.size(); ++i) outline.push_back(segment[i].point);
    }
    std::vector<Vector3d> top = outline;
    for (Vector3d& point : top) point = Raised(point);
    std::ranges::reverse(outline);
    AddFace(outline);
    AddFace(top);
  }

  FacetedPath result;

 private:
  static Vector3d Offset(const Station& s, double distance) {
    return s.point + Vector3d(s.left.x() * distance, s.left.y() * distance, 0);
  }
  Vector3d Raised(const Vector3d& point) const { return point + Vector3d(0, 0, path_.thickness); }

  // A negative thickness would turn every face inside out.
  void AddFace(std::vector<Vector3d> corners) {
    if (path_.thickness < 0) std::ranges::reverse(corners);
    std::vector<int> face;
    for (const Vector3d& corner : corners) {
      face.push_back(static_cast<int>(result.vertices.size()));
      result.vertices.push_back(path_.axes * corner);
    }
    result.faces.push_back(std::move(face));
  }

  const DxfPath& path_;
};

}  // namespace

bool DxfPath::IsSurface() const {
  return thickness != 0 || std::ranges::any_of(vertices, [](const DxfPathVertex& v) {
           return v.start_width != 0 || v.end_width != 0;
         });
}

FacetedPath Facet(const DxfPath& path, double tolerance) {
  const std::vector<Segment> segments = SegmentsOf(path, tolerance);
  PathFaces faces(path);
  for (size_t i = 0; i < segments.size(); ++i) {
    const Segment& segment = segments[i];
    if (std::ranges::all_of(segment, [](const Station& s) { return s.half_width == 0; })) {
      if (path.thickness != 0) faces.AddWalls(segment);  // else a mere line
    } else {
      const bool open = !path.closed;
      faces.AddWide(segment, open && i == 0, open && i + 1 == segments.size());
    }
  }
  if (path.capped && !segments.empty()) faces.AddCaps(segments);
  return std::move(faces.result);
}

}  // namespace insitu
