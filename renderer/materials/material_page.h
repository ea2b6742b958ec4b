// SPDX-License-Identifier: GPL-3.0-or-later
// The material library for people: a list, and a page with swatches.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "radiometry/library/material_library.h"
#include "radiometry/natural_environment.h"

namespace insitu {

// A line an entry: name, kind, title, folder.
std::string MaterialList(const MaterialLibrary& library);

// `stem`.html and the picture that it shows, `stem`.png: each material on a sphere and a wall under
// D65 and, with a site's light, under its sun and sky; each lamp's colour. Throws InputError: an
// entry at fault.
void WriteMaterialPage(const std::filesystem::path& stem, const MaterialLibrary& library,
                       const std::optional<NaturalEnvironment>& site);

}  // namespace insitu
