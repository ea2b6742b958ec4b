// SPDX-License-Identifier: GPL-3.0-or-later
// What a user must know of a model as it was read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/building/placement.h"
#include "renderer/mesh/model.h"

namespace insitu {

// Unit and vertical axis that its format does not name, what was left out and why, and the
// warnings of its reader; a line each, with the file's name. `model` is not yet placed.
std::vector<std::string> NotesOnModel(const std::filesystem::path& file, const Model& model,
                                      const Placement& placement);

}  // namespace insitu
