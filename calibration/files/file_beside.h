// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "calibration/files/json_file.h"

namespace insitu {

// The file that a JSON text names, relative to the JSON's own folder. Throws InputError at its
// line: not there.
std::filesystem::path FileBeside(const JsonNode& node);

}  // namespace insitu
