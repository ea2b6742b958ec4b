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

constexpr size_t kDeepestNesting = 64;
constexpr int64_t kMostPieces = 20'000'000;  // vertices, entities and copies of blocks
constexpr double kFarthest = 1e12;           // [m]

class Assembly {
 public:
  explicit Assembly(const DxfDrawing& drawing) : drawing_(drawing) {}

  // `layer_of_zero` is what layer 0 stands for here; `insert` is nullptr for the model space.
  void Add(const DxfBlock& block, const Affine3d& world_from_block,
           const std::string& layer_of_zero, const DxfInsert* insert);

  DxfModel model;

 private:
  void AddTriangles(const LayeredMesh& mesh, const Affine3d& world_from_block,
                    const std::string& layer_of_zero);
  void AddInsert(const DxfInsert& insert, const Affine3d& world_from_holder,
                 const std::string& layer_of_zero);
  const DxfBlock& Find(const DxfInsert& insert) const;
  DxfLayer LayerNamed(const std::string& name) const;
  bool IsShown(const std::string& layer) const;
  std::vector<int> IndexLayers(const std::vector<std::string>& layers,
                               const std::string& layer_of_zero);

  const DxfDrawing& drawing_;
  std::vector<std::string> nesting_;  // keys of the blocks being inserted
  int64_t pieces_ = 0;
};

// Returns how many there are.
int64_t AddCounts(const std::map<std::string, int>& counts, std::map<std::string, int>* sums) {
  int64_t total = 0;
  for (const auto& [kind, count] : counts) {
    (*sums)[kind] += count;
    total += count;
  }
  return total;
}

DxfLayer Assembly::LayerNamed(const std::string& name) const {
  const auto found = drawing_.layers.find(DxfKey(name));
  return found == drawing_.layers.end() ? DxfLayer{} : found->second;
}

bool Assembly::IsShown(const std::string& layer) const {
  const DxfLayer state = LayerNamed(layer);
  return !state.frozen && !state.off;
}

const DxfBlock& Assembly::Find(const DxfInsert& insert) const {
  const std::string key = DxfKey(insert.block);
  const auto found = drawing_.blocks.find(key);
  if (found == drawing_.blocks.end()) {
    throw insert.record.Error("INSERT of block \"" + insert.block +
                              "\", which the drawing does not define");
  }
  if (std::ranges::find(nesting_, key) != nesting_.end()) {
    throw insert.record.Error("block \"" + insert.block + "\" inserts itself");
  }
  if (nesting_.size() == kDeepestNesting) {
    throw insert.record.Error("blocks within blocks more than " + std::to_string(kDeepestNesting) +
                              " deep");
  }
  return found->second;
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
                   const std::string& layer_of_zero, const DxfInsert* insert) {
  const bool far = !(world_from_block.matrix().array().abs() <= kFarthest).all();
  if (insert && (far || pieces_ > kMostPieces)) {
    throw insert->record.Error(far ? "an INSERT that puts its block beyond 1e12 m"
                                   : "copies of blocks come to over 20 million pieces");
  }
  AddTriangles(block.content.mesh, world_from_block, layer_of_zero);
  pieces_ += 1 + static_cast<int64_t>(block.content.mesh.vertices.size()) +
             AddCounts(block.content.entities, &model.entities) +
             AddCounts(block.content.skipped, &model.skipped);
  model.degenerate_faces += block.content.degenerate_faces;
  model.smoothed_meshes += block.content.smoothed_meshes;
  for (const DxfInsert& inner : block.inserts) AddInsert(inner, world_from_block, layer_of_zero);
}

void Assembly::AddInsert(const DxfInsert& insert, const Affine3d& world_from_holder,
                         const std::string& layer_of_zero) {
  const DxfBlock& block = Find(insert);
  const std::string& layer = insert.layer == "0" ? layer_of_zero : insert.layer;
  if (block.external) ++model.skipped["INSERT of an external drawing"];
  if (LayerNamed(layer).frozen) {
    ++model.hidden[layer];
    return;
  }
  nesting_.push_back(DxfKey(insert.block));
  for (int row = 0; row < insert.rows; ++row) {
    for (int column = 0; column < insert.columns; ++column) {
      const Vector3d step = column * insert.column_step + row * insert.row_step;
      Add(block,
          world_from_holder * Eigen::Translation3d(step) * insert.holder_from_block *
              Eigen::Translation3d(-block.base),
          layer, &insert);
    }
  }
  nesting_.pop_back();
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
  assembly.Add(drawing.model_space, metres_from_units, "0", nullptr);
  assembly.model.metres_per_unit = drawing.metres_per_unit;
  DropUnused(&assembly.model.mesh);
  return std::move(assembly.model);
}

}  // namespace insitu
