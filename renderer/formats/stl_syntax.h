// SPDX-License-Identifier: GPL-3.0-or-later
// STL, looked at before a library reads it: Assimp passes over a missing end in silence.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace insitu {

// Length of a binary STL file as its head states; nullopt: too short for one.
std::optional<uint64_t> BinaryStlSize(const std::filesystem::path& path);

// Throws InputError: a text without endsolid, a binary file of another length than it states.
void CheckStl(const std::filesystem::path& path);

}  // namespace insitu
