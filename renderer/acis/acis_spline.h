// SPDX-License-Identifier: GPL-3.0-or-later
// B-spline curves of ACIS: the curve that an intcurve holds beside the surfaces that it comes of.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "renderer/acis/acis_file.h"

namespace insitu {

struct AcisSpline {
  int degree = 1;
  std::vector<double> knots;           // rising, degree + 1 of them alike at both ends
  std::vector<Eigen::Vector4d> poles;  // x, y, z, weight

  double begin() const { return knots.front(); }
  double end() const { return knots.back(); }
  Eigen::Vector3d PointAt(double parameter) const;         // by de Boor's algorithm
  double ParameterOf(const Eigen::Vector3d& point) const;  // of the nearest point
};

// nullopt: it holds none of its own ("ref"), or a damaged one.
std::optional<AcisSpline> AcisSplineOf(const AcisRecord& record);

// Points from parameter `from` to `to`, both ends among them: no chord is further from the curve
// than about `tolerance`, and neighbours turn by 15 degrees at most; at most 1024 of them.
std::vector<Eigen::Vector3d> SplinePoints(const AcisSpline& spline, double from, double to,
                                          double tolerance);

}  // namespace insitu
