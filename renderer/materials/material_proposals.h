// SPDX-License-Identifier: GPL-3.0-or-later
// Which entries of the material library the names of a model may mean.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiometry/library/material_library.h"
#include "renderer/formats/model_file.h"

namespace insitu {

// Materials that a name may mean, the likeliest first: those of which it holds the longest words
// (their `words`, and the parts of their names), case and accents of Western languages aside; words
// of fewer than four letters must stand alone. At most three; empty: none.
std::vector<std::string> ProposalsFor(const std::string& name, const MaterialLibrary& library);

// A materials.json of every layer, block and material name of the models, with the model's own
// colour, "proposed": the likeliest entry, and "or": others. Nothing of it is taken by CONVERT
// before a person writes "use". Throws InputError: as ReadModel.
std::string ProposedMaterials(const std::vector<std::filesystem::path>& models,
                              const MaterialLibrary& library, const ImportOptions& options = {});

}  // namespace insitu
