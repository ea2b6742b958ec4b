// SPDX-License-Identifier: GPL-3.0-or-later
// The building on a page, to be turned with the mouse, by three.js.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/building/artificial_environment.h"
#include "renderer/mesh/model.h"

namespace insitu {

// What a page tells of the faces besides their materials.
struct TurntableLayers {
  std::vector<std::string> names;
  std::vector<int> layer_of_triangle;     // index into names, one a triangle of the building
  std::vector<int> layer_of_sphere = {};  // the same, one a sphere
};

TurntableLayers LayersOf(const ModelMesh& mesh);

// The folder of three.js: INSITU_THREE of the environment, else share/insitu/three beside the
// installed programs or three in the build folder. nullopt: not there.
std::optional<std::filesystem::path> ThreeFolder();

// A section of a page with all it needs, three.js too: the building turned, moved and enlarged by
// the mouse, layers switched, the distance between two points clicked, open edges in red, backs of
// faces in magenta. Coordinates are single precision about the box's centre; what is read off is
// exact to 1e-7 of the building's size; spheres are drawn by facets. Empty: there is no three.js,
// or no face.
std::string Turntable(const ArtificialEnvironment& building, const TurntableLayers& layers);

}  // namespace insitu
