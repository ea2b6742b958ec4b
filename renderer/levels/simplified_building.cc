// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/levels/simplified_building.h"

#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <vector>

#include "renderer/trace/make_montage_scene.h"

namespace insitu {
namespace {

Eigen::AlignedBox3d BoxOfVertices(const ArtificialEnvironment& building) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : building.vertices) box.extend(vertex);
  return box;
}

Eigen::AlignedBox3d BoxOf(const ArtificialEnvironment& building) {
  Eigen::AlignedBox3d box = BoxOfVertices(building);
  for (const EnvironmentSphere& sphere : building.spheres) {
    box.extend(sphere.center - Eigen::Vector3d::Constant(sphere.radius));
    box.extend(sphere.center + Eigen::Vector3d::Constant(sphere.radius));
  }
  return box;
}

bool MayBeCoarser(const SurfaceMaterial& material) {
  return !material.glass && material.texture.empty() && material.maps.empty();
}

// The corners of triangles by material; first those that stay as they are.
struct SortedCorners {
  std::vector<size_t> kept;                            // triangles
  std::vector<std::vector<unsigned int>> of_material;  // corners, three a triangle
};

SortedCorners Sorted(const ArtificialEnvironment& building) {
  SortedCorners sorted;
  sorted.of_material.resize(building.materials.size());
  for (size_t t = 0; t < building.triangles.size(); ++t) {
    const auto material = static_cast<size_t>(building.material_of_triangle[t]);
    if (!MayBeCoarser(building.materials[material])) {
      sorted.kept.push_back(t);
      continue;
    }
    for (const int corner : building.triangles[t]) {
      sorted.of_material[material].push_back(static_cast<unsigned int>(corner));
    }
  }
  return sorted;
}

// The library's cells are a thousandth of a mesh at least; coarser ones than wanted would be seen.
constexpr double kFinestCell = 1e-3;

class Simplifier {
 public:
  Simplifier(const ArtificialEnvironment& building, const Eigen::AlignedBox3d& box)
      : building_(building), extent_(box.sizes().maxCoeff()) {
    for (const Eigen::Vector3d& vertex : building.vertices) {
      positions_.push_back((vertex - box.min()).cast<float>());
    }
    if (building.corner_normals.empty()) return;
    normal_of_vertex_.resize(building.vertices.size(), Eigen::Vector3f::Zero());
    for (size_t i = 0; i < building.corner_normals.size(); ++i) {
      normal_of_vertex_[building.triangles[i / 3][static_cast<int>(i % 3)]] =
          building.corner_normals[i];
    }
  }

  ArtificialEnvironment At(double size) {
    const SortedCorners sorted = Sorted(building_);
    simple_ = {.materials = building_.materials,
               .vertices = building_.vertices,
               .triangles = {},
               .material_of_triangle = {},
               .corner_normals = {},
               .corner_uvs = {},
               .spheres = building_.spheres,
               .lights = building_.lights};
    for (const size_t t : sorted.kept) Keep(t);
    for (size_t material = 0; material < sorted.of_material.size(); ++material) {
      AddCoarser(sorted.of_material[material], static_cast<int>(material), size);
    }
    return std::move(simple_);
  }

 private:
  void Keep(size_t triangle) {
    simple_.triangles.push_back(building_.triangles[triangle]);
    simple_.material_of_triangle.push_back(building_.material_of_triangle[triangle]);
    for (size_t i = 3 * triangle; i < 3 * triangle + 3; ++i) {
      if (!building_.corner_normals.empty()) {
        simple_.corner_normals.push_back(building_.corner_normals[i]);
      }
      if (!building_.corner_uvs.empty()) simple_.corner_uvs.push_back(building_.corner_uvs[i]);
    }
  }

  void AddCoarser(const std::vector<unsigned int>& corners, int material, double size) {
    if (corners.empty()) return;
    std::vector<unsigned int> coarser(corners.size());
    coarser.resize(meshopt_simplifySloppy(
        coarser.data(), corners.data(), corners.size(), positions_.front().data(),
        positions_.size(), sizeof(positions_.front()), 0, static_cast<float>(size / extent_)));
    for (size_t i = 0; i < coarser.size(); ++i) {
      const int corner = static_cast<int>(coarser[i]);
      if (i % 3 == 0) {
        simple_.triangles.emplace_back();
        simple_.material_of_triangle.push_back(material);
      }
      simple_.triangles.back()[static_cast<int>(i % 3)] = corner;
      if (!normal_of_vertex_.empty()) simple_.corner_normals.push_back(normal_of_vertex_[corner]);
      if (!building_.corner_uvs.empty()) simple_.corner_uvs.push_back(Eigen::Vector2f::Zero());
    }
  }

  const ArtificialEnvironment& building_;
  const double extent_;  // [m]
  std::vector<Eigen::Vector3f> positions_, normal_of_vertex_;
  ArtificialEnvironment simple_;
};

}  // namespace

double OcclusionSize(const NaturalEnvironment& natural, const ArtificialEnvironment& building,
                     double pixels) {
  const Eigen::AlignedBox3d box = BoxOf(building);
  if (box.isEmpty()) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const PosedCamera& camera : natural.scene.cameras) {
    nearest = std::min(nearest, box.exteriorDistance(Center(camera.cam_from_world)));
  }
  return nearest * PixelAngle(natural) * pixels;
}

ArtificialEnvironment Simplified(const ArtificialEnvironment& building, double size) {
  if (building.triangles.size() < kFewTriangles || !(size > 0)) return building;
  const Eigen::AlignedBox3d box = BoxOfVertices(building);
  if (size < kFinestCell * box.sizes().maxCoeff()) return building;
  return Simplifier(building, box).At(size);
}

}  // namespace insitu
