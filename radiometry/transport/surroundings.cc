// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace insitu {
namespace {

// The building's faces win over polygons that survey noise leaves just before them.
constexpr double kCoincidence = 0.01;  // [m]

Eigen::AlignedBox3d BoxOf(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(vertex.cast<double>());
  // Embree's robust mode may report hits this far outside.
  if (box.isEmpty()) return box;
  return {box.min() - Eigen::Vector3d::Constant(1e-3), box.max() + Eigen::Vector3d::Constant(1e-3)};
}

bool MayMeet(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin,
             const Eigen::Vector3d& direction) {
  if (box.isEmpty()) return false;
  const Eigen::Array3d inverse = direction.array().inverse();
  const Eigen::Array3d a = (box.min() - origin).array() * inverse;
  const Eigen::Array3d b = (box.max() - origin).array() * inverse;
  const double far = a.max(b).minCoeff();
  return far >= 0 && a.min(b).maxCoeff() <= far;
}

uint32_t ClassOfCosine(const TriangleMesh& mesh, const RayHit& hit, const Ray& ray) {
  const auto corner = [&](int i) {
    return mesh.vertices[mesh.triangles[hit.triangle][i]].cast<double>().eval();
  };
  const Eigen::Vector3d normal =
      hit.sphere_normal ? *hit.sphere_normal
                        : (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized().eval();
  const double cosine = std::abs(normal.dot(ray.direction));
  constexpr int kLast = ClearFaces::kClasses - 1;
  return static_cast<uint32_t>(std::min(kLast, static_cast<int>(cosine * ClearFaces::kClasses)));
}

}  // namespace

Surroundings::Surroundings(const TransportScene& scene, const Daylight& light, Patches patches)
    : scene_(scene),
      planned_box_(BoxOf(scene.planned.mesh)),
      clear_box_(scene.planned.clear ? BoxOf(scene.planned.clear->mesh) : Eigen::AlignedBox3d()),
      zenith_(light.zenith_direction),
      sky_pieces_(light.Sky(), light.sky_shape.IsUniform(), light.zenith_direction),
      ground_(GroundOf(scene.site.scene, patches.grid())),
      patches_(std::move(patches)) {}

void Surroundings::MeetSite(const Ray& ray, const std::optional<RayHit>& hit,
                            Meeting* meeting) const {
  meeting->before = Meeting::kBeyond;
  if (hit) {
    const int polygon = scene_.site.polygon_of_triangle[hit->triangle];
    meeting->is_back = scene_.site.scene.polygons[polygon].normal.dot(ray.direction) > 0;
    meeting->distance = hit->distance;
    meeting->before =
        patches_.OfPolygon(polygon, meeting->is_back, ray.origin + hit->distance * ray.direction);
  } else if (ray.direction.dot(zenith_) > 0) {
    meeting->before = Meeting::kSky - sky_pieces_.Of(ray.direction);
  } else if (ground_) {
    meeting->before = GroundBeyond(ray);
  }
  meeting->after = meeting->before;
}

void Surroundings::MeetPlanned(const Ray& ray, const RayHit& hit, Meeting* meeting) const {
  const Eigen::Vector3d& normal = scene_.planned.NormalOf(hit);
  meeting->is_back = normal.dot(ray.direction) > 0;
  meeting->distance = hit.distance;
  meeting->material = scene_.planned.material_of_triangle[hit.triangle];
  const Eigen::Vector3d towards = meeting->is_back ? Eigen::Vector3d(-normal) : normal;
  const Eigen::Vector3d place = ray.origin + hit.distance * ray.direction;
  meeting->after = patches_.OfPlanned(towards, place);
  if (scene_.planned.IsTranslucent(meeting->material)) {
    meeting->behind = patches_.OfPlanned(-towards, place);
  }
}

std::vector<Meeting> Surroundings::Meet(const SurfacePoint& surface,
                                        const CosineDirections& directions) const {
  const Eigen::Vector3d origin = surface.position + kSurveyClearance * surface.normal;
  const std::vector<Eigen::Vector3d> all = directions.About(surface.normal);
  std::vector<Meeting> meetings(all.size());
  std::array<double, kPacketSize> far;
  for (size_t first = 0; first < all.size(); first += kPacketSize) {
    const size_t size = std::min<size_t>(kPacketSize, all.size() - first);
    const std::span<const Eigen::Vector3d> packet(&all[first], size);
    far.fill(std::numeric_limits<double>::infinity());
    const auto on_site = scene_.site.rays.NearestOfPacket(origin, packet, {far.data(), size});
    bool may_meet = false;
    for (size_t i = 0; i < size; ++i) {
      MeetSite({origin, packet[i]}, on_site[i], &meetings[first + i]);
      if (on_site[i]) far[i] = on_site[i]->distance + kCoincidence;
      may_meet = may_meet || MayMeet(planned_box_, origin, packet[i]);
    }
    if (may_meet) {
      const auto on_planned =
          scene_.planned.rays.NearestOfPacket(origin, packet, {far.data(), size});
      for (size_t i = 0; i < size; ++i) {
        if (on_planned[i]) MeetPlanned({origin, packet[i]}, *on_planned[i], &meetings[first + i]);
      }
    }
    for (size_t i = 0; i < size; ++i) {
      if (MayMeet(clear_box_, origin, packet[i])) {
        MeetGlass({origin, packet[i]}, &meetings[first + i]);
      }
    }
  }
  return meetings;
}

// A ray that goes through more panes than are counted loses nothing in the others; kinds of glass
// beyond the fifteenth count as the fifteenth.
void Surroundings::MeetGlass(const Ray& ray, Meeting* meeting) const {
  constexpr int kMostPanes = 4, kMostKinds = 15;
  const ClearFaces& clear = *scene_.planned.clear;
  Ray rest = ray;
  if (meeting->distance > 0) rest.far = meeting->distance;
  for (int i = 0; i < kMostPanes; ++i) {
    const auto hit = clear.rays.Nearest(rest);
    if (!hit) return;
    const int kind = std::min(clear.kind_of_triangle[hit->triangle], kMostKinds - 1);
    meeting->panes = meeting->panes << 8 | ClassOfCosine(clear.mesh, *hit, ray) << 4 |
                     static_cast<uint32_t>(kind + 1);
    rest.near = hit->distance + kSurveyClearance;
  }
}

Spectrum Surroundings::Through(const Meeting& meeting) const {
  Spectrum share = Spectrum::Ones();
  for (uint32_t panes = meeting.panes; panes != 0; panes >>= 8) {
    share *= scene_.planned.clear->transmittance[(panes & 15) - 1][panes >> 4 & 15];
  }
  return share;
}

int Surroundings::GroundBeyond(const Ray& ray) const {
  const auto place = ground_->Meet(scene_.site.scene, ray);
  const int face = static_cast<int>(scene_.site.scene.polygons.size());
  return place ? patches_.OfPolygon(face, false, *place) : Meeting::kBeyond;
}

}  // namespace insitu
