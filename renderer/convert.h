// SPDX-License-Identifier: GPL-3.0-or-later
// CONVERT: the architect's model and its materials become the artificial environment. [Durisch92,
// §5]
#pragma once

#include <string>
#include <vector>

#include "renderer/artificial_environment.h"
#include "renderer/dxf.h"

namespace insitu {

struct Conversion {
  ArtificialEnvironment environment;
  std::vector<std::string> warnings;  // entities skipped, layers without a material, ...
  std::string BriefReport() const;    // triangles, bounding box, layers, warnings
};

// Reads building/*.dxf, building/materials.json and, if there, building/lights.json.
// A layer that materials.json does not list becomes a visible mid grey, with a warning.
// Throws InputError: no drawing, no surface in it, unreadable materials, albedo outside 0..1, a
// mirroring material with roughness > 0 (which this version cannot show), a light of negative
// intensity.
Conversion ConvertBuilding(const SitePaths& site);

}  // namespace insitu
