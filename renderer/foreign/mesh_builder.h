// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of any number of corners put together to a model's mesh.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "renderer/mesh/model.h"

namespace insitu {

// Corners of a face, indices into the mesh's vertices; normals and texture coordinates (v up) are
// none, or one a corner. A normal that is none counts as the face's own.
struct BuiltFace {
  std::vector<int> corners;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Eigen::Vector2f> uvs;

  void Clear();
};

class MeshBuilder {
 public:
  // `file` is for messages.
  MeshBuilder(std::filesystem::path file, Model* model)
      : file_(std::move(file)), model_(*model), index_(&model->mesh.surfaces) {}

  // One that is no number is counted, and so is each face at it, which is left out. Throws
  // InputError: beyond 1e12 m; `whose` says of what.
  int AddVertex(const Eigen::Vector3d& vertex, const std::string& whose);

  int SurfaceOf(const SurfaceNames& names) { return index_.IndexOf(names); }

  // The surface with its colour times `rgb` (linear), in eight steps of each channel: colours by
  // vertex are shown so, a face alike all over, without a surface for every one of them.
  int ColoredSurface(int surface, const Eigen::Vector3d& rgb);
  void SayColorsByVertex();  // counts a mesh that has them

  // Faces of no area are counted as such, those of fewer than three corners as skipped. Throws
  // InputError: over 10 000 corners.
  void AddFace(const BuiltFace& face, int surface);

  // To be called once, after all faces: what no face uses goes.
  void Finish();

 private:
  void AddCorners(const BuiltFace& face, const Eigen::Vector3i& triangle);
  void FillNormals(size_t triangles);

  std::filesystem::path file_;
  Model& model_;
  SurfaceIndex index_;
  bool all_points_ = true;
  std::map<std::pair<int, int>, int> colored_;  // surface, code of a colour -> surface
};

}  // namespace insitu
