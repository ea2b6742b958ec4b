// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/model.h"

#include <Eigen/Geometry>

#include "calibration/files/plain_text.h"

namespace insitu {
namespace {

using Eigen::Vector3i;

std::string KeyOf(const SurfaceNames& names) {
  std::string key = names.layer + '\0' + names.block + '\0' + names.material + '\0' +
                    names.texture + '\0' + std::to_string(names.opacity) + '\0' +
                    std::to_string(names.index) + (names.is_solid ? "s" : "p");
  key.append(reinterpret_cast<const char*>(names.absorption_rgb.data()), sizeof(double) * 3);
  key.append(reinterpret_cast<const char*>(names.translucent_rgb.data()), sizeof(double) * 3);
  key += std::to_string(names.diffuse_weight);
  for (const SurfaceMap& map : names.maps) {
    key += '\0' + map.file + std::to_string(static_cast<int>(map.kind)) +
           std::to_string(map.channel) + std::to_string(map.factor);
  }
  if (names.rgb) key.append(reinterpret_cast<const char*>(names.rgb->data()), sizeof(double) * 3);
  return key;
}

Eigen::Vector3f FacetNormal(const ModelMesh& mesh, const Vector3i& t) {
  const Eigen::Vector3d& a = mesh.vertices[t[0]];
  return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).normalized().cast<float>();
}

void AppendCornerNormals(const ModelMesh& other, size_t triangles_before, ModelMesh* mesh) {
  if (other.corner_normals.empty() && mesh->corner_normals.empty()) return;
  const auto fill = [](const ModelMesh& from, size_t count, std::vector<Eigen::Vector3f>* to) {
    for (size_t t = 0; t < count; ++t)
      to->insert(to->end(), 3, FacetNormal(from, from.triangles[t]));
  };
  if (mesh->corner_normals.empty()) fill(*mesh, triangles_before, &mesh->corner_normals);
  if (other.corner_normals.empty()) {
    fill(other, other.triangles.size(), &mesh->corner_normals);
  } else {
    mesh->corner_normals.insert(mesh->corner_normals.end(), other.corner_normals.begin(),
                                other.corner_normals.end());
  }
}

void AppendCornerUvs(const ModelMesh& other, size_t triangles_before, ModelMesh* mesh) {
  if (other.corner_uvs.empty() && mesh->corner_uvs.empty()) return;
  mesh->corner_uvs.resize(3 * triangles_before, Eigen::Vector2f(0, 0));
  mesh->corner_uvs.insert(mesh->corner_uvs.end(), other.corner_uvs.begin(), other.corner_uvs.end());
  mesh->corner_uvs.resize(3 * mesh->triangles.size(), Eigen::Vector2f(0, 0));
}

// Indices of the kept elements, in the order of their first use.
class Renumbering {
 public:
  explicit Renumbering(size_t size) : new_of_old_(size, kUnseen) {}

  int Keep(int old) {
    if (new_of_old_[old] == kUnseen) {
      new_of_old_[old] = static_cast<int>(old_of_new_.size());
      old_of_new_.push_back(old);
    }
    return new_of_old_[old];
  }
  template <typename T>
  std::vector<T> Kept(const std::vector<T>& all) const {
    std::vector<T> kept;
    kept.reserve(old_of_new_.size());
    for (const int old : old_of_new_) kept.push_back(all[old]);
    return kept;
  }
  bool KeepsAll() const { return old_of_new_.size() == new_of_old_.size(); }

 private:
  static constexpr int kUnseen = -1;
  std::vector<int> new_of_old_, old_of_new_;
};

}  // namespace

std::string NameKey(const std::string& name) { return InCapitals(name); }

Eigen::AlignedBox3d BoxOf(const ModelMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
  for (const ModelSphere& sphere : mesh.spheres) {
    const Eigen::Vector3d radii = Eigen::Vector3d::Constant(sphere.radius);
    box.extend(sphere.center - radii);
    box.extend(sphere.center + radii);
  }
  return box;
}

int SurfaceIndex::IndexOf(const SurfaceNames& names) {
  const auto [found, is_new] =
      index_of_key_.try_emplace(KeyOf(names), static_cast<int>(surfaces_->size()));
  if (is_new) surfaces_->push_back(names);
  return found->second;
}

void DropUnused(ModelMesh* mesh) {
  Renumbering vertices(mesh->vertices.size()), surfaces(mesh->surfaces.size());
  for (Vector3i& triangle : mesh->triangles) {
    for (int& corner : triangle) corner = vertices.Keep(corner);
  }
  for (int& surface : mesh->surface_of_triangle) surface = surfaces.Keep(surface);
  for (ModelSphere& sphere : mesh->spheres) sphere.surface = surfaces.Keep(sphere.surface);
  mesh->vertices = vertices.Kept(mesh->vertices);
  mesh->surfaces = surfaces.Kept(mesh->surfaces);
}

void Append(const ModelMesh& other, ModelMesh* mesh) {
  const int first = static_cast<int>(mesh->vertices.size());
  const size_t triangles_before = mesh->triangles.size();
  mesh->vertices.insert(mesh->vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Vector3i& triangle : other.triangles) {
    mesh->triangles.push_back(triangle + Vector3i::Constant(first));
  }
  std::vector<int> surfaces;
  SurfaceIndex index(&mesh->surfaces);
  const std::vector<SurfaceNames> before = std::move(mesh->surfaces);
  mesh->surfaces.clear();
  for (const SurfaceNames& names : before) index.IndexOf(names);
  for (const SurfaceNames& names : other.surfaces) surfaces.push_back(index.IndexOf(names));
  for (const int surface : other.surface_of_triangle) {
    mesh->surface_of_triangle.push_back(surfaces[surface]);
  }
  for (ModelSphere sphere : other.spheres) {
    sphere.surface = surfaces[sphere.surface];
    mesh->spheres.push_back(sphere);
  }
  AppendCornerNormals(other, triangles_before, mesh);
  AppendCornerUvs(other, triangles_before, mesh);
}

}  // namespace insitu
