// SPDX-License-Identifier: GPL-3.0-or-later
// An adjusted survey: posed cameras, points, planes, sun and zenith, with every statistic of the
// residual report.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/lens/rigid3.h"
#include "reconstruction/geometry/scene_geometry.h"
#include "reconstruction/network/network_system.h"

namespace insitu {

// What an observation is of.
enum class ObservationKind {
  kImage,  // a mark, x and y
  kEdge,
  kControl,         // a surveyed point, x, y and z
  kCameraPosition,  // a surveyed centre of projection, x, y and z
  kLens,            // a parameter, from its calibration
  kPlane,           // a vertex on its polygon's plane
  kSun,
  kZenith,
  kDistance,
  kHeight,
  kAngle,
};

// One scalar observation after the adjustment; residual = adjusted - observed, in sigma's unit.
struct ObservationResidual {
  ObservationKind kind = ObservationKind::kImage;
  int axis = 0;         // 0, 1, 2: x, y, z of what has several; else 0
  std::string photo;    // of image observations, edges and camera positions, else empty
  std::string subject;  // point, pair of points, photo, parameter; both sides of an angle
  double observed = 0, residual = 0, sigma = 0;
  double redundancy = 0;                     // its redundancy number, 0..1
  std::optional<double> w = {};              // test value, standard normal; nullopt: not controlled
  std::optional<double> detectable = {};     // minimal detectable bias, in sigma's unit
  std::optional<double> external = {};       // its effect on any function of the unknowns, in that
                                             // function's sigmas: delta0 sqrt((1 - r) / r)
  std::optional<double> point_shift_m = {};  // its effect on the position of the point concerned
  bool is_tie_point = false;                 // of a point that COLMAP found, not a surveyor
  std::string polygon = {};                  // of the plane on which the vertex `subject` lies
};

// An interior orientation after the adjustment.
struct AdjustedCamera {
  struct Parameter {
    std::string name;
    double value = 0;  // [px] or 1 as mrcal has it; [mm ...] for metric cameras
    bool is_adjusted = false;
    double sigma = 0;                    // of adjusted parameters, else of its calibration
    std::optional<double> significance;  // two-sided p of value = 0, of adjusted distortion
  };
  std::string name;
  std::string lens_model;
  std::vector<Parameter> parameters;
  Eigen::MatrixXd correlation;  // of the adjusted parameters, in their order
  bool is_considered = false;   // its calibration's covariance entered all others
};

struct AdjustedPose {
  std::string photo;
  int camera = 0;  // index into Adjustment::cameras
  Rigid3 cam_from_world;
  Eigen::Matrix<double, 6, 6> covariance;  // left rotation increment [rad], camera centre [m]
  Eigen::MatrixXd lens_correlation;        // 6 x adjusted parameters; empty without them
  int points = 0;
  double rms_px = 0;
  Eigen::Vector2d max_px = Eigen::Vector2d::Zero();  // largest |vx|, |vy|
  double coverage = 0;  // share of the frame's area within the hull of its marks, 0..1
};

struct AdjustedPoint {
  std::string name;
  Eigen::Vector3d position;    // [m], world
  Eigen::Matrix3d covariance;  // [m^2], scaled by sigma0^2
  int rays = 0;
  double rms_px = 0;  // of its marks
  bool is_tie_point = false;
};

struct AdjustedPlane {
  std::string polygon;
  Eigen::Vector3d normal;             // unit, outward
  Eigen::Vector3d centroid;           // [m], world; offset counts from it
  double offset = 0;                  // [m]
  Eigen::Matrix3d normal_covariance;  // rank 2
  Eigen::Matrix3d tilt_covariance;  // of the normal against the zenith, whose error counts; rank 2
  double offset_sigma = 0;          // [m]
  double vertex_sigma = 0;          // [m], a priori, of a vertex's distance from it
  double planarity_rms = 0;         // [m], of its vertices
  std::optional<double> off_vertical,
      off_vertical_sigma;  // [rad], angle of the plane to the zenith
};

// A surveyed point against the adjustment; for a check point the combined sigma is that of the
// difference, sqrt(survey^2 + adjusted^2).
struct PointComparison {
  std::string name;
  Eigen::Vector3d difference;                                // adjusted - surveyed [m]
  Eigen::Vector3d sigma;                                     // [m]
  Eigen::Vector3d surveyed = Eigen::Vector3d::Zero();        // [m], world
  Eigen::Vector3d surveyed_sigma = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d adjusted_sigma = Eigen::Vector3d::Zero();  // [m]
};

struct GlobalTest {
  double statistic = 0;      // sum (v / sigma)^2
  double low = 0, high = 0;  // two-sided bounds at `alpha`
  double alpha = 0.05;
  double p = 1;  // two-sided
};

// Correlations above this are told.
inline constexpr double kHighCorrelation = 0.95;

// Between two unknowns of one camera, photo or point.
struct Correlation {
  enum class Of { kCamera, kPhoto, kPoint };
  Of of = Of::kPhoto;
  std::string first, second;  // "photo IMG_1 center x", ...
  double value = 0;           // |value| > kHighCorrelation
};

// The solution with planes against that without: do the planes hold, and what do they move?
struct PlaneEffect {
  struct Shift {
    std::string name;            // a point, or "photo IMG_1" for its centre
    Eigen::Vector3d difference;  // with planes - without [m]
    // Along the axis that the planes hold most, a priori [m], and the test value there; nullopt:
    // planes hold it in no way.
    std::optional<double> sigma, w;
  };
  std::string unknown_because;  // empty: it is known
  int redundancy = 0;           // of the solution without planes
  double sigma0 = 0;            // of the same
  // The planes' share of the sum (v / sigma)^2; chi-square distributed if they hold.
  double statistic = 0, limit = 0, alpha = 0.05;
  int degrees = 0;
  std::vector<std::string> held_by_planes;  // points on fewer than two photos, not compared
  std::vector<Shift> shifts;                // of photos and surveyed points
};

struct Adjustment {
  std::vector<AdjustedCamera> cameras;
  std::vector<AdjustedPose> poses;
  std::vector<AdjustedPoint> points;
  std::vector<AdjustedPlane> planes;
  PlaneEffect plane_effect;
  SceneGeometry scene;
  double sigma0 = 0;  // a posteriori, a priori 1
  int observations = 0, unknowns = 0, datum_defect = 0, redundancy = 0, iterations = 0;
  bool is_converged = true;
  std::map<std::string, int> unknowns_of;  // their number by what they belong to: "points", ...
  DatumWorth datum_worth;
  bool has_scale = true;    // else a unit of length is arbitrary
  std::string datum;        // in words: "fixed by the survey", or what is free and how it was fixed
  double chi_square_p = 0;  // two-sided p of the global test
  GlobalTest global_test;
  double critical_w = 3.29;  // of each w-test, at AdjustmentOptions::significance
  std::vector<ObservationResidual> residuals;
  std::vector<PointComparison> control, check;
  std::vector<PointComparison>
      left_out;                     // each control point predicted without its own coordinates
  double check_rms_over_sigma = 0;  // sqrt(mean((difference/sigma)^2)) over the check coordinates
  double left_out_rms_over_sigma = 0;     // the same over left_out
  std::vector<Correlation> correlations;  // largest first
  std::vector<std::string> warnings;      // besides a datum that is free
  std::string BriefReport() const;
  // What scale, north and height are worth for a building of this size [m].
  std::string DatumWorthInWords(double building) const;
};

}  // namespace insitu
