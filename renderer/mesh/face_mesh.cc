// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/face_mesh.h"

#include <algorithm>

namespace insitu {
namespace {

using Eigen::Vector3d;
using Edge = std::pair<int, int>;

Edge EdgeOf(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

struct EdgeState {
  Vector3d sum_of_face_points = Vector3d::Zero();
  int faces = 0;
  bool sharp = false;
  int point = 0;  // index of its vertex in the finer mesh
};

struct VertexState {
  Vector3d sum_of_face_points = Vector3d::Zero(), sum_of_middles = Vector3d::Zero();
  Vector3d sum_of_sharp_ends = Vector3d::Zero();
  int faces = 0, edges = 0, sharp_edges = 0;
};

Vector3d MovedVertex(const Vector3d& old, const VertexState& state) {
  if (state.sharp_edges == 2) return old * 0.75 + state.sum_of_sharp_ends / 8;
  if (state.sharp_edges > 2 || state.faces < 2 || state.faces != state.edges) return old;
  const double n = state.faces;
  return (state.sum_of_face_points / n + 2 * state.sum_of_middles / n + (n - 3) * old) / n;
}

class Subdivision {
 public:
  explicit Subdivision(const FaceMesh& mesh) : mesh_(mesh), vertices_(mesh.vertices.size()) {}

  FaceMesh Run() {
    GatherFaces();
    for (auto& [edge, state] : edges_) AddEdgePoint(edge, &state);
    for (size_t v = 0; v < vertices_.size(); ++v) {
      finer_.vertices[v] = MovedVertex(mesh_.vertices[v], vertices_[v]);
    }
    AddFaces();
    return std::move(finer_);
  }

 private:
  void GatherFaces() {
    finer_.vertices = mesh_.vertices;
    for (const std::vector<int>& face : mesh_.faces) {
      Vector3d middle = Vector3d::Zero();
      for (const int corner : face) middle += mesh_.vertices[corner];
      middle /= static_cast<double>(face.size());
      face_points_.push_back(static_cast<int>(finer_.vertices.size()));
      finer_.vertices.push_back(middle);
      for (size_t i = 0; i < face.size(); ++i) {
        EdgeState& edge = edges_[EdgeOf(face[i], face[(i + 1) % face.size()])];
        edge.sum_of_face_points += middle;
        ++edge.faces;
        vertices_[face[i]].sum_of_face_points += middle;
        ++vertices_[face[i]].faces;
      }
    }
  }

  void AddEdgePoint(const Edge& edge, EdgeState* state) {
    const auto crease = mesh_.creases.find(edge);
    const Vector3d &a = mesh_.vertices[edge.first], &b = mesh_.vertices[edge.second];
    const Vector3d middle = (a + b) / 2;
    state->sharp = state->faces != 2 || crease != mesh_.creases.end();
    state->point = static_cast<int>(finer_.vertices.size());
    finer_.vertices.push_back(state->sharp ? middle : (a + b + state->sum_of_face_points) / 4);
    for (const auto& [own, other] : {edge, Edge(edge.second, edge.first)}) {
      VertexState& vertex = vertices_[own];
      ++vertex.edges;
      vertex.sum_of_middles += middle;
      if (!state->sharp) continue;
      ++vertex.sharp_edges;
      vertex.sum_of_sharp_ends += mesh_.vertices[other];
    }
    if (crease == mesh_.creases.end() || crease->second <= 1) return;
    finer_.creases[EdgeOf(edge.first, state->point)] = crease->second - 1;
    finer_.creases[EdgeOf(edge.second, state->point)] = crease->second - 1;
  }

  void AddFaces() {
    for (size_t f = 0; f < mesh_.faces.size(); ++f) {
      const std::vector<int>& face = mesh_.faces[f];
      const size_t n = face.size();
      for (size_t i = 0; i < n; ++i) {
        const int before = edges_.at(EdgeOf(face[(i + n - 1) % n], face[i])).point;
        const int after = edges_.at(EdgeOf(face[i], face[(i + 1) % n])).point;
        finer_.faces.push_back({face[i], after, face_points_[f], before});
      }
    }
  }

  const FaceMesh& mesh_;
  FaceMesh finer_;
  std::vector<int> face_points_;
  std::map<Edge, EdgeState> edges_;
  std::vector<VertexState> vertices_;
};

}  // namespace

FaceMesh Smoothed(const FaceMesh& mesh) { return Subdivision(mesh).Run(); }

}  // namespace insitu
