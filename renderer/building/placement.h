// SPDX-License-Identifier: GPL-3.0-or-later
// Where the building stands: building/placement.json, from the model's frame to the survey's.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "reconstruction/geometry/similarity.h"
#include "renderer/mesh/model.h"

namespace insitu {

struct PointPair {
  std::string name;
  SimilarityPair points;  // source in the model [m], z up; target in the survey [m]
};

struct Placement {
  std::optional<double> metres_per_unit;  // in place of what the model's file says
  bool y_up = false;                      // of the model's file
  Similarity3 world_from_model;
  std::vector<PointPair> pairs;
  std::optional<AdjustedSimilarity> adjusted;  // of pairs
  std::string model_crs, survey_crs;           // empty, or as PROJ knows them
};

// What building/placement.json says of the model file `name`: its entry under "models", else the
// file's own; without the file, nothing. `metres_per_unit` and `map_from_model` are the model
// file's.
// {"unit": "mm", "up": "y", "scale": 1, "rotation_deg": 30 (about the vertical) or "rotation": 3x3,
//  "shift": [x, y, z]}; or, of an IFC file that holds it, {"map_conversion": true}; or {"pairs":
//  [{"model": [x, y, z], "point": "P1" or "survey": [x, y, z], "sigma": 0.01}], "scale": 1,
//  "adjust_scale": false}, model coordinates in the file's own units
// and axes, points of survey/control_points.csv; and after either {"model_crs": "EPSG:25832",
// "survey_crs": "EPSG:2056"}.
// Throws InputError: unreadable, an unknown unit or point, fewer than three pairs or all on a line,
// a rotation that is none, a map conversion of a model that states none.
Placement ReadPlacement(const SitePaths& site, const std::string& name, double metres_per_unit,
                        const std::optional<Similarity3>& map_from_model = {});

// Moves a mesh in metres, z up as the importer left it. Throws InputError at placement.json: PROJ
// does not know a coordinate system, or cannot transform a point.
void Place(const SitePaths& site, const Placement& placement, double metres_per_unit,
           ModelMesh* mesh);

// The same of the lamps of a model.
void PlaceLamps(const SitePaths& site, const Placement& placement, double metres_per_unit,
                std::vector<ModelLamp>* lamps);

}  // namespace insitu
