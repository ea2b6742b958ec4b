// SPDX-License-Identifier: GPL-3.0-or-later
// A drawing's blocks, put where they are inserted.
#include "renderer/dxf.h"

#include <algorithm>

#include "renderer/dxf_drawing.h"
#include "renderer/face_triangles.h"

namespace insitu {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double kFarthest = 1e12;  // [m]

class Assembly {
 public:
  explicit Assembly(const DxfDrawing& drawing) : drawing_(drawing) {}

  // `layer_of_zero` is what layer 0 stands for here.
  void Add(const DxfBlock& block, const Affine3d& world_from_block,
           const std::string& layer_of_zero);

  DxfModel model;

 private:
  void AddTriangles(const LayeredMesh& mesh, const Affine3d& world_from_block,
                    const std::string& layer_of_zero);
  void AddInsert(const DxfInsert& insert, const Affine3d& world_from_holder,
                 const std::string& layer_of_zero);
  DxfLayer LayerNamed(const std::string& name) const;
  bool IsShown(const std::string& layer) const;
  std::vector<int> IndexLayers(const std::vector<std::string>& layers,
                               const std::string& layer_of_zero);

  const DxfDrawing& drawing_;
};

void AddCounts(const std::map<std::string, int>& counts, std::map<std::string, int>* sums) {
  for (const auto& [kind, count] : counts) (*sums)[kind] += count;
}

DxfLayer Assembly::LayerNamed(const std::string& name) const {
  const auto found = drawing_.layers.find(DxfKey(name));
  return found == drawing_.layers.end() ? DxfLayer{} : found->second;
}

bool Assembly::IsShown(const std::string& layer) const {
  const DxfLayer state = LayerNamed(layer);
  return !state.frozen && !state.off;
}

// Index of each of a block's layers in the model.
std::vector<int> Assembly::IndexLayers(const std::vector<std::string>& layers,
                                       const std::string& layer_of_zero) {
  std::vector<int> indices;
  for (const std::string& layer : layers) {
    const std::string& name = layer == "0" ? layer_of_zero : layer;
    const auto found = std::ranges::find(model.mesh.layers, name);
    indices.push_back(static_cast<int>(found - model.mesh.layers.begin()));
    if (found == model.mesh.layers.end()) model.mesh.layers.push_back(name);
  }
  return indices;
}

void Assembly::AddTriangles(const LayeredMesh& mesh, const Affine3d& world_from_block,
                            const std::string& layer_of_zero) {
  LayeredMesh& all = model.mesh;
  const int first = static_cast<int>(all.vertices.size());
  for (const Vector3d& vertex : mesh.vertices) all.vertices.push_back(world_from_block * vertex);
  const bool mirrored = world_from_block.linear().determinant() < 0;
  const std::vector<int> layers = IndexLayers(mesh.layers, layer_of_zero);
  std::vector<bool> shown;
  for (const int layer : layers) shown.push_back(IsShown(all.layers[layer]));
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int layer = layers[mesh.layer_of_triangle[t]];
    Vector3i triangle = mesh.triangles[t] + Vector3i::Constant(first);
    if (mirrored) std::swap(triangle[1], triangle[2]);
    if (!shown[mesh.layer_of_triangle[t]]) {
      ++model.hidden[all.layers[layer]];
    } else if (IsDegenerate(all.vertices[triangle[0]], all.vertices[triangle[1]],
                            all.vertices[triangle[2]])) {
      ++model.degenerate_faces;  // flattened by the scale of its INSERT
    } else {
      all.triangles.push_back(triangle);
      all.layer_of_triangle.push_back(layer);
    }
  }
}

void Assembly::Add(const DxfBlock& block, const Affine3d& world_from_block,
                   const std::string& layer_of_zero) {
  AddTriangles(block.content.mesh, world_from_block, layer_of_zero);
  AddCounts(block.content.entities, &model.entities);
  AddCounts(block.content.skipped, &model.skipped);
  model.degenerate_faces += block.content.degenerate_faces;
  model.smoothed_meshes += block.content.smoothed_meshes;
  for (const DxfInsert& insert : block.inserts) AddInsert(insert, world_from_block, layer_of_zero);
}

void Assembly::AddInsert(const DxfInsert& insert, const Affine3d& world_from_holder,
                         const std::string& layer_of_zero) {
  const DxfBlock& block = InsertedBlock(drawing_, insert);
  const std::string& layer = insert.layer == "0" ? layer_of_zero : insert.layer;
  if (block.external) ++model.skipped["INSERT of an external drawing"];
  if (LayerNamed(layer).frozen) {
    ++model.hidden[layer];
    return;
  }
  for (int row = 0; row < insert.rows; ++row) {
    for (int column = 0; column < insert.columns; ++column) {
      const Vector3d step = column * insert.column_step + row * insert.row_step;
      const Affine3d world_from_block = world_from_holder * Eigen::Translation3d(step) *
                                        insert.holder_from_block *
                                        Eigen::Translation3d(-block.base);
      if (!(world_from_block.matrix().array().abs() <= kFarthest).all()) {
        throw insert.record.Error("an INSERT that puts its block beyond 1e12 m");
      }
      Add(block, world_from_block, layer);
    }
  }
}

// Vertices and layers that no triangle uses would widen the model's box and ask for materials.
void DropUnused(LayeredMesh* mesh) {
  std::vector<int> vertex(mesh->vertices.size(), -1), layer(mesh->layers.size(), -1);
  LayeredMesh kept;
  const auto keep = [](int index, auto& from, auto& to, std::vector<int>& moved) {
    if (moved[index] < 0) {
      moved[index] = static_cast<int>(to.size());
      to.push_back(from[index]);
    }
    return moved[index];
  };
  for (size_t t = 0; t < mesh->triangles.size(); ++t) {
    Vector3i triangle = mesh->triangles[t];
    for (int& index : triangle) index = keep(index, mesh->vertices, kept.vertices, vertex);
    kept.triangles.push_back(triangle);
    kept.layer_of_triangle.push_back(
        keep(mesh->layer_of_triangle[t], mesh->layers, kept.layers, layer));
  }
  *mesh = std::move(kept);
}

}  // namespace

DxfModel ReadDxf(const std::filesystem::path& path) {
  const DxfFile file(path);
  const DxfDrawing drawing = ReadDxfDrawing(file);
  Assembly assembly(drawing);
  const Affine3d metres_from_units(Eigen::Scaling(drawing.metres_per_unit.value_or(1)));
  assembly.Add(drawing.model_space, metres_from_units, "0");
  assembly.model.metres_per_unit = drawing.metres_per_unit;
  DropUnused(&assembly.model.mesh);
  return std::move(assembly.model);
}

}  // namespace insitu
