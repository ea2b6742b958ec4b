// SPDX-License-Identifier: GPL-3.0-or-later
// COLLADA 1.4 and 1.5. Read by ourselves: Assimp keeps node transforms in single precision, and
// refuses polygons with holes.
#pragma once

#include <filesystem>

#include "renderer/mesh/model.h"

namespace insitu {

// Node names become layers; materials keep their names, colours and images. Vertices in metres by
// the file's unit, z up by its up_axis. Without a scene all nodes are shown, without nodes all
// geometries. Throws InputError at its line: no XML, what ReadColladaGeometry states, a reference
// to nothing, nodes within nodes more than 1000 deep.
Model ReadCollada(const std::filesystem::path& path);

}  // namespace insitu
