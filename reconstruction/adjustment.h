// SPDX-License-Identifier: GPL-3.0-or-later
// The joint least-squares adjustment: exterior orientations, points, planes, sun and zenith in one
// system, by Ceres. Control is observed with its sigma; check points only by their marks.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reconstruction/scene_geometry.h"
#include "reconstruction/survey.h"

namespace insitu {

struct AdjustmentOptions {
  double plane_sigma = 0.005;   // [m], distance of a vertex from its polygon's plane
  double zenith_sigma = 0.005;  // [m], across, of a vertical edge's ends
  double sun_sigma = 0.02;      // [m], across, of a shadow point from the line to the sun
  std::map<std::string, Rigid3> initial_cam_from_world;  // user's estimates, by photo; none needed
};

// One scalar observation after the adjustment; residual = adjusted - observed, in sigma's unit.
struct ObservationResidual {
  std::string group;    // "image x", "image y", "control x" ... "plane", "sun", "zenith"
  std::string photo;    // of image observations, else empty
  std::string subject;  // point, polygon or pair
  double observed = 0, residual = 0, sigma = 0;
  double redundancy = 0;  // its redundancy number, 0..1
};

struct AdjustedPose {
  std::string photo;
  Rigid3 cam_from_world;
  Eigen::Matrix<double, 6, 6> covariance;  // left rotation increment [rad], camera centre [m]
  int points = 0;
  double rms_px = 0;
};

struct AdjustedPoint {
  std::string name;
  Eigen::Vector3d position;    // [m], world
  Eigen::Matrix3d covariance;  // [m^2], scaled by sigma0^2
  int rays = 0;
  double rms_px = 0;  // of its marks
};

// A surveyed point against the adjustment; for a check point the combined sigma is that of the
// difference, sqrt(survey^2 + adjusted^2).
struct PointComparison {
  std::string name;
  Eigen::Vector3d difference;  // adjusted - surveyed [m]
  Eigen::Vector3d sigma;       // [m]
};

struct Adjustment {
  std::vector<AdjustedPose> poses;
  std::vector<AdjustedPoint> points;
  SceneGeometry scene;
  double sigma0 = 0;  // a posteriori, a priori 1
  int observations = 0, unknowns = 0, redundancy = 0, iterations = 0;
  double chi_square_p = 0;  // two-sided p of the global test
  std::vector<ObservationResidual> residuals;
  std::vector<PointComparison> control, check;
  double check_rms_over_sigma = 0;  // sqrt(mean((difference/sigma)^2)) over the check coordinates
  std::vector<std::string> warnings;
  std::string BriefReport() const;
};

// Resects, intersects, then adjusts. Throws InputError, at the survey line concerned: a photo with
// fewer than three control points or with collinear ones, a point that nothing determines, a
// polygon whose vertices are far from planar (over 20 sigma and 0.1 m), a rank defect (its
// parameters named). `cameras` and `photos` go together.
Adjustment Adjust(const Survey& survey, const std::vector<std::string>& photos,
                  const std::vector<Camera>& cameras, const AdjustmentOptions& options = {});

}  // namespace insitu
