// SPDX-License-Identifier: GPL-3.0-or-later
// How natural materials reflect beyond what their photograph tells: survey/materials.json.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "calibration/files/json_file.h"
#include "calibration/program/site.h"
#include "radiometry/library/material_keys.h"
#include "radiometry/light/bumps.h"
#include "radiometry/light/microfacet.h"

namespace insitu {

// A mirroring share over a diffuse ground: L = F w L_mirror + (1 - F w) diffuse, F the Fresnel
// reflectance of `index`, or 1 for a bare mirror without index. L_mirror is what the facets of a
// rough mirror show, F that of the mean surface.
struct Specular {
  double weight = 0;                 // 0..1
  std::optional<double> index = {};  // of refraction, > 1; nullopt: F = 1
  Roughness roughness = {};
};

struct NaturalMaterial {
  double diffuse_weight = 1;         // k_d > 0
  std::optional<Specular> specular;  // nullopt: purely diffuse
  std::optional<Bumps> bumps = {};   // of what it mirrors; nullopt: flat
  // Of what it does not mirror, the share that comes from behind: windows, water to the ground.
  // What falls on it does not change that. 0..1
  double transmission = 0;
};

// Of an entry of materials.json: specular (none, fresnel, mirror), specular_weight, ior, roughness
// (0..1), distribution (ggx, the default, or beckmann). nullopt: purely diffuse. Throws InputError.
// `may_be_metal`: conductor is taken, too, as a bare mirror whose colour the caller knows.
std::optional<Specular> ReadSpecular(const MaterialKeys& material, bool may_be_metal = false);

// The same in the environment descriptions, which hold what was read.
Json::Value SpecularJson(const Specular& specular);
Specular SpecularOf(const JsonNode& node);

// One entry of survey/materials.json: what of a photographed surface the photograph does not tell;
// `transmission` of a window. Throws InputError: weights out of range, of bare metal, bumps of what
// mirrors nothing.
NaturalMaterial ReadNaturalMaterial(const MaterialKeys& material);

// By name; with use NAME the keys of a library's entry lie below. A site without the file has no
// entries: every material is then purely diffuse. Throws InputError (weights out of range).
std::map<std::string, NaturalMaterial> ReadNaturalMaterials(const SitePaths& site);

}  // namespace insitu
