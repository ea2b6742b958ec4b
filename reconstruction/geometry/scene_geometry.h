// SPDX-License-Identifier: GPL-3.0-or-later
// What the reconstruction hands on: posed cameras, planar polygons, sun and zenith.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibration/files/json_file.h"
#include "calibration/lens/camera.h"
#include "calibration/program/site.h"

namespace insitu {

// A planar polygon of the natural environment. [Durisch92, §3.6, §4.1]
struct Polygon {
  std::string name;
  std::vector<Eigen::Vector3d> vertices;  // [m], world, counter-clockwise seen from outside
  Eigen::Vector3d normal;                 // unit, outward, of the adjusted plane
  std::optional<int> photo;               // image attribute: index into SceneGeometry::cameras
  std::string material;                   // material attribute
  // 3n x 3n [m^2], joint, of AllVertices in their order; empty where nothing is known.
  Eigen::MatrixXd covariance = {};
  std::vector<std::vector<Eigen::Vector3d>> holes =
      {};  // in its plane, within it, either way round
};

// The outline's vertices, then each hole's. [m], world
std::vector<Eigen::Vector3d> AllVertices(const Polygon& polygon);

// Without its holes. [m^2]
double AreaOf(const Polygon& polygon);

// A measured direction in the world frame.
struct Direction {
  Eigen::Vector3d unit = Eigen::Vector3d::UnitZ();       // to the sun, or to the zenith
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of the unit vector (rank 2)
};

struct SceneGeometry {
  Eigen::Vector3d origin;  // a round point near the site; single-precision work is about it
  std::vector<PosedCamera> cameras;
  // As cameras, of left rotation increment [rad], centre [m] and, of a lens that is not exactly
  // known, its intrinsics; empty where nothing is known.
  std::vector<Eigen::MatrixXd> camera_covariances;
  std::vector<Polygon> polygons;
  std::optional<Direction> sun;  // nullopt: overcast, no sun pairs
  Direction zenith;
  double vertex_sigma = 0;  // [m], the median posterior sigma of a vertex coordinate
};

// Index of the polygon of the largest area within ten degrees of level, facing up; nullopt: none
// is.
std::optional<int> LargestLevelPolygon(const SceneGeometry& scene);

// Triangles of it, indices into AllVertices, about its normal; nullopt: FaultOfRings has a reason.
std::optional<std::vector<Eigen::Vector3i>> TrianglesOf(const Polygon& polygon);

// Whether it has TrianglesOf, as rays need it.
bool HasInterior(const Polygon& polygon);

// work/reconstruction/scene.json and the .cameramodel files beside it. Reading throws InputError.
void WriteSceneGeometry(const SitePaths& site, const SceneGeometry& scene);
SceneGeometry ReadSceneGeometry(const SitePaths& site);

// The member "holes" of a polygon: a list of lists of vertices. Reading throws InputError at a hole
// of fewer than three.
Json::Value HolesToJson(const std::vector<std::vector<Eigen::Vector3d>>& holes);
std::vector<std::vector<Eigen::Vector3d>> HolesFromJson(const JsonNode& node);

// The point of a polygon that a pixel of `camera` sees, ignoring everything before it; nullopt if
// the line of sight misses the polygon or goes through a hole.
std::optional<Eigen::Vector3d> PointOnPolygon(const PosedCamera& camera,
                                              const Eigen::Vector2d& pixel, const Polygon& polygon);

}  // namespace insitu
