// SPDX-License-Identifier: GPL-3.0-or-later
// Rays against triangles and spheres, by Embree: nearest hit and occlusion. Geometry only, no
// light, so that radiometry can ask for visibility too.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "reconstruction/geometry/scene_geometry.h"
#include "reconstruction/geometry/sphere_facets.h"

namespace insitu {

struct Ray {
  Eigen::Vector3d origin;     // [m], in the scene's local frame (world minus its origin)
  Eigen::Vector3d direction;  // unit
  double near = 0;            // [m], hits closer are ignored
  double far = std::numeric_limits<double>::infinity();
};

struct RayHit {
  double distance = 0;  // [m]
  int triangle = 0;     // index into the triangles given; on a sphere: the facet below
  Eigen::Vector2d uv;   // barycentric weights of the triangle's second and third corner
  std::optional<Eigen::Vector3d> sphere_normal = {};  // of a sphere that was met: unit, outwards
};

// Facets stand for it where places are counted by triangles; rays meet the sphere itself.
struct MeshSphere {
  Eigen::Vector3d center;  // [m], local
  double radius = 0;       // [m]
  int first_facet = 0;     // index of the first of its kSphereFacets triangles
};

constexpr int kSphereLevel = 3;
constexpr int kSphereFacets = SphereFacetCount(kSphereLevel);

// Triangles as three corners each, about a local origin so that single precision suffices.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;  // [m], local
  std::vector<Eigen::Vector3i> triangles;
  std::vector<MeshSphere> spheres =
      {};  // in the order of their facets, which are the last triangles

  // The sphere that a triangle is a facet of; nullptr: none.
  const MeshSphere* SphereOf(int triangle) const {
    if (spheres.empty() || triangle < spheres.front().first_facet) return nullptr;
    return &spheres[static_cast<size_t>((triangle - spheres.front().first_facet) / kSphereFacets)];
  }
};

constexpr int kPacketSize = 16;

class RayScene {
 public:
  explicit RayScene(const TriangleMesh& mesh);  // an empty mesh is allowed: nothing is ever hit
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  std::optional<RayHit> Nearest(const Ray& ray) const;
  bool IsOccluded(const Ray& ray) const;

  // Up to 16 directions from one origin at once (Embree packets), each to its own `far`, where hits
  // end: what Nearest says of each. Fastest where the directions lie close together.
  std::array<std::optional<RayHit>, kPacketSize> NearestOfPacket(
      const Eigen::Vector3d& origin, std::span<const Eigen::Vector3d> directions,
      std::span<const double> far) const;

  // Up to 16 directions from one origin at once (Embree packets). Bit i of the result: direction i
  // is blocked between `near` and infinity.
  uint16_t OcclusionMask(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3f> directions,
                         double near) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

// The natural environment's polygons as triangles; polygon_of_triangle[t] indexes scene.polygons.
struct PolygonMesh {
  TriangleMesh mesh;
  std::vector<int> polygon_of_triangle;
};
PolygonMesh MeshOfPolygons(const SceneGeometry& scene);

}  // namespace insitu
