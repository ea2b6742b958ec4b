// SPDX-License-Identifier: GPL-3.0-or-later
// What a single mark tells of the other photographs: where its point is imaged if it stands on a
// polygon's plane, and how far beside the epipolar curve it may be. Both with all that the
// adjustment knows jointly.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reconstruction/adjustment/solve_survey.h"
#include "reconstruction/geometry/lens_view.h"
#include "reconstruction/geometry/projection_uncertainty.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// On an adjusted photo.
struct SingleMark {
  std::string photo;
  Eigen::Vector2d pixel;
  double sigma_px;
};

// Where a mark's ray meets a plane, with its images.
struct PointOnPlane {
  Eigen::Vector3d position;                        // [m], world
  Eigen::Matrix3d covariance;                      // [m^2]
  std::map<std::string, ImageUncertainty> images;  // by photo, the mark's too, where in the frame
};

// The point of a mark that lies on the plane of an adjusted polygon, off it by `plane_sigma` [m] as
// the polygon's own vertices do. nullopt: parallel or behind.
std::optional<PointOnPlane> WhereRayMeets(const SolvedSurvey& solved, const SingleMark& mark,
                                          const PolygonOutline& polygon, double plane_sigma);

// For each place of the mark's epipolar curve on another adjusted photo, how far across it the
// band of 95 % reaches on either side [px].
std::vector<Eigen::Vector2d> EpipolarBand(const SolvedSurvey& solved, const SingleMark& mark,
                                          const std::string& other, const Polyline& curve);

}  // namespace insitu
