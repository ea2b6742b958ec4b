// SPDX-License-Identifier: GPL-3.0-or-later
// How natural materials reflect beyond what their photograph tells: survey/materials.json.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "calibration/program/site.h"

namespace insitu {

// A mirroring share over a diffuse ground: L = F w L_mirror + (1 - F w) diffuse, F the Fresnel
// reflectance of `index`, or 1 for a bare mirror without index.
struct Specular {
  double weight = 0;            // 0..1
  std::optional<double> index;  // of refraction, > 1; nullopt: F = 1
};

struct NaturalMaterial {
  double diffuse_weight = 1;         // k_d > 0
  std::optional<Specular> specular;  // nullopt: purely diffuse
};

// F w at an angle of incidence; 0 without a specular share.
double MirrorWeight(const std::optional<Specular>& specular, double cosine);

// By name. A site without the file has no entries: every material is then purely diffuse.
// Throws InputError (weights out of range, roughness > 0, which this version cannot show).
std::map<std::string, NaturalMaterial> ReadNaturalMaterials(const SitePaths& site);

}  // namespace insitu
