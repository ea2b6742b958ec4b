// SPDX-License-Identifier: GPL-3.0-or-later
// The head and foot of an IFC file, looked at before a library reads it.
#pragma once

#include <filesystem>

namespace insitu {

// Throws InputError at the line: a schema other than IFC2X3 (which Assimp does not read), no
// FILE_SCHEMA, a file without its END-ISO-10303-21 (cut short).
void CheckIfcHeader(const std::filesystem::path& path);

}  // namespace insitu
