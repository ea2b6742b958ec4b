// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/make_patches.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <optional>
#include <utility>

namespace insitu {
namespace {

constexpr int kMostPoints = 16;  // of a piece that are looked at
constexpr size_t kPointsAtOnce = 1 << 14;

using Corners = std::array<Eigen::Vector3d, 3>;

// Calls visit(centroid, area) for parts of a triangle whose edges are at most half a voxel long.
template <typename Visit>
void ForParts(const PatchGrid& grid, const Corners& corners, const Visit& visit) {
  int longest = 0;
  double length = 0;
  for (int i = 0; i < 3; ++i) {
    const double edge = (corners[(i + 1) % 3] - corners[i]).norm();
    if (edge <= length) continue;
    length = edge;
    longest = i;
  }
  const GridPlace centroid = grid.At((corners[0] + corners[1] + corners[2]) / 3);
  if (length <= centroid.size / 2) {
    visit(centroid, (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() / 2);
    return;
  }
  const Eigen::Vector3d middle = (corners[longest] + corners[(longest + 1) % 3]) / 2;
  for (int end : {longest, (longest + 1) % 3}) {
    Corners half = corners;
    half[end] = middle;
    ForParts(grid, half, visit);
  }
}

Corners CornersOf(const TriangleMesh& mesh, size_t triangle) {
  Corners corners;
  for (int i = 0; i < 3; ++i) {
    corners[i] = mesh.vertices[mesh.triangles[triangle][i]].cast<double>();
  }
  return corners;
}

// A square that holds all of the plane that counts.
std::array<Corners, 2> HalvesOf(const GroundPlane& ground, const SceneGeometry& scene) {
  const Eigen::Vector3d& normal = scene.polygons[ground.polygon].normal;
  const Eigen::Vector3d u = ground.reach * normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  const Eigen::Vector3d& c = ground.center;
  return {Corners{c - u - v, c + u - v, c + u + v}, Corners{c - u - v, c + u + v, c - u + v}};
}

// Sums while points come in, then means.
struct Sums {
  int points = 0, seen = 0;
  bool is_open = false;  // points outside the planned building alone
  double off_center = std::numeric_limits<double>::infinity();  // of the best point so far [m]
};

// A point that counts for a piece.
struct PiecePoint {
  SurfacePoint point;
  int piece = 0;
  int polygon = -1;       // whose colour photographs are asked for; -1: of a planned face
  bool restarts = false;  // the piece's points before do not count for its sun
  double sun_before = 0;  // as of Patch
  Spectrum sun_after = Spectrum::Zero();
  std::optional<Spectrum> color = {};
};

class PatchMaker {
 public:
  PatchMaker(const PhotographedSite& site, const PlannedFaces& planned, const Daylight& light,
             const PatchGrid& grid)
      : site_(site), planned_(planned), light_(light), patches_(grid) {}

  // `face` is `polygon`, or one after them that lies in its plane.
  void AddPolygonPart(int face, int polygon, bool is_back, const GridPlace& place, double area) {
    const Eigen::Vector3d& normal = site_.scene.polygons[polygon].normal;
    const SurfacePoint point = {place.position, is_back ? Eigen::Vector3d(-normal) : normal};
    const int index = patches_.AddOfPolygon(face, is_back, place);
    patches_.all()[index].polygon = polygon;
    patches_.all()[index].is_beyond = face != polygon;
    AddPoint(index, polygon, point, place.OffCenter(), area);
  }

  void AddPlannedPart(const SurfacePoint& point, double area) {
    const GridPlace place = patches_.grid().At(point.position);
    AddPoint(patches_.AddPlanned(point.normal, place), -1, point, place.OffCenter(), area);
  }

  Patches Finish() {
    SumPoints();
    for (size_t i = 0; i < sums_.size(); ++i) {
      Patch& patch = patches_.all()[i];
      const Sums& sums = sums_[i];
      patch.sun_before /= sums.points;
      patch.sun_after /= sums.points;
      patch.is_seen = sums.seen > 0;
      if (patch.is_seen) patch.photographed /= sums.seen;
    }
    return std::move(patches_);
  }

 private:
  // Until the piece needs no more points. One that is partly within the planned building is seen
  // where it is not: points in the open stand for it.
  void AddPoint(int index, int polygon, const SurfacePoint& point, double off_center, double area) {
    sums_.resize(patches_.all().size());
    Patch& patch = patches_.all()[index];
    Sums& sums = sums_[index];
    patch.area += area;
    const bool is_full = sums.is_open && sums.points >= kMostPoints;
    if (is_full && off_center >= sums.off_center) return;
    const bool is_open = !IsWithinPlanned(point);
    if (sums.is_open && !is_open) return;
    const bool restarts = is_open && !sums.is_open;
    if (restarts) sums = {.seen = sums.seen, .is_open = true};
    if (off_center < sums.off_center) {
      sums.off_center = off_center;
      patch.point = point;
    }
    if (sums.points >= kMostPoints) return;
    ++sums.points;
    points_.push_back({.point = point, .piece = index, .polygon = polygon, .restarts = restarts});
    if (points_.size() == kPointsAtOnce) SumPoints();
  }

  bool IsWithinPlanned(const SurfacePoint& point) const {
    if (planned_.mesh.triangles.empty()) return false;
    const Ray ray = {point.position + kSurveyClearance * point.normal, point.normal};
    const auto hit = planned_.rays.Nearest(ray);
    return hit && planned_.NormalOf(*hit).dot(ray.direction) > 0;
  }

  // Rays and look-ups, by all threads; then the sums, in the order in which points came, so that
  // threads change nothing.
  void SumPoints() {
    tbb::parallel_for(size_t{0}, points_.size(), [&](size_t i) {
      SetSun(&points_[i]);
      if (points_[i].polygon < 0) return;
      points_[i].color = LookUpColor(site_, points_[i].polygon, points_[i].point);
    });
    for (const PiecePoint& point : points_) {
      Patch& patch = patches_.all()[point.piece];
      if (point.restarts) {
        patch.sun_before = 0;
        patch.sun_after.setZero();
      }
      patch.sun_before += point.sun_before;
      patch.sun_after += point.sun_after;
      if (!point.color) continue;
      patch.photographed += *point.color;
      ++sums_[point.piece].seen;
    }
    points_.clear();
  }

  void SetSun(PiecePoint* to) const {
    const SurfacePoint& point = to->point;
    const double cosine = point.normal.dot(light_.sun_direction);
    if (cosine <= 0 || light_.zenith_direction.dot(light_.sun_direction) <= 0) return;
    const Ray ray = {point.position + kSurveyClearance * point.normal, light_.sun_direction};
    if (site_.rays.IsOccluded(ray)) return;
    to->sun_before = cosine * light_.sun_solid_angle;
    if (planned_.clear) {
      to->sun_after = to->sun_before * planned_.clear->transmittance_along(ray);
    } else if (!planned_.rays.IsOccluded(ray)) {
      to->sun_after.setConstant(to->sun_before);
    }
  }

  const PhotographedSite& site_;
  const PlannedFaces& planned_;
  const Daylight& light_;
  Patches patches_;
  std::vector<Sums> sums_;
  std::vector<PiecePoint> points_;  // not summed yet
};

}  // namespace

Patches MakePatches(const PhotographedSite& site, const TriangleMesh& natural,
                    const PlannedFaces& planned, const std::optional<GroundPlane>& ground,
                    const Daylight& light, const PatchGrid& grid) {
  PatchMaker maker(site, planned, light, grid);
  for (size_t t = 0; t < natural.triangles.size(); ++t) {
    const int polygon = site.polygon_of_triangle[t];
    ForParts(grid, CornersOf(natural, t), [&](const GridPlace& place, double area) {
      for (bool is_back : {false, true}) {
        maker.AddPolygonPart(polygon, polygon, is_back, place, area);
      }
    });
  }
  if (ground) {
    const int beyond = static_cast<int>(site.scene.polygons.size());
    for (const Corners& half : HalvesOf(*ground, site.scene)) {
      ForParts(grid, half, [&](const GridPlace& place, double area) {
        maker.AddPolygonPart(beyond, ground->polygon, false, place, area);
      });
    }
  }
  for (size_t t = 0; t < planned.mesh.triangles.size(); ++t) {
    ForParts(grid, CornersOf(planned.mesh, t), [&](const GridPlace& place, double area) {
      const SurfacePoint front =
          PointOnFace(planned.mesh, planned.normals, static_cast<int>(t), place.position);
      maker.AddPlannedPart(front, area);
      maker.AddPlannedPart({front.position, -front.normal}, area);
    });
  }
  return maker.Finish();
}

}  // namespace insitu
