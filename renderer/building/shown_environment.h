// SPDX-License-Identifier: GPL-3.0-or-later
// What of an artificial environment is drawn, and how: facets where spheres are asked for by
// places, places on textures, what is not shown.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "renderer/building/artificial_environment.h"

namespace insitu {

// The same with facets in the place of the spheres, behind its triangles, SphereFacetCount(level)
// each, for what asks for places on them or draws them small. Their UVs are alike: no texture.
constexpr int kDrawnSphereLevel = 4;  // of pictures of a few hundred pixels
ArtificialEnvironment Faceted(ArtificialEnvironment environment, int level);

// Of the three corners of a triangle, in repeats of the image, v up: projected in metres where its
// material states texture_size, on walls along and up the wall, on what lies flatter than 45
// degrees along x and y; else the model's. nullopt: neither, as where all three of the model's are
// alike.
std::optional<std::array<Eigen::Vector2d, 3>> TextureCoordinates(
    const ArtificialEnvironment& environment, int triangle);

// What the description holds and this version's renderer does not show, a line each: bumps of
// glass, textures of spheres and of faces without a place on them, lamps of unknown strength.
std::vector<std::string> NotShown(const ArtificialEnvironment& environment);

}  // namespace insitu
