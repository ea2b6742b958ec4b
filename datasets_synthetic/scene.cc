// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace insitu::demo {
namespace {

// Newell's normal, which concave outlines do not turn round.
Eigen::Vector3d NewellNormal(const std::vector<Eigen::Vector3d>& vertices) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d a = vertices[i] - vertices[0];
    const Eigen::Vector3d b = vertices[(i + 1) % vertices.size()] - vertices[0];
    sum += a.cross(b);
  }
  return sum.normalized();
}

bool InWindow(const WindowGrid& grid, const Eigen::Vector2d& uv, double margin) {
  for (int i = 0; i < grid.columns; ++i) {
    for (int j = 0; j < grid.rows; ++j) {
      const Eigen::Vector2d low = grid.first + Eigen::Vector2d(i, j).cwiseProduct(grid.step);
      const Eigen::Array2d inside = (uv - low).array();
      const bool above = (inside > -margin).all();
      const bool below = (inside < grid.size.array() + margin).all();
      if (above && below) return true;
    }
  }
  return false;
}

const Eigen::Vector2d* TargetAt(const Face& face, const Eigen::Vector2d& uv, double margin) {
  const auto near = [&](const Eigen::Vector2d& center) {
    return (uv - center).cwiseAbs().maxCoeff() < kTargetHalfWidth + margin;
  };
  const auto found = std::find_if(face.targets.begin(), face.targets.end(), near);
  return found == face.targets.end() ? nullptr : &*found;
}

// Halves the faces along the longest side of their centres' box until few are left.
void AddNode(Scene& scene, int first, int count) {
  constexpr int kLeafFaces = 4;
  const auto begin = scene.faces.begin() + first;
  Eigen::AlignedBox3d box, centers;
  for (auto face = begin; face != begin + count; ++face) {
    for (const Eigen::Vector3d& vertex : face->vertices) box.extend(vertex);
    centers.extend(face->center);
  }
  const Eigen::Vector3d slack = Eigen::Vector3d::Constant(1e-6);  // flat boxes are not missed
  box = {box.min() - slack, box.max() + slack};
  const size_t index = scene.nodes.size();
  scene.nodes.push_back({box, 0, 0, first, count <= kLeafFaces ? count : 0});
  if (count <= kLeafFaces) return;
  int axis = 0;
  centers.sizes().maxCoeff(&axis);
  std::nth_element(begin, begin + count / 2, begin + count, [axis](const Face& a, const Face& b) {
    return a.center[axis] < b.center[axis];
  });
  scene.nodes[index].axis = axis;
  AddNode(scene, first, count / 2);
  scene.nodes[index].second = static_cast<int>(scene.nodes.size());
  AddNode(scene, first + count / 2, count - count / 2);
}

}  // namespace

Face FinishFace(Face face) {
  face.normal = NewellNormal(face.vertices);
  face.u_axis = (face.vertices[1] - face.vertices[0]).normalized();
  face.v_axis = face.normal.cross(face.u_axis);
  face.outline.clear();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : face.vertices) {
    face.outline.push_back(face.Local(vertex));
    box.extend(vertex);
  }
  face.center = box.center();
  face.radius = 0;
  for (const Eigen::Vector3d& vertex : face.vertices) {
    face.radius = std::max(face.radius, (vertex - face.center).norm());
  }
  return face;
}

Scene MakeScene(std::vector<Face> faces) {
  Scene scene;
  for (Face& face : faces) scene.faces.push_back(FinishFace(std::move(face)));
  if (!scene.faces.empty()) AddNode(scene, 0, static_cast<int>(scene.faces.size()));
  return scene;
}

Spectrum FaceReflectance(const Face& face, const Eigen::Vector2d& uv, double footprint) {
  if (InWindow(face.windows, uv, 0)) return WindowReflectance();
  if (const Eigen::Vector2d* center = TargetAt(face, uv, 0)) {
    const Eigen::Vector2d offset = uv - *center;
    return TargetReflectance((offset.x() > 0) == (offset.y() > 0));
  }
  return TexturedReflectance(face.material, uv, footprint);
}

bool IsPlain(const Face& face, const Eigen::Vector2d& uv, double margin) {
  return !InWindow(face.windows, uv, margin) && TargetAt(face, uv, margin) == nullptr;
}

}  // namespace insitu::demo
