// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of a COLLADA geometry.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibration/files/xml_file.h"
#include "renderer/mesh/model.h"

namespace insitu {

// Corners one after the other: a vertex each, and an attribute of each kind or -1.
struct ColladaCorner {
  int position = 0, normal = -1, uv = -1, color = -1;
};

struct ColladaFace {
  std::vector<ColladaCorner> corners;
  std::vector<std::vector<ColladaCorner>> holes;
};

// One of <triangles>, <polylist>, <polygons>, <tristrips>, <trifans>.
struct ColladaPart {
  std::string material;  // the symbol that instances bind
  std::vector<Eigen::Vector3d> normals, colors;
  std::vector<Eigen::Vector2d> uvs;
  std::vector<ColladaFace> faces;
};

struct ColladaGeometry {
  std::vector<Eigen::Vector3d> positions;  // in the file's unit and axes
  std::vector<ColladaPart> parts;
};

// What is not shown (lines, second texture coordinates, splines) is counted as skipped. Throws
// InputError at its line: a source that is not there, an index beyond its source, a position that
// is no number.
ColladaGeometry ReadColladaGeometry(const XmlNode& geometry, Model* model);

}  // namespace insitu
