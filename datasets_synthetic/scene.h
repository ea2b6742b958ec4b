// SPDX-License-Identifier: GPL-3.0-or-later
// Planar faces with names and materials: what the demo site is built of.
// Site frame: the survey's axes, origin near the gallery [m].
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "datasets_synthetic/surface_colors.h"

namespace insitu::demo {

// Panes painted on a wall in rows and columns, in the face's own coordinates [m].
struct WindowGrid {
  int columns = 0, rows = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();  // lower left corner of the first pane
  Eigen::Vector2d step = Eigen::Vector2d::Ones();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
};

// A planar polygon, convex or concave, counter-clockwise from outside. Its own coordinates (u, v)
// start at vertex 0, u along the first edge.
struct Face {
  std::string name;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::string> vertex_names;  // empty: not surveyed
  Material material = Material::kConcrete;
  WindowGrid windows;
  std::vector<Eigen::Vector2d> targets;  // centres of survey targets lying on it, (u, v)

  // Derived by FinishFace.
  Eigen::Vector3d normal, u_axis, v_axis;
  std::vector<Eigen::Vector2d> outline;
  Eigen::Vector3d center;
  double radius = 0;

  Eigen::Vector2d Local(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d offset = point - vertices[0];
    return {offset.dot(u_axis), offset.dot(v_axis)};
  }
};

// Computes normal, axes, outline and bounding sphere from the vertices.
Face FinishFace(Face face);

// A node of the tree of bounding boxes. Its children are the next node and, further along `axis`,
// `second`; a leaf has faces of its own.
struct BoxNode {
  Eigen::AlignedBox3d box;
  int second = 0, axis = 0;
  int first_face = 0, faces = 0;  // faces > 0: a leaf
};

struct Scene {
  std::vector<Face> faces;
  std::vector<BoxNode> nodes;  // empty without faces
};

// Finishes the faces and orders them into the tree.
Scene MakeScene(std::vector<Face> faces);

inline constexpr double kTargetHalfWidth = 0.25;  // [m]

// Reflectance at (u, v): material, panes, targets. `footprint` [m]: size of a pixel there.
Spectrum FaceReflectance(const Face& face, const Eigen::Vector2d& uv, double footprint);

// Whether only the material itself shows within `margin` [m].
bool IsPlain(const Face& face, const Eigen::Vector2d& uv, double margin);

}  // namespace insitu::demo
