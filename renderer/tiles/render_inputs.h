// SPDX-License-Identifier: GPL-3.0-or-later
// What the pixels of a montage depend on, as a hash: a render that was stopped goes on only where
// all of it is the same.
#pragma once

#include <filesystem>
#include <string>

#include "radiometry/natural_environment.h"
#include "renderer/building/artificial_environment.h"

namespace insitu {

// Of all photographs of a site: descriptions, input images, textures and this program itself.
// `building`: empty without one.
std::string SiteInputsSha256(const SitePaths& site, const NaturalEnvironment& natural,
                             const ArtificialEnvironment& building);

// The same with a photograph and what stands in front of it.
std::string PhotographInputsSha256(const SitePaths& site, const std::string& site_inputs,
                                   const std::filesystem::path& photograph);

}  // namespace insitu
