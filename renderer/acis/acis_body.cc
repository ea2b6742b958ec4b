// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/acis/acis_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "renderer/acis/acis_geometry.h"
#include "renderer/acis/acis_spline.h"
#include "renderer/acis/curved_face.h"
#include "renderer/mesh/face_triangles.h"
#include "renderer/mesh/outline_with_holes.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using Ring = std::vector<int>;  // of vertices

constexpr double kOffSurface = 1e-3;  // of a face's size, or an edge's
constexpr char kEndsOff[] = "with an edge whose ends are off its curve";

class BodyFaceter {
 public:
  BodyFaceter(const AcisFile& file, double tolerance, double most_vertices)
      : file_(file), tolerance_(tolerance), most_vertices_(most_vertices) {}

  AcisShape Run() {
    for (int i = 0; i < std::ssize(file_.records); ++i) {
      if (file_.records[i].type != "face") continue;
      ++shape_.faces;
      if (static_cast<double>(local_.size()) > most_vertices_) {
        ++shape_.unread["beyond the facets that a drawing may have"];
        continue;
      }
      SetBody(i);
      const std::string failure = AddFace(i);
      if (!failure.empty()) ++shape_.unread[failure];
      PlaceNew();
    }
    return std::move(shape_);
  }

 private:
  // Upwards from the face: vertices are made in the body's own frame, then placed.
  void SetBody(int face) {
    const int shell = file_.First(face, "shell");
    const int body = file_.First(file_.First(shell, "lump"), "body");
    const int record = file_.First(body, "transform");
    const auto transform = record < 0 ? std::nullopt : AcisTransformOf(file_.records[record]);
    body_ = transform.value_or(Eigen::Affine3d::Identity());
    if (body == body_record_) return;
    body_record_ = body;
    points_of_edge_.clear();
    vertex_of_record_.clear();
    local_.resize(shape_.vertices.size());
    std::ranges::fill(local_, Vector3d::Zero());
  }

  void PlaceNew() {
    for (size_t i = shape_.vertices.size(); i < local_.size(); ++i) {
      shape_.vertices.push_back(body_ * local_[i]);
    }
    if (body_.linear().determinant() > 0) return;
    for (size_t t = placed_; t < shape_.triangles.size(); ++t) {
      std::swap(shape_.triangles[t][1], shape_.triangles[t][2]);
    }
    placed_ = shape_.triangles.size();
  }

  // Empty: done; else why it is left out.
  std::string AddFace(int face) {
    placed_ = shape_.triangles.size();
    const AcisRecord& record = file_.records[face];
    const int surface_record = file_.First(face, "surface");
    if (surface_record < 0) return "without a surface";
    const auto surface = AcisSurfaceOf(file_.records[surface_record]);
    if (!surface) return "on a " + file_.records[surface_record].type;
    std::vector<Ring> rings;
    const std::string failure = RingsOf(face, &rings);
    if (!failure.empty()) return failure;
    if (!LieOn(*surface, rings)) return "whose edges leave its surface";
    const bool inwards = surface->looks_inwards != IsReversed(record, surface_record);
    if (surface->kind == AcisSurface::Kind::kPlane) return AddPlane(*surface, inwards, rings);
    if (surface->kind == AcisSurface::Kind::kSphere && rings.empty()) return AddSphere(*surface);
    if (rings.empty() && surface->kind == AcisSurface::Kind::kCone) return "without an end";
    return AddCurvedFace({*surface, inwards, rings}, tolerance_ / ScaleOfBody(), &local_,
                         &shape_.triangles);
  }

  double ScaleOfBody() const { return body_.linear().colwise().norm().maxCoeff(); }

  // The word behind a reference.
  static bool IsReversed(const AcisRecord& record, int reference) {
    for (size_t i = record.tokens.size(); i-- > 0;) {
      const AcisToken& token = record.tokens[i];
      if (token.kind == AcisToken::Kind::kReference && token.number == reference) {
        return IsAcisReversed(record, i);
      }
    }
    return false;
  }

  std::string AddSphere(const AcisSurface& surface) {
    const Eigen::Matrix3d linear = body_.linear();
    const double scale = ScaleOfBody();
    const bool is_similar =
        (linear.transpose() * linear - scale * scale * Eigen::Matrix3d::Identity()).norm() <
        1e-9 * scale * scale;
    if (!is_similar)
      return AddCurvedFace({surface, false, {}}, tolerance_ / scale, &local_, &shape_.triangles);
    shape_.spheres.push_back({body_ * surface.origin, scale * surface.radius});
    return "";
  }

  // Loops of one point, as at the tip of a cone, are none.
  std::string RingsOf(int face, std::vector<Ring>* rings) {
    int loop = file_.First(face, "loop");
    for (size_t n = 0; loop >= 0 && n < file_.records.size(); ++n) {
      Ring ring;
      const int first = file_.First(loop, "coedge");
      int coedge = first;
      for (size_t m = 0; coedge >= 0 && m < file_.records.size(); ++m) {
        const std::string failure = AppendEdge(coedge, &ring);
        if (!failure.empty()) return failure;
        coedge = file_.First(coedge, "coedge");
        if (coedge == first) break;
      }
      if (ring.size() > 1) rings->push_back(std::move(ring));
      loop = file_.First(loop, "loop");
    }
    return "";
  }

  // All points of an edge but its last, in the loop's direction.
  std::string AppendEdge(int coedge, Ring* ring) {
    const int edge = file_.First(coedge, "edge");
    if (edge < 0) return "with a loop without edges";
    const std::string failure = FindPoints(edge);
    if (!failure.empty()) return failure;
    Ring points = points_of_edge_.at(edge);
    if (IsReversed(file_.records[coedge], edge)) std::ranges::reverse(points);
    const size_t count = std::max<size_t>(1, points.size() - 1);
    ring->insert(ring->end(), points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count));
    return "";
  }

  int VertexOf(int record) {
    const auto [found, is_new] = vertex_of_record_.try_emplace(record, -1);
    if (!is_new) return found->second;
    const int point = file_.First(record, "point");
    const auto place = point < 0 ? std::nullopt : AcisPointOf(file_.records[point]);
    if (place) {
      found->second = static_cast<int>(local_.size());
      local_.push_back(*place);
    }
    return found->second;
  }

  // From its start to its end, made once.
  std::string FindPoints(int edge) {
    if (points_of_edge_.contains(edge)) return "";
    const std::vector<int> ends = file_.References(edge, "vertex");
    const int curve = file_.First(edge, "curve");
    const bool is_closed_curve = ends.empty() && curve >= 0;
    if (ends.empty() && !is_closed_curve) return "with an edge without ends";
    const int start = is_closed_curve ? -1 : VertexOf(ends.front());
    const int end = is_closed_curve ? -1 : VertexOf(ends.back());
    if (!is_closed_curve && (start < 0 || end < 0)) return "with an edge without ends";
    if (curve < 0) {  // the tip of a cone
      if (start != end) return "with an edge without a curve";
      points_of_edge_[edge] = {start};
      return "";
    }
    const std::string& type = file_.records[curve].type;
    if (type == "straight-curve") {
      if (start == end) return "with an edge without ends";
      points_of_edge_[edge] = {start, end};
      return "";
    }
    const bool is_reversed = IsReversed(file_.records[edge], curve);
    if (const auto ellipse = AcisEllipseOf(file_.records[curve])) {
      const auto place = [&](const Vector3d& p) { return ellipse->PointAt(ellipse->AngleOf(p)); };
      if (AreOff(place, start, end)) return kEndsOff;
      points_of_edge_[edge] = ArcPoints(*ellipse, start, end, is_reversed);
    } else if (const auto spline = AcisSplineOf(file_.records[curve])) {
      // The curve itself may run against its spline.
      const bool is_against = is_reversed != IsReversedSpline(file_.records[curve]);
      const auto place = [&](const Vector3d& p) { return spline->PointAt(spline->ParameterOf(p)); };
      if (AreOff(place, start, end)) return kEndsOff;
      const Ring points = CurvePoints(*spline, start, end, is_against);
      if (points.empty()) return "bounded by a closed " + type;
      points_of_edge_[edge] = points;
    } else {
      return "bounded by a " + type;
    }
    return "";
  }

  // Whether an edge's ends are not on its curve: it is another one than the file means.
  template <typename Place>
  bool AreOff(const Place& place, int start, int end) const {
    if (start < 0) return false;
    const Vector3d &a = local_[start], &b = local_[end];
    const double most = std::max(kOffSurface * (a - b).norm(), 10 * tolerance_ / ScaleOfBody());
    return (place(a) - a).norm() > most || (place(b) - b).norm() > most;
  }

  // The word before the spline.
  static bool IsReversedSpline(const AcisRecord& record) {
    size_t last = 0;
    for (size_t i = 0; i < record.tokens.size(); ++i) {
      if (record.tokens[i].kind == AcisToken::Kind::kReference) last = i;
      if (record.tokens[i].word == "{") break;
    }
    return IsAcisReversed(record, last);
  }

  // Between the places of its ends; a closed one as a whole. Empty: over the seam of a closed one.
  Ring CurvePoints(const AcisSpline& spline, int start, int end, bool is_reversed) {
    if (start < 0) {
      start = end = static_cast<int>(local_.size());
      local_.push_back(spline.PointAt(spline.begin()));
    }
    double from = is_reversed ? spline.end() : spline.begin();
    double to = is_reversed ? spline.begin() : spline.end();
    const bool is_closed = (spline.PointAt(from) - spline.PointAt(to)).norm() <
                           1e-6 * (spline.PointAt((from + to) / 2) - spline.PointAt(from)).norm();
    if (start != end) {
      double a = spline.ParameterOf(local_[start]), b = spline.ParameterOf(local_[end]);
      const double seam = 1e-6 * (spline.end() - spline.begin());
      const auto is_seam = [&](double t) {
        return std::min(t - spline.begin(), spline.end() - t) < seam;
      };
      if (is_closed && is_seam(a)) a = from;
      if (is_closed && is_seam(b)) b = to;
      if (is_closed && (b - a) * (to - from) <= 0) return {};  // over the seam
      from = a;
      to = b;
    }
    const std::vector<Vector3d> way = SplinePoints(spline, from, to, tolerance_ / ScaleOfBody());
    Ring points = {start};
    for (size_t i = 1; i + 1 < way.size(); ++i) {
      points.push_back(static_cast<int>(local_.size()));
      local_.push_back(way[i]);
    }
    points.push_back(end);
    return points;
  }

  // A whole ellipse where the ends are one.
  Ring ArcPoints(const AcisEllipse& ellipse, int start, int end, bool is_reversed) {
    constexpr double kWhole = 2 * std::numbers::pi;
    if (start < 0) {
      start = end = static_cast<int>(local_.size());
      local_.push_back(ellipse.PointAt(0));
    }
    const double from = ellipse.AngleOf(local_[start]);
    double sweep = start == end ? 0 : ellipse.AngleOf(local_[end]) - from;
    if (is_reversed) sweep = -sweep;
    if (sweep <= 1e-12) sweep += kWhole;
    if (is_reversed) sweep = -sweep;
    const double radius = std::max(ellipse.x.norm(), ellipse.y.norm());
    const double step = ChordAngle(radius, tolerance_ / ScaleOfBody());
    const int count =
        std::max(start == end ? 3 : 1, static_cast<int>(std::ceil(std::abs(sweep) / step - 1e-9)));
    Ring points = {start};
    for (int i = 1; i < count; ++i) {
      points.push_back(static_cast<int>(local_.size()));
      local_.push_back(ellipse.PointAt(from + sweep * i / count));
    }
    points.push_back(end);
    return points;
  }

  bool LieOn(const AcisSurface& surface, const std::vector<Ring>& rings) const {
    Eigen::AlignedBox3d box;
    double farthest = 0;
    for (const Ring& ring : rings) {
      for (const int vertex : ring) {
        box.extend(local_[vertex]);
        farthest = std::max(farthest, surface.DistanceTo(local_[vertex]));
      }
    }
    return rings.empty() || farthest <= kOffSurface * box.diagonal().norm();
  }

  Vector3d AreaOf(const Ring& ring) const {
    Vector3d area = Vector3d::Zero();
    const Vector3d& first = local_[ring[0]];
    for (size_t i = 1; i + 1 < ring.size(); ++i) {
      area += (local_[ring[i]] - first).cross(local_[ring[i + 1]] - first);
    }
    return area;
  }

  std::string AddPlane(const AcisSurface& surface, bool inwards, const std::vector<Ring>& rings) {
    const Vector3d normal = (inwards ? -1 : 1) * surface.axes.col(2);
    std::vector<Ring> outer, holes;
    for (const Ring& ring : rings) {
      if (ring.size() > kMostCorners) return "with over 10000 corners";
      (AreaOf(ring).dot(normal) > 0 ? outer : holes).push_back(ring);
    }
    if (outer.empty()) return "without an outline";
    int unplaced = 0;
    for (const Ring& outline : outer) {
      int lost = 0;
      const Ring joined =
          OutlineWithHoles(local_, outline, HolesWithin(outline, outer, holes, normal), &lost);
      const auto cut = FaceTriangles(local_, joined);
      unplaced += lost + (cut.empty() ? 1 : 0);
      shape_.triangles.insert(shape_.triangles.end(), cut.begin(), cut.end());
    }
    return unplaced > 0 ? "whose outline crosses itself or its holes" : "";
  }

  std::vector<Ring> HolesWithin(const Ring& outline, const std::vector<Ring>& outer,
                                const std::vector<Ring>& holes, const Vector3d& normal) const {
    if (outer.size() == 1) return holes;
    std::vector<Ring> within;
    const Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
    for (const Ring& hole : holes) {
      const Vector3d& p = local_[hole[0]];
      bool inside = false;
      for (size_t i = 0; i < outline.size(); ++i) {
        const Vector3d a = local_[outline[i]] - p,
                       b = local_[outline[(i + 1) % outline.size()]] - p;
        if ((a.dot(y) > 0) == (b.dot(y) > 0)) continue;
        const double share = a.dot(y) / (a.dot(y) - b.dot(y));
        if (a.dot(x) + share * (b - a).dot(x) > 0) inside = !inside;
      }
      if (inside) within.push_back(hole);
    }
    return within;
  }

  const AcisFile& file_;
  double tolerance_, most_vertices_;
  AcisShape shape_;
  Eigen::Affine3d body_ = Eigen::Affine3d::Identity();
  int body_record_ = -1;
  std::vector<Vector3d> local_;  // the shape's vertices in their body's frame
  size_t placed_ = 0;            // triangles
  std::map<int, Ring> points_of_edge_;
  std::map<int, int> vertex_of_record_;
};

}  // namespace

AcisShape FacetedAcis(const AcisFile& file, double tolerance, double most_vertices) {
  return BodyFaceter(file, tolerance, most_vertices).Run();
}

}  // namespace insitu
