// SPDX-License-Identifier: GPL-3.0-or-later
// Where the building stands: building/placement.json, from the model's frame to the survey's.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "renderer/mesh/model.h"

namespace insitu {

// A similarity transformation: world = shift + scale * rotation * model.
struct Similarity {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // [m]

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return shift + scale * (rotation * point);
  }
};

struct PointPair {
  std::string name;
  Eigen::Vector3d in_model;   // [m], z up
  Eigen::Vector3d in_survey;  // [m]
  double sigma = 0.01;        // [m] > 0, of each coordinate
};

struct AdjustedSimilarity {
  Similarity world_from_model;
  std::vector<Eigen::Vector3d> residuals;  // [m], survey minus transformed model point
  double sigma0 = 0;                       // a posteriori; 1 if the sigmas tell the truth
  int redundancy = 0;
  Eigen::Vector3d sigma_shift;     // [m], of the pairs' centre
  Eigen::Vector3d sigma_rotation;  // [rad], about the world's axes
  double sigma_scale = 0;          // 0 if the scale was not adjusted
  double free_scale = 1;           // what the scale would be if it were adjusted
};

// Least squares over all pairs, in closed form: the sigmas are alike in all directions
// [Umeyama 1991]; covariance from the normal equations, with the sigmas as given.
// nullopt: fewer than three pairs, or all of them on one line.
std::optional<AdjustedSimilarity> AdjustSimilarity(const std::vector<PointPair>& pairs,
                                                   bool adjust_scale);

struct Placement {
  std::optional<double> metres_per_unit;  // in place of what the model's file says
  bool y_up = false;                      // of the model's file
  Similarity world_from_model;
  std::vector<PointPair> pairs;
  std::optional<AdjustedSimilarity> adjusted;  // of pairs
  std::string model_crs, survey_crs;           // empty, or as PROJ knows them
};

// What building/placement.json says of the model file `name`: its entry under "models", else the
// file's own; without the file, nothing. `metres_per_unit` is the model file's.
// {"unit": "mm", "up": "y", "scale": 1, "rotation_deg": 30 (about the vertical) or "rotation": 3x3,
//  "shift": [x, y, z]}; or {"pairs": [{"model": [x, y, z], "point": "P1" or "survey": [x, y, z],
//  "sigma": 0.01}], "scale": 1, "adjust_scale": false}, model coordinates in the file's own units
// and axes, points of survey/control_points.csv; and after either {"model_crs": "EPSG:25832",
// "survey_crs": "EPSG:2056"}.
// Throws InputError: unreadable, an unknown unit or point, fewer than three pairs or all on a line,
// a rotation that is none.
Placement ReadPlacement(const SitePaths& site, const std::string& name, double metres_per_unit);

// Moves a mesh in metres, z up as the importer left it. Throws InputError at placement.json: PROJ
// does not know a coordinate system, or cannot transform a point.
void Place(const SitePaths& site, const Placement& placement, double metres_per_unit,
           ModelMesh* mesh);

}  // namespace insitu
