// SPDX-License-Identifier: GPL-3.0-or-later
// Files that a model names: materials, images, buffers, as written on another machine.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace insitu {

// The file that `name` in the file `model` means: relative to it, in quotes, with backslashes, a
// drive, a server, "file:", "%20" or a "?query", in another case; else the file of that name beside
// the model, with as many of its folders as are there. nullopt: none.
std::optional<std::filesystem::path> FindReference(const std::filesystem::path& model,
                                                   const std::string& name);

}  // namespace insitu
