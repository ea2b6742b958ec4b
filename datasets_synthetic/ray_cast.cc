// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/ray_cast.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace insitu::demo {
namespace {

bool MeetsSphere(const Face& face, const Ray& ray) {
  const Eigen::Vector3d to_center = face.center - ray.origin;
  const double along = to_center.dot(ray.direction);
  const double square = face.radius * face.radius;
  if (along < 0 && to_center.squaredNorm() > square) return false;
  return to_center.squaredNorm() - along * along <= square;
}

// Slab test of Kay and Kajiya, ACM SIGGRAPH 1986.
inline bool MeetsBox(const Eigen::AlignedBox3d& box, const Ray& ray, const Eigen::Array3d& inverse,
                     double limit) {
  const Eigen::Array3d a = (box.min() - ray.origin).array() * inverse;
  const Eigen::Array3d b = (box.max() - ray.origin).array() * inverse;
  const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
  return enter <= leave && leave >= 0 && enter < limit;
}

// Calls `visit(face, distance)` for faces closer than `limit`, in no order; it returns the new
// limit.
template <typename Visit>
void ForEachHit(const Scene& scene, const Ray& ray, double limit, const Visit& visit) {
  const Eigen::Array3d inverse = ray.direction.cwiseInverse();
  std::array<int, 64> pending;
  int waiting = 0;
  if (!scene.nodes.empty()) pending[waiting++] = 0;
  while (waiting > 0) {
    const int index = pending[--waiting];
    const BoxNode& node = scene.nodes[index];
    if (!MeetsBox(node.box, ray, inverse, limit)) continue;
    for (int i = 0; i < node.faces; ++i) {
      const Face& face = scene.faces[node.first_face + i];
      const std::optional<double> distance = Intersect(face, ray);
      if (distance && *distance < limit) limit = visit(face, *distance);
    }
    if (node.faces > 0) continue;
    // The nearer half first: what it shows hides most of the other.
    const bool forward = ray.direction[node.axis] > 0;
    pending[waiting++] = forward ? node.second : index + 1;
    pending[waiting++] = forward ? index + 1 : node.second;
  }
}

}  // namespace

// Even-odd rule, good for concave outlines.
bool Contains(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& point) {
  bool inside = false;
  for (size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Eigen::Vector2d &a = outline[i], &b = outline[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double crossing = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < crossing) inside = !inside;
  }
  return inside;
}

std::optional<double> Intersect(const Face& face, const Ray& ray) {
  if (!MeetsSphere(face, ray)) return std::nullopt;
  const double slope = face.normal.dot(ray.direction);
  if (slope == 0) return std::nullopt;
  const double distance = face.normal.dot(face.vertices[0] - ray.origin) / slope;
  if (!(distance > 0)) return std::nullopt;
  if (!Contains(face.outline, face.Local(ray.origin + distance * ray.direction))) {
    return std::nullopt;
  }
  return distance;
}

std::optional<Hit> NearestHit(const Scene& scene, const Ray& ray, double limit) {
  std::optional<Hit> nearest;
  ForEachHit(scene, ray, limit, [&](const Face& face, double distance) {
    nearest = {&face, distance};
    return distance;
  });
  return nearest;
}

bool IsBlocked(const Scene& scene, const Ray& ray, double limit) {
  bool blocked = false;
  ForEachHit(scene, ray, limit, [&](const Face&, double) {
    blocked = true;
    return -1.0;  // nothing else matters
  });
  return blocked;
}

}  // namespace insitu::demo
