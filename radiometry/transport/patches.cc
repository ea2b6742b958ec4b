// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "radiometry/light/split_mix.h"

namespace insitu {
namespace {

// Distance in voxels at which they double.
constexpr double kReachOfSize = 5;
constexpr double kReachOfGround = 8;  // in sizes of the focus, at least
// No boundary at round coordinates, where planes lie: points of one would fall to either side.
constexpr double kShift = 0.37;  // of a voxel

uint64_t VoxelKey(uint64_t face, const GridPlace& place) {
  const Eigen::Array3d cell = place.Voxel();
  uint64_t key = SplitMix64(face + (static_cast<uint64_t>(place.level) << 56));
  for (int i = 0; i < 3; ++i) {
    // Each in turn: a product alone gives voxels that mirror each other in two axes one key.
    key = SplitMix64(key ^ static_cast<uint64_t>(static_cast<int64_t>(cell[i])));
  }
  return key;
}

uint64_t FaceOf(int face, bool is_back) { return 2 * static_cast<uint64_t>(face) + is_back; }

// One of 26: planned faces that look about the same way share a voxel's piece.
uint64_t FaceLooking(const Eigen::Vector3d& normal) {
  uint64_t face = 0;
  for (int i = 0; i < 3; ++i) {
    face = 3 * face + static_cast<uint64_t>(std::llround(std::round(1.3 * normal[i])) + 1);
  }
  return face | uint64_t{1} << 48;
}

}  // namespace

SurfacePoint PointOnFace(const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& normals,
                         int triangle, const Eigen::Vector3d& flat) {
  const MeshSphere* sphere = mesh.SphereOf(triangle);
  if (!sphere) return {flat, normals[triangle]};
  const Eigen::Vector3d out = (flat - sphere->center).normalized();
  return {sphere->center + sphere->radius * out, out};
}

Eigen::Array3d GridPlace::Voxel() const { return (position.array() / size + kShift).floor(); }

double GridPlace::OffCenter() const {
  return ((Voxel() + 0.5 - kShift) * size - position.array()).matrix().norm();
}

GridPlace PatchGrid::At(const Eigen::Vector3d& position) const {
  double reach = kReachOfSize * size, squared = std::numeric_limits<double>::infinity();
  for (const Eigen::AlignedBox3d& focus : foci) {
    const Eigen::Array3d before = (focus.min() - position).array();
    const Eigen::Array3d outside = before.max((position - focus.max()).array()).max(0);
    squared = std::min(squared, outside.square().sum());
    if (squared <= reach * reach) return {position, 0, size};
  }
  GridPlace place{position, 0, size};
  for (; squared > reach * reach; reach *= 2) ++place.level;
  place.size = std::ldexp(size, place.level);
  return place;
}

std::optional<Eigen::Vector3d> GroundPlane::Meet(const SceneGeometry& scene, const Ray& ray) const {
  const Eigen::Vector3d& normal = scene.polygons[polygon].normal;
  const double distance = normal.dot(center - ray.origin) / normal.dot(ray.direction);
  if (!(distance > 0)) return std::nullopt;
  const Eigen::Vector3d from_center = ray.origin + distance * ray.direction - center;
  return center + from_center * std::min(1.0, reach / std::max(from_center.norm(), 1e-9));
}

std::optional<GroundPlane> GroundOf(const SceneGeometry& scene, const PatchGrid& grid) {
  Eigen::AlignedBox3d focus;
  for (const Eigen::AlignedBox3d& one : grid.foci) focus.extend(one);
  const std::optional<int> largest = LargestLevelPolygon(scene);
  if (!largest) return std::nullopt;
  const Polygon& polygon = scene.polygons[*largest];
  const Eigen::Vector3d above = focus.center() - (polygon.vertices[0] - scene.origin);
  GroundPlane ground;
  ground.polygon = *largest;
  ground.center = focus.center() - polygon.normal.dot(above) * polygon.normal;
  ground.reach = kReachOfGround * focus.diagonal().norm();
  for (const Polygon& other : scene.polygons) {
    for (const Eigen::Vector3d& vertex : other.vertices) {
      ground.reach = std::max(ground.reach, (vertex - scene.origin - ground.center).norm());
    }
  }
  return ground;
}

size_t VoxelTable::SlotOf(uint64_t key) const {
  const size_t mask = slots_.size() - 1;
  size_t slot = key & mask;
  while (slots_[slot].second >= 0 && slots_[slot].first != key) slot = (slot + 1) & mask;
  return slot;
}

int VoxelTable::Find(uint64_t key) const { return slots_[SlotOf(key)].second; }

int VoxelTable::Insert(uint64_t key, int number) {
  std::pair<uint64_t, int>& slot = slots_[SlotOf(key)];
  if (slot.second >= 0) return slot.second;
  slot = {key, number};
  if (2 * ++used_ > slots_.size()) Grow();
  return number;
}

void VoxelTable::Grow() {
  const auto old = std::exchange(slots_, decltype(slots_)(2 * slots_.size(), {0, -1}));
  for (const auto& entry : old) {
    if (entry.second >= 0) slots_[SlotOf(entry.first)] = entry;
  }
}

int Patches::Find(uint64_t face, const Eigen::Vector3d& position) const {
  const int own = of_voxel_.Find(VoxelKey(face, grid_.At(position)));
  if (own >= 0) return own;
  const auto same = of_face_.find(face);
  if (same == of_face_.end()) return -1;
  return *std::ranges::min_element(
      same->second, {}, [&](int i) { return (all_[i].point.position - position).squaredNorm(); });
}

int Patches::Add(uint64_t face, const GridPlace& place) {
  const int next = static_cast<int>(all_.size());
  const int index = of_voxel_.Insert(VoxelKey(face, place), next);
  if (index == next) {
    of_face_[face].push_back(index);
    all_.emplace_back();
  }
  return index;
}

int Patches::OfPolygon(int face, bool is_back, const Eigen::Vector3d& position) const {
  return Find(FaceOf(face, is_back), position);
}

int Patches::OfPlanned(const Eigen::Vector3d& normal, const Eigen::Vector3d& position) const {
  return Find(FaceLooking(normal), position);
}

int Patches::AddOfPolygon(int face, bool is_back, const GridPlace& place) {
  return Add(FaceOf(face, is_back), place);
}

int Patches::AddPlanned(const Eigen::Vector3d& normal, const GridPlace& place) {
  return Add(FaceLooking(normal), place);
}

}  // namespace insitu
