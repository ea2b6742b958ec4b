// SPDX-License-Identifier: GPL-3.0-or-later
// The head and the statements of an IFC file (ISO 10303-21), looked at before a library reads it.
#pragma once

#include <filesystem>

namespace insitu {

// Throws InputError at the line: a schema other than IFC2X3, IFC4 and its successors, no
// FILE_SCHEMA.
void CheckIfcSchema(const std::filesystem::path& path);

// Throws InputError at its line: a statement of a DATA section that is no "#12=IFCWALL(...)".
// A reader passes over such statements in silence, or breaks.
void CheckIfcStatements(const std::filesystem::path& path);

}  // namespace insitu
