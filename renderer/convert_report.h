// SPDX-License-Identifier: GPL-3.0-or-later
// What a conversion did, for programs and for people.
#pragma once

#include <filesystem>

#include "renderer/convert.h"

namespace insitu {

// JSON with triangles, bbox_min and bbox_max [m], layers and materials (name -> triangles),
// entities (kind -> count), skipped (kind, count, reason), files (each with its format, unit, own
// box and placement), solids, unlisted materials and warnings.
void WriteConvertReport(const std::filesystem::path& path, const Conversion& conversion);

// `stem`.png, the building in a three-quarter view, and `stem`.html, a page with that picture and
// what the report holds.
void WritePreview(const std::filesystem::path& stem, const Conversion& conversion);

}  // namespace insitu
