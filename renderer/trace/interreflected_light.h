// SPDX-License-Identifier: GPL-3.0-or-later
// Light among the surfaces of a scene, ready to be looked up.
#pragma once

#include <optional>

#include "renderer/trace/irradiance_map.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

// Of a building with glass, its other faces.
struct OpaqueFaces {
  std::vector<Eigen::Vector3d> normals;
  std::vector<int> material_of_triangle;
};

// What an earlier run solved and gathered of it.
struct KeptLight {
  SolvedLight solved;
  std::vector<KeptPoint> on_site, on_building;
};

struct InterreflectedLight {
  // As AddInterreflection has them.
  InterreflectedLight(const MontageScene& scene, std::optional<int> bounces, const KeptLight* kept,
                      int coarseness);

  std::vector<Spectrum> artificial_brdfs;  // of each material, its diffuse share
  std::vector<Spectrum> translucences;     // of each material
  OpaqueFaces opaque;
  std::vector<int> kind_of_pane;  // of each triangle of glass
  std::optional<ClearFaces> clear;
  TransportScene transport;
  Interreflection interreflection;
  IrradianceMap on_site, on_building;
};

// Solves the interreflection of `scene` and hands it to it. `bounces`: at most; nullopt: until they
// change nothing; 0: sun and sky alone.
// `kept` by KeptLightOf with the same of all this, null: none: that much need not be done again.
// `coarseness`: for quick looks pieces, triangles and tolerance are so many times larger, and the
// directions that are gathered by its square fewer; 1, 2 or 4.
void AddInterreflection(MontageScene* scene, std::optional<int> bounces,
                        const KeptLight* kept = nullptr, int coarseness = 1);

KeptLight KeptLightOf(const InterreflectedLight& light);

}  // namespace insitu
