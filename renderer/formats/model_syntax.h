// SPDX-License-Identifier: GPL-3.0-or-later
// Faults of the files that Assimp reads: it passes over some in silence and tells the line of none.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "renderer/formats/model_file.h"
#include "renderer/mesh/model.h"

namespace insitu {

// Length of a binary STL file as its head states; nullopt: too short for one.
std::optional<uint64_t> BinaryStlSize(const std::filesystem::path& path);

// Before Assimp reads. Throws InputError, at its line if it has lines: an IFC file of another
// schema, cut short or with a statement that is none; STL without its end; PLY without the end of
// its head; GLB of another length than it states.
void CheckModelSyntax(const std::filesystem::path& path, ModelFormat format);

// After Assimp has read: throws InputError if a PLY file states more faces than were found.
void CheckModelWhole(const std::filesystem::path& path, ModelFormat format, const Model& model);

// After Assimp has failed: throws InputError at the line if glTF is no JSON or COLLADA no XML.
void ExplainFailure(const std::filesystem::path& path, ModelFormat format);

}  // namespace insitu
