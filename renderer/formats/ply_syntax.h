// SPDX-License-Identifier: GPL-3.0-or-later
// PLY, looked at before and after a library reads it: Assimp searches for ever for the end of a
// head that has none, and makes up the elements that are missing.
#pragma once

#include <cstdint>
#include <filesystem>

namespace insitu {

// Throws InputError: a head without end_header, a text of fewer elements than its head states.
void CheckPly(const std::filesystem::path& path);

// Throws InputError: the head states more faces than were read.
void RequirePlyFaces(const std::filesystem::path& path, int64_t faces);

}  // namespace insitu
