// SPDX-License-Identifier: GPL-3.0-or-later
// Results are written whole or not at all: into a temporary file beside the target, then renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace insitu {

// Calls `write` with the temporary path (same ending as `target`) and renames on return; on an
// exception the temporary file is removed and the target stays as it was. Makes missing folders.
void WriteWhole(const std::filesystem::path& target,
                const std::function<void(const std::filesystem::path& temporary)>& write);
void WriteWhole(const std::filesystem::path& target, const std::string& content);

// Removes what a killed WriteWhole left below a folder, the temporary files of processes that run
// no more; returns their paths. Links to folders are not followed.
std::vector<std::filesystem::path> RemoveLeftovers(const std::filesystem::path& folder);

// The whole content of a file. Throws InputError if it cannot be read.
std::string ReadWhole(const std::filesystem::path& path);

}  // namespace insitu
