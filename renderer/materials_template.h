// SPDX-License-Identifier: GPL-3.0-or-later
// A materials.json to begin with.
#pragma once

#include <string>

#include "renderer/convert.h"

namespace insitu {

// With an entry for every layer, block and material name of the models. Throws InputError: no
// model, what the readers of the files state.
std::string MaterialsTemplate(const SitePaths& site, const ConvertOptions& options = {});

}  // namespace insitu
