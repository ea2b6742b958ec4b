// SPDX-License-Identifier: GPL-3.0-or-later
// Reading DXF drawings: faces, meshes and blocks become triangles by layer.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace insitu {

// Triangles as the drawing has them: its own coordinates, scaled to metres by $INSUNITS.
struct LayeredMesh {
  std::vector<std::string> layers;
  std::vector<Eigen::Vector3d> vertices;   // [m]
  std::vector<Eigen::Vector3i> triangles;  // indices into vertices
  std::vector<int> layer_of_triangle;      // index into layers
};

struct DxfModel {
  LayeredMesh mesh;
  std::optional<double> metres_per_unit;  // nullopt: the drawing names no unit; taken as metres
  std::map<std::string, int> entities;    // kind -> count, blocks counted where they are inserted
  std::map<std::string, int> skipped;     // kinds that carry no surface we read -> count
  std::map<std::string, int> hidden;      // frozen or switched-off layer -> pieces left out
  int degenerate_faces = 0;               // dropped: no area, or an outline that crosses itself
  int smoothed_meshes = 0;                // MESH whose level 0 we read but not its smoothing
};

// ASCII DXF, R12 to 2018: 3DFACE, SOLID and TRACE (with thickness), MESH (level 0), POLYLINE as
// polyface and as polygon mesh, INSERT (nested, scaled, mirrored, rotated, in rows and columns,
// extruded). A face of a block on layer 0 takes the layer of its INSERT. What CAD programs do not
// show is left out: frozen and switched-off layers, invisible entities, paper space.
// Throws InputError at the line: cut in half (no EOF), a group code that is no number, a face that
// names a vertex out of range, an unknown block, blocks that insert themselves, coordinates that
// are not finite, an unknown unit.
DxfModel ReadDxf(const std::filesystem::path& path);

}  // namespace insitu
