// SPDX-License-Identifier: GPL-3.0-or-later
// How well the marks of control points on each photo fit one camera position, before any
// adjustment: plainly, and robustly where a few of them do not belong to the others.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reconstruction/geometry/resection.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// A mark with the control point of its name; pointers into the survey, never null.
struct ControlMark {
  const ImageObservation* mark;
  const ControlPoint* control;
};

// The marks of points of role control on one photo.
std::vector<ControlMark> ControlMarksOn(const Survey& survey, const std::string& photo);

// The standard deviation of a control point's image, from its mark and its coordinates [px].
double SigmaPx(const ControlMark& mark, const Camera& camera, const Rigid3& cam_from_world);

struct ControlFit {
  size_t photo = 0;  // index into `photos`
  std::vector<ControlMark> marks;
  Rigid3 cam_from_world;
  Eigen::Matrix3d center_covariance;  // [m^2], of exact marks' sigma
  double rms_px = 0;                  // sqrt(sum |v|^2 / points)
  double rms_over_sigma = 0;          // of the redundancy, 1 expected
};

// nullopt: fewer than four control points, or no pose with all of them before the camera.
std::optional<ControlFit> FitControl(const Survey& survey, const std::vector<std::string>& photos,
                                     const std::vector<Camera>& cameras, size_t photo);

// The pose that most marks agree on, and those marks that do not.
struct RobustFit {
  ControlFit fit;  // of the marks that agree
  std::vector<ControlMark> outliers;
};

// By random samples, always the same ones. nullopt: fewer than five control points, or no pose that
// three out of five of them, and four at least, fit.
std::optional<RobustFit> FitControlRobustly(const Survey& survey,
                                            const std::vector<std::string>& photos,
                                            const std::vector<Camera>& cameras, size_t photo);

}  // namespace insitu
