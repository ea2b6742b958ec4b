// SPDX-License-Identifier: GPL-3.0-or-later
// Resection in space: the exterior orientation of one photograph from control points.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibration/lens/camera.h"

namespace insitu {

struct ResectionPoint {
  Eigen::Vector3d world;  // [m]
  Eigen::Vector2d pixel;
  double sigma_px = 1;
  double sigma_m = 0;  // of `world`, along each axis: counts where poses are compared
};

struct ResectionResult {
  Rigid3 cam_from_world;
  double rms_px = 0;                       // sqrt(sum |v|^2 / points)
  Eigen::Matrix<double, 6, 6> covariance;  // left rotation increment [rad], camera centre [m]
  bool ambiguous = false;  // three points allow several poses and no start was given
};

// First inversion of the camera model. [Durisch92, §4.1]
// Start values are found here (OpenCV's SQPNP, or P3P for three points), about the points'
// centroid, so coordinates of any size lose nothing; `initial`, if given, picks among several.
// nullopt: fewer than three points, collinear points, or no pose with all points before the camera.
std::optional<ResectionResult> Resect(const Camera& camera,
                                      const std::vector<ResectionPoint>& points,
                                      const std::optional<Rigid3>& initial = std::nullopt);

// Another pose that the marks do not rule out.
struct SecondPose {
  Rigid3 cam_from_world;
  double rms_px = 0;
  double excess = 0;  // of the weighted square sum over the best pose's, of its variance factor
                      // where that is above 1
};

// All minima of the resection, the best first: Resect's, and of coplanar points both [Collins &
// Bartoli 2014, IPPE], of few points those that triples of them start [P3P]. With `initial` or
// `place` (a surveyed centre of projection with its sigma [m]) the nearest of those that the marks
// do not rule out is the best, and rules out what lies farther off than it allows.
struct Resections {
  ResectionResult best;
  std::vector<SecondPose> seconds;  // within the test's reach of the best
  bool are_coplanar = false;        // the points, nearly
  std::optional<double>
      deciding_m;  // how far off the points' plane a further mark would decide between the poses
};
struct SurveyedCenter {
  Eigen::Vector3d position;  // [m]
  double sigma_m = 0;
};
std::optional<Resections> ResectAll(const Camera& camera, const std::vector<ResectionPoint>& points,
                                    const std::optional<Rigid3>& initial = std::nullopt,
                                    const std::optional<SurveyedCenter>& place = std::nullopt);

// Whether points lie on one line: their spread across it is below `tolerance` of that along it.
bool AreCollinear(const std::vector<Eigen::Vector3d>& points, double tolerance = 1e-3);

}  // namespace insitu
