// SPDX-License-Identifier: GPL-3.0-or-later
// Where on its texture a face of the building is.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "renderer/building/artificial_environment.h"

namespace insitu {

// Of the three corners of a triangle, in repeats of the image, v up: projected in metres where its
// material states texture_size, on walls along and up the wall, on what lies flatter than 45
// degrees along x and y; else the model's. nullopt: neither, as where all three of the model's are
// alike.
std::optional<std::array<Eigen::Vector2d, 3>> TextureCoordinates(
    const ArtificialEnvironment& environment, int triangle);

}  // namespace insitu
