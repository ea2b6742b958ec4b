// SPDX-License-Identifier: GPL-3.0-or-later
// truth/: what the site's files were made from, to compare results with.
#pragma once

#include <filesystem>

#include "datasets_synthetic/field_survey.h"
#include "datasets_synthetic/forward_model.h"

namespace insitu::demo {

// before_<photo>.exr, after_<photo>.exr and mask_<photo>.png (0 untouched, 170 other light on what
// stood before, 255 building) of one view.
void WriteTruthImages(const std::filesystem::path& folder, const View& view,
                      const RenderedView& rendering);

// truth.json: directions, poses, lens, air, light and all points, survey coordinates [m].
void WriteTruth(const std::filesystem::path& path, const Site& site, const FieldSurvey& survey,
                const Daylight& daylight);

}  // namespace insitu::demo
