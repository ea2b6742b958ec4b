// SPDX-License-Identifier: GPL-3.0-or-later
// The material library, as the measuring page offers it.
#pragma once

#include <json/value.h>

#include "calibration/program/site.h"

namespace insitu {

// {materials: [{name, group, title, title_de, rgb, mirrors, has_table}]}, by group and name:
// entries that survey/materials.json may use. Titles may be missing. rgb: the albedo, linear Rec.
// 709; has_table: by wavelength, so that daylight samples may be of it. {error}: the library is at
// fault.
Json::Value LibraryAnswer(const SitePaths& site);

}  // namespace insitu
