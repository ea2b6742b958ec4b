// SPDX-License-Identifier: GPL-3.0-or-later
// A planned building as its file has it, whatever the format: the one face of all importers.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "reconstruction/geometry/similarity.h"
#include "renderer/mesh/surface_map.h"

namespace insitu {

// What a face is called in its file; materials.json is asked for these names.
struct SurfaceNames {
  std::string layer;                   // DXF layer, or the node's name in other formats
  std::string block;                   // innermost named block about it; may be empty
  std::string material;                // of the file's own materials; may be empty
  std::optional<Eigen::Vector3d> rgb;  // its colour there, linear Rec. 709, 0..1
  double opacity = 1;                  // there; 0: clear
  std::string texture;                 // image file of its colour, as named there; may be empty
  std::string texture_place;           // where it is named, "file:line", for messages
  std::vector<SurfaceMap> maps = {};   // other images, at the same places
  bool is_solid = false;               // its faces bound a body of glass, not panes
  double index = 1.5;                  // of refraction, > 1
  Eigen::Vector3d absorption_rgb = Eigen::Vector3d::Zero();   // of such a body, >= 0 [1/m]
  double diffuse_weight = 1;                                  // of its colour, 0..1
  Eigen::Vector3d translucent_rgb = Eigen::Vector3d::Zero();  // leaves its other side, matte, 0..1

  bool operator==(const SurfaceNames&) const = default;
};

// Names that differ in case alone, or in the form of their accents, mean the same, as in a drawing:
// their common key.
std::string NameKey(const std::string& name);

// A whole one, exact; it never becomes facets of the mesh.
struct ModelSphere {
  Eigen::Vector3d center;  // [m]
  double radius = 0;       // > 0 [m]
  int surface = 0;         // index into surfaces
};

struct ModelMesh {
  std::vector<SurfaceNames> surfaces;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;       // indices into vertices
  std::vector<int> surface_of_triangle;         // index into surfaces
  std::vector<Eigen::Vector3f> corner_normals;  // empty, or three a triangle: unit
  std::vector<Eigen::Vector2f> corner_uvs;      // empty, or three a triangle
  std::vector<ModelSphere> spheres = {};

  bool IsEmpty() const { return triangles.empty() && spheres.empty(); }
};

// About all that triangles may use and all spheres; may be empty.
Eigen::AlignedBox3d BoxOf(const ModelMesh& mesh);

// Kind and reason -> how many.
using SkippedEntities = std::map<std::pair<std::string, std::string>, int>;

// A point or spot light that a file holds.
struct ModelLamp {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();     // [m], in the model's frame, z up
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  // unit, of a spot
  Eigen::Vector3d rgb = Eigen::Vector3d::Ones();          // linear Rec. 709, 0..1
  double candela = 0;                                     // along its direction
  std::optional<double> inner_deg, outer_deg;             // of a spot, from its axis
};

struct Model {
  ModelMesh mesh;                         // [m], in the model's own frame, z up
  std::string format;                     // "DXF R2000, binary", "IFC2X3", ...
  std::optional<double> metres_per_unit;  // nullopt: the file names no unit; taken as metres
  std::map<std::string, int> entities;    // kind -> count, each as often as the file holds it
  SkippedEntities skipped;                // what carries no surface, is hidden, or cannot be read
  std::map<std::string, std::string> images;  // held by the file: "*0" as texture -> PNG, JPEG, ...
  std::vector<ModelLamp> lamps;
  std::vector<std::filesystem::path> files;   // that it names and that were read
  std::optional<Similarity3> map_from_model;  // [m], as the file states it; not applied
  int degenerate_faces = 0;                   // dropped: no area, or an outline that crosses itself
  std::vector<std::string> warnings;          // anything else a user must know
};

// Finds or adds surfaces of a mesh in constant time.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(std::vector<SurfaceNames>* surfaces) : surfaces_(surfaces) {}
  int IndexOf(const SurfaceNames& names);

 private:
  std::vector<SurfaceNames>* surfaces_;
  std::unordered_map<std::string, int> index_of_key_;
};

// Vertices and surfaces that no triangle or sphere uses are removed: they would widen the model's
// box and ask for materials.
void DropUnused(ModelMesh* mesh);

// Triangles and spheres of `other`, with what they use, appended. Corner attributes of a mesh that
// has none become facet normals and zero UV.
void Append(const ModelMesh& other, ModelMesh* mesh);

}  // namespace insitu
