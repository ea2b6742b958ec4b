// SPDX-License-Identifier: GPL-3.0-or-later
// STL, binary and text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "renderer/mesh/model.h"

namespace insitu {

// Length of a binary STL file as its head states; nullopt: too short for one.
std::optional<uint64_t> BinaryStlSize(const std::filesystem::path& path);

// Facets in text (any case, with or without endsolid) or binary, with whatever follows them. The
// stated normals are not used, as they may be nonsense: a facet's corners say which way it looks.
// Throws InputError at its line: a corner that is no point, a facet of other than three corners, a
// facet that is not closed, a binary file that is shorter than it states.
Model ReadStl(const std::filesystem::path& path);

}  // namespace insitu
