// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of glass through which light would find no way.
#pragma once

#include <string>
#include <vector>

#include "renderer/building/artificial_environment.h"
#include "renderer/mesh/model.h"

namespace insitu {

// The names of materials of solid glass whose faces leave a body open: light is bent where it
// enters one and where it leaves it. `environment` has the material of each triangle of `mesh`.
std::vector<std::string> OpenGlassBodies(const ModelMesh& mesh,
                                         const ArtificialEnvironment& environment);

}  // namespace insitu
