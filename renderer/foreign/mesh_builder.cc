// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/mesh_builder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calibration/files/error.h"
#include "renderer/mesh/face_triangles.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr double kLargestVertex = 1e12;  // [m]
constexpr int kColorSteps = 8;

Eigen::Vector3f NormalOfTriangle(const ModelMesh& mesh, const Eigen::Vector3i& triangle) {
  const Vector3d& a = mesh.vertices[triangle[0]];
  return (mesh.vertices[triangle[1]] - a)
      .cross(mesh.vertices[triangle[2]] - a)
      .normalized()
      .cast<float>();
}

// Steps that look alike: about those of a screen.
int CodeOf(double linear) {
  const double shown = linear > 0 ? std::min(linear, 1.0) : 0;  // no number: none
  return static_cast<int>(std::lround((kColorSteps - 1) * std::sqrt(shown)));
}

double OfCode(int code) {
  const double root = static_cast<double>(code) / (kColorSteps - 1);
  return root * root;
}

}  // namespace

void BuiltFace::Clear() {
  corners.clear();
  normals.clear();
  uvs.clear();
}

int MeshBuilder::AddVertex(const Vector3d& vertex, const std::string& whose) {
  if ((vertex.array().abs() > kLargestVertex && vertex.array().isFinite()).any()) {
    throw InputError(file_, "a vertex of \"" + whose + "\" is beyond 1e12 m");
  }
  if (!vertex.allFinite()) {
    ++model_.skipped[{"vertex", "no number: no point"}];
    all_points_ = false;
  }
  model_.mesh.vertices.push_back(vertex);
  return static_cast<int>(model_.mesh.vertices.size()) - 1;
}

int MeshBuilder::ColoredSurface(int surface, const Vector3d& rgb) {
  const Eigen::Vector3i codes(CodeOf(rgb[0]), CodeOf(rgb[1]), CodeOf(rgb[2]));
  const int code = (codes[0] * kColorSteps + codes[1]) * kColorSteps + codes[2];
  const auto [found, is_new] = colored_.try_emplace({surface, code}, 0);
  if (!is_new) return found->second;
  SurfaceNames names = model_.mesh.surfaces[surface];
  const Vector3d shown(OfCode(codes[0]), OfCode(codes[1]), OfCode(codes[2]));
  names.rgb = names.rgb.value_or(Vector3d(Vector3d::Ones())).cwiseProduct(shown);
  if (names.material.empty()) names.material = "colours by vertex";
  return found->second = index_.IndexOf(names);
}

void MeshBuilder::SayColorsByVertex() {
  ++model_.skipped[{"mesh with colours by vertex",
                    "each face is shown in one colour, in 8 steps of a channel"}];
}

void MeshBuilder::AddFace(const BuiltFace& face, int surface) {
  if (face.corners.size() < 3) {
    ++model_.skipped[{"face", "of fewer than 3 corners"}];
    return;
  }
  if (face.corners.size() > kMostCorners) throw InputError(file_, "a face has over 10000 corners");
  const auto is_point = [&](int v) { return model_.mesh.vertices[v].allFinite(); };
  if (!all_points_ && !std::ranges::all_of(face.corners, is_point)) {
    ++model_.skipped[{"face", "at a vertex that is no point"}];
    return;
  }
  const auto triangles = FaceTriangles(model_.mesh.vertices, face.corners);
  if (triangles.empty()) ++model_.degenerate_faces;
  for (const Eigen::Vector3i& triangle : triangles) {
    model_.mesh.triangles.push_back(triangle);
    model_.mesh.surface_of_triangle.push_back(surface);
    AddCorners(face, triangle);
  }
}

// Triangles before the first that has normals or texture coordinates get their own and none.
void MeshBuilder::AddCorners(const BuiltFace& face, const Eigen::Vector3i& triangle) {
  ModelMesh& mesh = model_.mesh;
  const size_t before = mesh.triangles.size() - 1;
  const bool with_normals = !face.normals.empty() || !mesh.corner_normals.empty();
  const bool with_uvs = !face.uvs.empty() || !mesh.corner_uvs.empty();
  if (!with_normals && !with_uvs) return;
  if (with_normals) FillNormals(before);
  if (with_uvs) mesh.corner_uvs.resize(3 * before, Eigen::Vector2f(0, 0));
  for (const int vertex : triangle) {
    const auto corner = std::ranges::find(face.corners, vertex) - face.corners.begin();
    if (with_normals) {
      const bool valid = !face.normals.empty() && face.normals[corner].allFinite() &&
                         face.normals[corner].norm() > 0.5f;
      if (!valid && !face.normals.empty()) {
        ++model_.skipped[{"normal", "no direction: its face has its own"}];
      }
      mesh.corner_normals.push_back(valid ? face.normals[corner]
                                          : NormalOfTriangle(mesh, triangle));
    }
    if (with_uvs) {
      const bool valid = !face.uvs.empty() && face.uvs[corner].allFinite();
      mesh.corner_uvs.push_back(valid ? face.uvs[corner] : Eigen::Vector2f(0, 0));
    }
  }
}

void MeshBuilder::FillNormals(size_t triangles) {
  ModelMesh& mesh = model_.mesh;
  for (size_t t = mesh.corner_normals.size() / 3; t < triangles; ++t) {
    mesh.corner_normals.insert(mesh.corner_normals.end(), 3,
                               NormalOfTriangle(mesh, mesh.triangles[t]));
  }
}

void MeshBuilder::Finish() { DropUnused(&model_.mesh); }

}  // namespace insitu
