// SPDX-License-Identifier: GPL-3.0-or-later
// What the joint adjustment is about: unknowns and observations, by index, without file names or
// lines. Surveys, imported projects and tests all become a Network; solve_network.h solves it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "calibration/lens/lens_residual.h"

namespace insitu {

// ---- unknowns ------------------------------------------------------------------------------

// An interior orientation, shared by photos.
struct NetworkCamera {
  std::string name;
  Lens lens;
  std::vector<bool> is_free = {};  // by parameter; empty: none is adjusted (no self-calibration)
  // Of all its parameters, from its calibration; empty: exact. Parameters that are not adjusted are
  // then considered: their values stay, their uncertainty enters every covariance.
  Eigen::MatrixXd calibration_covariance = {};
};

struct NetworkPhoto {
  std::string name;
  int camera = 0;  // index into Network::cameras
  Eigen::Quaterniond cam_from_local = Eigen::Quaterniond::Identity();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // [m], local
  bool is_center_fixed = false;                      // a surveyed tripod taken as exact
};

struct NetworkPoint {
  std::string name;
  Eigen::Vector3d position;   // [m], local
  bool is_fixed = false;      // control taken as exact
  bool is_tie_point = false;  // found by image matching
};

// The points x with normal . (x - centroid) = offset; the centroid is a constant.
struct NetworkPlane {
  std::string name;
  Eigen::Vector3d normal;    // unit
  Eigen::Vector3d centroid;  // [m], local
  double offset = 0;         // [m]
};

// An unknown unit vector: to the sun, to the zenith.
struct NetworkDirection {
  std::string name;
  Eigen::Vector3d unit;
  bool is_fixed = false;  // the z axis taken for the zenith
};

// ---- observations; every sigma > 0 ---------------------------------------------------------

// A point's image. [Durisch92, §3.5]
struct MarkObservation {
  int photo = 0, point = 0;
  Eigen::Vector2d pixel;
  double sigma_px = 1;
};

// A place on the image of the straight edge between two points: its distance from it.
struct EdgeObservation {
  int photo = 0, from = 0, to = 0;  // points
  Eigen::Vector2d pixel;
  double sigma_px = 1;
};

struct ControlObservation {
  int point = 0;
  Eigen::Vector3d position;  // [m], local
  Eigen::Vector3d sigma;     // [m], per axis
};

// A surveyed centre of projection, or an antenna at `arm` from it.
struct CenterObservation {
  int photo = 0;
  Eigen::Vector3d position;                       // [m], local
  Eigen::Vector3d sigma;                          // [m], per axis
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  // [m], in the camera's axes
};

// What a calibration told of a lens. Where the lens is adjusted, of its free parameters; else this
// observes nothing.
struct LensObservation {
  int camera = 0;
  std::vector<double> values;  // of all its parameters
  Eigen::MatrixXd covariance;  // the same, positive definite
};

// What a survey states without measuring it is observed as 0; a simulation adds its error there.

// A vertex on a plane, or at a distance along its normal.
struct PlaneObservation {
  int plane = 0, point = 0;
  double sigma = 0;     // [m]
  double distance = 0;  // [m]
};

// Two points on a line along a direction: both parts of (to - from) across it.
struct DirectionObservation {
  int direction = 0, from = 0, to = 0;
  double sigma = 0;                                  // [m]
  Eigen::Vector2d across = Eigen::Vector2d::Zero();  // [m], along AxesAcross the start direction
};

struct DistanceObservation {
  int from = 0, to = 0;
  double distance = 0, sigma = 0;  // [m]
};

// (to - from) . direction; 0 for equal heights.
struct HeightObservation {
  int direction = 0, from = 0, to = 0;
  double height = 0, sigma = 0;  // [m]
};

// A unit vector among the unknowns, or the edge between two points.
struct PlaneNormal {
  int plane = 0;
};
struct DirectionUnit {
  int direction = 0;
};
struct EdgeUnit {
  int from = 0, to = 0;
};
using UnitReference = std::variant<PlaneNormal, DirectionUnit, EdgeUnit>;

// Parallel: both parts of the one across the other; else perpendicular: their product.
// A vertical wall: its normal perpendicular to the zenith. A level floor: parallel to it.
struct AngleObservation {
  UnitReference first, second;
  bool is_parallel = false;
  double sigma = 0;                                     // [rad]
  Eigen::Vector2d departure = Eigen::Vector2d::Zero();  // [rad], its second part if parallel
};

// All coordinates are world minus `origin`, so that national grids lose nothing.
struct Network {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // [m], world
  std::vector<NetworkCamera> cameras;
  std::vector<NetworkPhoto> photos;
  std::vector<NetworkPoint> points;
  std::vector<NetworkPlane> planes;
  std::vector<NetworkDirection> directions;

  std::vector<MarkObservation> marks;
  // By what tie marks' variances are multiplied where they are weighted, since errors of neighbours
  // are alike (mark_correlation.h); nullopt: to be found with the solution.
  std::optional<double> tie_mark_inflation = {};
  std::vector<EdgeObservation> edges;
  std::vector<ControlObservation> control;
  std::vector<CenterObservation> centers;
  std::vector<LensObservation> lenses;
  std::vector<PlaneObservation> on_planes;
  std::vector<DirectionObservation> along_directions;
  std::vector<DistanceObservation> distances;
  std::vector<HeightObservation> heights;
  std::vector<AngleObservation> angles;
};

}  // namespace insitu
