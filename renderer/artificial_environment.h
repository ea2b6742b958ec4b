// SPDX-License-Identifier: GPL-3.0-or-later
// The artificial environment description: the planned building and its lamps. [Durisch92, §5]
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/site.h"
#include "radiometry/material.h"

namespace insitu {

struct SurfaceMaterial {
  std::string name;                                              // the model's layer
  Eigen::Vector3d diffuse_rgb = Eigen::Vector3d::Constant(0.5);  // albedo, linear Rec. 709, 0..1
  double diffuse_weight = 1;                                     // k_d, 0..1
  std::optional<Specular> specular;                              // nullopt: purely diffuse
};

// Shines alike in all directions.
struct PointLight {
  std::string name;
  Eigen::Vector3d position;       // [m], world
  Eigen::Vector3d intensity_rgb;  // radiant intensity: the site's radiance unit times m^2, >= 0
};

struct ArtificialEnvironment {
  std::vector<SurfaceMaterial> materials;
  std::vector<Eigen::Vector3d> vertices;   // [m], world
  std::vector<Eigen::Vector3i> triangles;  // indices into vertices
  std::vector<int> material_of_triangle;   // index into materials
  std::vector<PointLight> lights;
};

// work/building.json (readable, versioned) and building.bin beside it (the mesh: little-endian
// doubles and 32-bit indices, as the JSON states). Reading throws InputError, also when the two
// files do not belong together.
void WriteArtificialEnvironment(const SitePaths& site, const ArtificialEnvironment& environment);
ArtificialEnvironment ReadArtificialEnvironment(const SitePaths& site);

}  // namespace insitu
