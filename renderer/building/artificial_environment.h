// SPDX-License-Identifier: GPL-3.0-or-later
// The artificial environment description: the planned building and its lamps. [Durisch92, §5]
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "radiometry/light/material.h"
#include "radiometry/spectrum/spectral_table.h"
#include "renderer/building/light_distribution.h"
#include "renderer/mesh/surface_map.h"

namespace insitu {

// Complex index of refraction, n - i k.
struct Metal {
  SpectralTable index, extinction;  // n > 0, k >= 0
};

// What lets light through: a pane that is drawn as one face, alike from both sides, or a body that
// its faces bound.
struct Glass {
  double weight = 1;  // of the light that is not mirrored, 0..1; the rest meets the diffuse part
  bool is_solid = false;
  double index = 1.5;                                        // of refraction, > 1
  double thickness = 0;                                      // of a pane [m]
  Eigen::Vector3d absorption_rgb = Eigen::Vector3d::Zero();  // linear Rec. 709, >= 0 [1/m]
};

struct SurfaceMaterial {
  std::string name;                                              // the model's layer
  Eigen::Vector3d diffuse_rgb = Eigen::Vector3d::Constant(0.5);  // albedo, linear Rec. 709, 0..1
  double diffuse_weight = 1;                                     // k_d, 0..1
  std::optional<Specular> specular = {};                         // nullopt: purely diffuse
  SpectralTable reflectance =
      {};  // albedo by wavelength, 0..1; goes before diffuse_rgb unless empty
  // Image of the albedo, relative to building/, of which diffuse_rgb is the mean; empty: none.
  std::string texture = {};
  std::optional<Eigen::Vector2d> texture_size =
      {};  // [m] of one repeat; nullopt: the model's places
  Eigen::Vector3d specular_rgb = Eigen::Vector3d::Ones();  // colour of a bare mirror, 0..1
  std::optional<Metal> metal = {};                         // goes before specular_rgb
  std::optional<Glass> glass = {};                         // nullopt: opaque
  std::optional<Bumps> bumps = {};                         // nullopt: flat
  // Share of the light of its other side that it sends on in all directions, linear Rec. 709, and
  // by wavelength, which goes before it unless empty; with the diffuse part at most 1.
  Eigen::Vector3d translucent_rgb = Eigen::Vector3d::Zero();
  SpectralTable translucent = {};
  std::vector<SurfaceMap> maps = {};  // files relative to building/, at the texture's places
};

// Shines alike in all directions unless it has a distribution. Area lights are several of these.
struct PointLight {
  std::string name;
  Eigen::Vector3d position;       // [m], world
  Eigen::Vector3d intensity_rgb;  // radiant intensity: the site's radiance unit times m^2, >= 0
  std::optional<LightDistribution> distribution = {};  // factor of the intensity
  SpectralTable spectrum = {};  // its shape; empty: as Appendix A makes it from intensity_rgb
  double candela = 0;           // at distribution 1; 0: not known in photometric units
  double radius = 0;            // of its luminous sphere, which makes soft shadows [m]
  // Of the parallelogram about its position that it stands for, zero if there is none; it shines
  // to the side of u x v [m].
  Eigen::Vector3d edge_u = Eigen::Vector3d::Zero(), edge_v = Eigen::Vector3d::Zero();
  bool is_visible = false;  // the luminous surface itself
};

// The paper's third kind of object: exact, whatever looks at it.
struct EnvironmentSphere {
  Eigen::Vector3d center;  // [m], world
  double radius = 0;       // > 0 [m]
  int material = 0;        // index into materials
};

struct ArtificialEnvironment {
  std::vector<SurfaceMaterial> materials;
  std::vector<Eigen::Vector3d> vertices;        // [m], world
  std::vector<Eigen::Vector3i> triangles;       // indices into vertices
  std::vector<int> material_of_triangle;        // index into materials
  std::vector<Eigen::Vector3f> corner_normals;  // empty, or three a triangle: unit
  std::vector<Eigen::Vector2f> corner_uvs;      // empty, or three a triangle
  std::vector<EnvironmentSphere> spheres = {};
  std::vector<PointLight> lights = {};
};

// work/building.json (readable, versioned; its spheres) and building.bin beside it (the mesh:
// little-endian doubles and 32-bit indices, as the JSON states). Reading throws InputError, also
// when the two files do not belong together.
void WriteArtificialEnvironment(const SitePaths& site, const ArtificialEnvironment& environment);
// The same as any FILE.json and FILE.bin.
void WriteArtificialEnvironmentFile(const std::filesystem::path& file,
                                    const ArtificialEnvironment& environment);
ArtificialEnvironment ReadArtificialEnvironment(const SitePaths& site);

}  // namespace insitu
