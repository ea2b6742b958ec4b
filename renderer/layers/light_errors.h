// SPDX-License-Identifier: GPL-3.0-or-later
// How well the light is known that a montage is made of.
#pragma once

#include <Eigen/Core>

#include "calibration/program/site.h"
#include "radiometry/natural_environment.h"

namespace insitu {

// Standard deviations over values, linear RGB; zero where there is no such light or none is known.
struct LightErrors {
  Eigen::Vector3d sun = Eigen::Vector3d::Zero();
  Eigen::Vector3d sky = Eigen::Vector3d::Zero();
};

// From work/environment.json, as insitu-light fitted them.
LightErrors ReadLightErrors(const SitePaths& site, const NaturalEnvironment& natural);

}  // namespace insitu
