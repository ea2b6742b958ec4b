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
  // `kept` of the same scene and bounces; null: none.
  InterreflectedLight(const MontageScene& scene, std::optional<int> bounces,
                      const KeptLight* kept = nullptr);

  std::vector<Spectrum> artificial_brdfs;  // of each material, its diffuse share
  OpaqueFaces opaque;
  std::vector<int> kind_of_pane;  // of each triangle of glass
  std::optional<ClearFaces> clear;
  TransportScene transport;
  Interreflection interreflection;
  IrradianceMap on_site, on_building;
};

// Solves the interreflection of `scene` and hands it to it. `bounces`: at most; nullopt: until they
// change nothing; 0: sun and sky alone.
// `kept` by KeptLightOf with the same scene and bounces: that much need not be done again.
void AddInterreflection(MontageScene* scene, std::optional<int> bounces,
                        const KeptLight* kept = nullptr);

KeptLight KeptLightOf(const InterreflectedLight& light);

}  // namespace insitu
