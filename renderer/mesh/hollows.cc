// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/hollows.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>

namespace insitu {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

AlignedBox3d BoxOfBody(const ModelMesh& mesh, const DrawnBody& body) {
  AlignedBox3d box;
  for (const int t : body.triangles) {
    for (const int corner : mesh.triangles[t]) box.extend(mesh.vertices[corner]);
  }
  return box;
}

// By the solid angle of its faces: the whole sphere from within, none from without.
bool IsWithin(const ModelMesh& mesh, const Vector3d& point, const DrawnBody& body) {
  double angle = 0;
  for (const int t : body.triangles) {
    const Eigen::Vector3i& corners = mesh.triangles[t];
    const Vector3d a = mesh.vertices[corners[0]] - point, b = mesh.vertices[corners[1]] - point;
    const Vector3d c = mesh.vertices[corners[2]] - point;
    const double x = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + b.dot(c) * a.norm() +
                     c.dot(a) * b.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), x);
  }
  return angle > 2 * std::numbers::pi;
}

const std::string& LayerOf(const ModelMesh& mesh, const DrawnBody& body) {
  return mesh.surfaces[mesh.surface_of_triangle[body.triangles[0]]].layer;
}

}  // namespace

std::set<int> HollowsAmong(const ModelMesh& mesh, const std::vector<DrawnBody>& bodies) {
  constexpr int64_t kMost = 200'000'000, kOfTriangle = 20;  // steps
  struct Outer {
    const DrawnBody* body;
    AlignedBox3d box;
  };
  std::map<std::string, std::vector<Outer>> outer_of_layer;
  for (const DrawnBody& body : bodies) {
    if (body.looks_inwards) continue;
    outer_of_layer[LayerOf(mesh, body)].push_back({&body, BoxOfBody(mesh, body)});
  }
  std::set<int> hollows;
  int64_t steps = 0;
  for (const DrawnBody& body : bodies) {
    if (!body.looks_inwards || steps > kMost) continue;
    const auto found = outer_of_layer.find(LayerOf(mesh, body));
    if (found == outer_of_layer.end()) continue;
    const AlignedBox3d box = BoxOfBody(mesh, body);
    const Vector3d& point = mesh.vertices[mesh.triangles[body.triangles[0]][0]];
    for (const Outer& outer : found->second) {
      ++steps;
      if (!outer.box.contains(box)) continue;
      steps += kOfTriangle * static_cast<int64_t>(outer.body->triangles.size());
      if (!IsWithin(mesh, point, *outer.body)) continue;
      hollows.insert(body.body);
      break;
    }
  }
  return hollows;
}

}  // namespace insitu
