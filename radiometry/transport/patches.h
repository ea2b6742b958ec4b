// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces in pieces, small near the planned building and larger away from it: what light comes
// back from. A piece is known by the face and the voxel that it lies in, so that a point finds its
// own at once, however many triangles there are.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "radiometry/light/photographed_color.h"
#include "radiometry/spectrum/spectrum.h"
#include "reconstruction/geometry/ray_scene.h"

namespace insitu {

// Glass of the planned building, straight through which light goes, dimmed and tinted; what it
// mirrors is not followed.
struct ClearFaces {
  const TriangleMesh& mesh;
  const RayScene& rays;                      // of `mesh`
  const std::vector<int>& kind_of_triangle;  // index into transmittance
  // 0..1, by the cosine at which light meets it: of the middle of each of equal classes.
  static constexpr int kClasses = 16;
  std::vector<std::array<Spectrum, kClasses>> transmittance;
  // Of the building along a ray, 0 behind what is opaque.
  std::function<Spectrum(const Ray&)> transmittance_along;
};

// The planned building as light meets it; all of one size, in the site's local frame.
struct PlannedFaces {
  const TriangleMesh& mesh;
  const RayScene& rays;                         // of `mesh`
  const std::vector<Eigen::Vector3d>& normals;  // of each triangle, unit
  const std::vector<int>& material_of_triangle;
  const std::vector<Spectrum>& brdf_of_material;  // diffuse [1/sr]
  const ClearFaces* clear = nullptr;              // nullptr: nothing is of glass
  // What of the irradiance of a face's other side it sends to this one [1/sr]; nullptr: nothing.
  const std::vector<Spectrum>* translucence_of_material = nullptr;

  const Eigen::Vector3d& NormalOf(const RayHit& hit) const {
    return hit.sphere_normal ? *hit.sphere_normal : normals[hit.triangle];
  }
  bool IsTranslucent(int material) const {
    return translucence_of_material && ((*translucence_of_material)[material] > 0).any();
  }
};

// The point of a face below or above `flat`, a point of its triangle [m], on the normal's side: on
// a sphere where the radius passes.
SurfacePoint PointOnFace(const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& normals,
                         int triangle, const Eigen::Vector3d& flat);

struct Patch {
  SurfacePoint point;                        // where its light is gathered
  int polygon = -1;                          // of the site; -1: planned faces
  bool is_beyond = false;                    // in the polygon's plane, but outside it
  double area = 0;                           // [m^2]
  bool is_seen = false;                      // by a photograph
  Spectrum photographed = Spectrum::Zero();  // mean radiance, if seen
  // n.d_s Omega_s of what the sun sees of it [sr], without the planned building, and with it, times
  // what its glass lets through.
  double sun_before = 0;
  Spectrum sun_after = Spectrum::Zero();
};

// A position [m], local, and its voxel.
struct GridPlace {
  Eigen::Vector3d position;
  int level = 0;    // how often the size has doubled
  double size = 1;  // of the voxel [m]

  // The voxel, counted in sizes.
  Eigen::Array3d Voxel() const;
  // How far from its middle the position lies [m].
  double OffCenter() const;
};

// Where pieces are smallest, and how small.
struct PatchGrid {
  std::vector<Eigen::AlignedBox3d> foci;  // [m], local; at least one
  double size = 1;  // side of a voxel in and near the foci [m]; it doubles with distance

  // Takes as long as there are foci.
  GridPlace At(const Eigen::Vector3d& position) const;
};

// The plane of the ground beyond its polygon: what is there, photographs may show.
struct GroundPlane {
  int polygon = 0;         // of the site, whose plane and material it shares
  Eigen::Vector3d center;  // [m], local, on the plane, below the focus
  double reach = 0;        // [m]; what is farther counts as its edge

  // Where a ray meets it, or its edge in that direction; nullopt if it looks away.
  std::optional<Eigen::Vector3d> Meet(const SceneGeometry& scene, const Ray& ray) const;
};

// On the largest polygon that lies level; nullopt if none does.
std::optional<GroundPlane> GroundOf(const SceneGeometry& scene, const PatchGrid& grid);

// Numbers by key, for many more look-ups than entries: open addressing in one block of memory.
class VoxelTable {
 public:
  // -1 if there is none.
  int Find(uint64_t key) const;
  // The number under the key, `number` if there was none.
  int Insert(uint64_t key, int number);

 private:
  size_t SlotOf(uint64_t key) const;  // where it stands, or the empty one where it would
  void Grow();

  std::vector<std::pair<uint64_t, int>> slots_ = std::vector<std::pair<uint64_t, int>>(64, {0, -1});
  size_t used_ = 0;
};

class Patches {
 public:
  explicit Patches(const PatchGrid& grid) : grid_(grid) {}

  const PatchGrid& grid() const { return grid_; }
  const std::vector<Patch>& all() const { return all_; }
  std::vector<Patch>& all() { return all_; }

  // The piece at a point of a site's face, or at one of the planned faces; the nearest of the same
  // face where the voxel holds none; -1 if it has none at all. A face of the site is a polygon, or,
  // numbered after them, the ground beyond its polygon.
  int OfPolygon(int face, bool is_back, const Eigen::Vector3d& position) const;
  int OfPlanned(const Eigen::Vector3d& normal, const Eigen::Vector3d& position) const;

  // The same, made if there is none.
  int AddOfPolygon(int face, bool is_back, const GridPlace& place);
  int AddPlanned(const Eigen::Vector3d& normal, const GridPlace& place);

 private:
  int Find(uint64_t face, const Eigen::Vector3d& position) const;
  int Add(uint64_t face, const GridPlace& place);

  PatchGrid grid_;
  std::vector<Patch> all_;
  VoxelTable of_voxel_;
  std::unordered_map<uint64_t, std::vector<int>> of_face_;
};

}  // namespace insitu
