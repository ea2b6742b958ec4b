// SPDX-License-Identifier: GPL-3.0-or-later
// Light among the surfaces of a scene, ready to be looked up.
#pragma once

#include "renderer/trace/irradiance_map.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

struct InterreflectedLight {
  InterreflectedLight(const MontageScene& scene, std::optional<int> bounces);

  std::vector<Spectrum> artificial_brdfs;  // of each material, its diffuse share
  TransportScene transport;
  Interreflection interreflection;
  IrradianceMap on_site, on_building;
};

// Solves the interreflection of `scene` and hands it to it. `bounces`: at most; nullopt: until they
// change nothing; 0: sun and sky alone.
void AddInterreflection(MontageScene* scene, std::optional<int> bounces);

}  // namespace insitu
