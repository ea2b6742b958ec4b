// SPDX-License-Identifier: GPL-3.0-or-later
// A camera's response from surfaces in known geometry, jointly with the light and their
// reflectances.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "calibration/color/response.h"

namespace insitu {

// A place on a surface, as one photograph shows it.
struct ResponseSample {
  Eigen::Vector3d code = Eigen::Vector3d::Zero();  // what the picture has as sRGB, in (0, 1)
  int surface = 0;                                 // places of one polygon
  int material = 0;                                // of that; the reflectance of 0 is known
  double sun = 0, sky = 0;  // what it sees of them: LightGeometry, projected [sr]
  // Irradiance from around, by the present response.
  Eigen::Vector3d surroundings = Eigen::Vector3d::Zero();
  // Of the air between, by the present response: apparent = through * true + added.
  Eigen::Vector3d through = Eigen::Vector3d::Ones(), added = Eigen::Vector3d::Zero();
};

struct ResponseFitOptions {
  Eigen::Vector3d reflectance = Eigen::Vector3d::Ones();  // of material 0
  // To start from, by channel: the radiances of sun and sky by the present response, > 0.
  Eigen::Vector3d sun = Eigen::Vector3d::Ones(), sky = Eigen::Vector3d::Ones();
  // The photographed sky's codes, where it is seen, and the standard deviation of ln of its light.
  std::optional<Eigen::Vector3d> sky_code = std::nullopt;
  double sky_sigma = 0.03;
  double sigma = 0.05;         // of ln of a place's light: grain, and that no surface is even
  double surface_sigma = 0.1;  // of ln of a surface's reflectance, from its material's
  double slope_sigma = 0.3;    // of ln of the curve's slope over sRGB's, from knot to knot
};

struct ResponseFit {
  std::array<ResponsePoints, 3> curves;                          // light 1 at code 1
  Eigen::Vector3d sun_over_sky = Eigen::Vector3d::Zero();        // of their radiances
  Eigen::Vector3d sun_over_sky_sigma = Eigen::Vector3d::Zero();  // of its logarithm
  double rms = 0;    // of the residuals over sigma, of places that count
  double share = 0;  // of places that count
};

// Curves whose slope is that of sRGB times exp of a line between 17 knots, radiances of sun and sky
// and the reflectances, by least squares with Tukey's weights, which end at three sigmas:
//   code = curve^-1(through * rho / pi (sun s + sky h + surroundings) + added).
// Residuals are of codes, in light by the slope of the curve of the last round: of light itself
// they would be smallest for the flattest curve. Where no place tells of it, the slope is its
// neighbour's. Needs three places of material 0 (INSITU_CHECK).
ResponseFit FitResponse(const std::vector<ResponseSample>& samples,
                        const ResponseFitOptions& options);

}  // namespace insitu
