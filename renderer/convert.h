// SPDX-License-Identifier: GPL-3.0-or-later
// CONVERT: the architect's models and their materials become the artificial environment.
// [Durisch92, §5]
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/building/artificial_environment.h"
#include "renderer/building/placement.h"
#include "renderer/formats/model_file.h"
#include "renderer/mesh/element_measures.h"
#include "renderer/mesh/solids.h"
#include "renderer/preview/turntable.h"

namespace insitu {

struct ConvertOptions {
  ImportOptions import;
  // Instead of the models in building/.
  std::vector<std::filesystem::path> models;

  void Check() const;  // throws CheckError that names the field that is wrong
};

// One model file as it was read.
struct ModelReport {
  std::filesystem::path file;
  std::string format;
  std::optional<double> metres_per_unit;  // as the file names it; nullopt: taken as metres
  int triangles = 0, spheres = 0;
  Eigen::AlignedBox3d box_in_units;  // of the file's own coordinates, z up; may be empty
  Placement placement;
  std::map<std::string, int> entities;  // kind -> count
  SkippedEntities skipped;
  int degenerate_faces = 0;
};

struct Conversion {
  ArtificialEnvironment environment;
  std::vector<ModelReport> models;
  Eigen::AlignedBox3d box;  // [m], world, as the models draw it; empty without a surface
  SolidsReport solids;
  std::map<std::string, ElementMeasures> elements;  // by layer, as shown
  double chord_tolerance = 0;                       // [m], of what the drawings' arcs became
  TurntableLayers layers;                           // of the environment's triangles
  std::map<std::string, int> triangles_of_layer;    // a sphere counts as one
  std::map<std::string, int> triangles_of_material;
  // What materials.json does not list: label -> what the model itself says of its colour.
  std::map<std::string, std::optional<Eigen::Vector3d>> unlisted;
  std::vector<std::string> warnings;  // entities skipped, names without a material, ...

  std::string BriefReport() const;  // triangles, bounding box, largest 30 elements, warnings
};

// Reads the models in building/ (of files with one name but several endings, the first of DXF, IFC,
// glTF, COLLADA, OBJ, PLY, STL), placement.json, materials.json and lights.json there if they are.
// A name that materials.json does not list keeps the colour of the model's own material or of the
// drawing, else it becomes a visible mid grey; both with a warning that lists them.
// Throws InputError: no model, what the readers of the files state. A building without a surface is
// none: see RequireSurface.
Conversion ConvertBuilding(const SitePaths& site, const ConvertOptions& options = {});

// Throws InputError: no surface, naming what the models hold instead and why it was left out; a
// building of under a millimetre or over 100 km.
void RequireSurface(const SitePaths& site, const Conversion& conversion);

}  // namespace insitu
