// SPDX-License-Identifier: GPL-3.0-or-later
// IFC 2x3, 4 and 4x3, by web-ifc under Node.js: of the readers tried it alone agrees with
// OpenCASCADE on units, openings, half-spaces and boolean results.
#pragma once

#include <filesystem>
#include <optional>

#include "renderer/mesh/model.h"

namespace insitu {

// The folder of web-ifc: INSITU_WEB_IFC of the environment, else share/insitu/web-ifc beside the
// installed programs or web-ifc in the build folder. nullopt: not there.
std::optional<std::filesystem::path> WebIfcFolder();

// Layers are "IfcWall_Name", materials are named by style, else as the element's. web-ifc runs as a
// program of its own within `seconds` of CPU time and 4 GB.
// Throws InputError: web-ifc or Node.js is missing, what web-ifc says of the file, a file that
// breaks it or exceeds its limits, another schema, a file that was cut, a statement that is none.
Model ReadIfc(const std::filesystem::path& path, int seconds);

}  // namespace insitu
