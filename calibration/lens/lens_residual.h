// SPDX-License-Identifier: GPL-3.0-or-later
// What a mark tells of a lens: one residual for mrcal's models and for metric ones.
#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "calibration/lens/camera.h"
#include "calibration/lens/metric_camera.h"

namespace insitu {

using Lens = std::variant<Camera, MetricCamera>;

// The lens's parameters as they stand: mrcal's intrinsics, or MetricCamera::parameters.
std::vector<double> LensParameters(const Lens& lens);
std::vector<std::string> LensParameterNames(const Lens& lens);

// The same lens with other parameters, of the same number.
Lens WithParameters(const Lens& lens, const std::vector<double>& parameters);

// Derivatives of a residual [px]; null: not asked for.
struct LensDerivatives {
  Eigen::Matrix<double, 2, 3>* by_point = nullptr;                                     // [px/m]
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>* by_parameters = nullptr;  // 2 x n
};

// Residual of a mark in pixels, x right, y down, given the lens's parameters. Of a lens that
// distorts the ideal position it is projected - observed; of one that corrects the observed
// position (backward Brown) ideal - corrected, which is what PhotoModeler and DBAT minimise.
// False: the point is not before the camera.
bool LensResidual(const Lens& lens, const double* parameters, const Eigen::Vector3d& point_in_cam,
                  const Eigen::Vector2d& observed_px, Eigen::Vector2d* residual_px,
                  const LensDerivatives& derivatives);

}  // namespace insitu
