// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "reconstruction/exchange/import_project.h"

namespace insitu {

// A script of DBAT (Damped Bundle Adjustment Toolbox) with the tables it names; lens model 3, or 1
// and 2 without affinity. Photos are placed by the script's prior orientations, else by resection;
// points by intersection. Control without sigma is fixed. Throws InputError: a fault in a file,
// what we cannot do (other lens models), a photo that cannot be placed.
ImportedProject ReadDbatProject(const std::filesystem::path& script);

}  // namespace insitu
