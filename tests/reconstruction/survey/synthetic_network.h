// SPDX-License-Identifier: GPL-3.0-or-later
// A small town with known truth, surveyed and photographed without error; noise is a separate call.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "calibration/lens/rigid3.h"
#include "calibration/program/site.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

struct SyntheticNetworkOptions {
  Eigen::Vector3d origin = {1000, 2000, 400};  // [m], of the town's middle
  double tilt = 0.006;                         // [rad], of the zenith from the z axis
  double mark_sigma_px = 0.4;
  double control_sigma = 0.005;  // [m]
  bool has_extras = false;       // camera positions, marks on edges and constraints of each kind
};

// Four photographs in an arc before three boxes a, b, c on a ground polygon. Every point inside a
// frame is marked, as if the boxes were of glass, but "single", a vertex of the ground, on the last
// photo only and "buried", another, on none. Control: "buried", the grid g0..g8 on the ground and
// the corners a0..a7. Check: b4 and b5. "sail" is a triangle between roofs.
struct SyntheticNetwork {
  std::vector<std::string> photos;
  std::vector<Camera> cameras;
  std::vector<Rigid3> cam_from_world;
  std::map<std::string, Eigen::Vector3d> points;  // [m], world
  Eigen::Vector3d sun, zenith;                    // unit
  Survey survey;                                  // its places are the lines WriteSurvey writes
};
SyntheticNetwork MakeSyntheticNetwork(const SyntheticNetworkOptions& options = {});

// Gaussian errors of their own sigma on all marks, surveyed points and camera positions (but fixed
// ones), measured distances and heights.
Survey WithNoise(const Survey& survey, unsigned seed);

// Writes the survey files as ReadSurvey expects them, one polygon, pair, point or constraint a
// line; of camera_positions.csv, edges.csv and constraints.json those that are not empty.
void WriteSurvey(const SitePaths& site, const Survey& survey);

}  // namespace insitu
