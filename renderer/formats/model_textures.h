// SPDX-License-Identifier: GPL-3.0-or-later
// Where the images of a model's surfaces are.
#pragma once

#include <filesystem>

#include "calibration/program/site.h"
#include "renderer/mesh/model.h"

namespace insitu {

// Makes the surfaces' textures paths of files: beside the model those that it names; those that it
// holds are written into work/building_textures/. One that is not there or of a kind that is not
// read is left out with a warning of the model.
void LocateTextures(const SitePaths& site, const std::filesystem::path& file, Model* model);

}  // namespace insitu
