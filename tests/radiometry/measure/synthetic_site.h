// SPDX-License-Identifier: GPL-3.0-or-later
// A site small enough for closed forms: a level ground, a long wall, a gravel path a centimetre
// above the ground, two photographs. Sky shares follow from elevation angles, not from ray casting.
#pragma once

#include <Eigen/Core>
#include <string>

#include "calibration/program/site.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {

struct SyntheticSite {
  SitePaths site;
  SceneGeometry scene;
  // Linear Rec. 709.
  Eigen::Vector3d sun_irradiance{4.9, 4.7, 4.4};  // across the rays
  Eigen::Vector3d sky_radiance{0.41, 0.48, 0.57};
  Eigen::Vector3d ambient_radiance{0.10, 0.11, 0.09};
  Eigen::Vector3d horizon{0.9, 0.95, 1.0};
  Eigen::Vector3d transmittance{0.9992, 0.9990, 0.9986};  // per metre
  double reflectance = 0.4;
};

// Writes scene, photographs (EXR) and samples.json into a fresh folder of that name below
// testing::TempDir(). Photos: "A" before the wall, "B" 165 m behind it.
SyntheticSite MakeSyntheticSite(const std::string& name);

// One entry of samples.json; `local` is a point about the scene's origin [m].
std::string SampleEntry(const SyntheticSite& synthetic, const std::string& photo,
                        const std::string& polygon, const Eigen::Vector3d& local);

}  // namespace insitu
