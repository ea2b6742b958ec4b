// SPDX-License-Identifier: GPL-3.0-or-later
// What each photograph makes of one radiance: from surfaces that several of them show, and from
// what EXIF states.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibration/photo/exif.h"
#include "radiometry/measure/photograph_set.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {

struct PhotoExposure {
  // Its linear values over those of the site's one unit, by channel; exactly 1 where it does not
  // differ by more than chance and 2 %.
  Eigen::Vector3d gain = Eigen::Vector3d::Ones();
  double measured = 1;                        // the same before that, of luminance
  double sigma = 0;                           // of `measured`, relative
  int points = 0;                             // that other photographs show too
  std::optional<double> by_exif;              // what EXIF makes of it; nullopt: not stated
  Eigen::Vector3d white_balance = {1, 1, 1};  // `measured` by channel over that of luminance

  bool IsOne() const { return gain == Eigen::Vector3d::Ones(); }
};

struct ExposureFit {
  std::vector<PhotoExposure> photos;  // as the scene's cameras
  // ln of what is left at the frame's corner by vignetting that all photographs share, beyond that
  // of the camera's own correction; and its sigma. nullopt: too few points tell it.
  std::optional<double> corner_falloff;
  double corner_falloff_sigma = 0;
};

// Robust least squares over points on the polygons that two photographs show, unclipped and of no
// mirroring material, with EXIF's nominal values at a third of a stop. The unit is that of the
// photograph in the middle. `mirrors`: by polygon, whether its material mirrors.
ExposureFit MeasureExposures(const SceneGeometry& scene, const PhotographSet& photos,
                             const std::vector<ExifExposure>& exif,
                             const std::vector<bool>& mirrors);

// Divides a picture by the gain of its photograph, channel by channel.
void DivideByGain(const Eigen::Vector3d& gain, Raster* picture);
Eigen::Vector3f FactorOfGain(const Eigen::Vector3d& gain);  // by which that multiplies

}  // namespace insitu
