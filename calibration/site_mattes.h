// SPDX-License-Identifier: GPL-3.0-or-later
// MATTE: what stands in front of the building, from rough drawings of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

struct MadeMatte {
  std::filesystem::path file;  // survey/foreground/<photo>.png
  double open = 0;             // share of the picture's pixels that were to be found
  double fraction = 0;         // share of them that lies in part in front
};

// Of each photograph with a drawing in survey/trimaps/, or of those named: shares of 16 bits.
// Throws InputError: no such drawing, a matte that is there already unless `replace`, a drawing
// that leaves nothing to be found, or of another size or kind.
std::vector<MadeMatte> MakeMattes(const SitePaths& site, const std::vector<std::string>& photos,
                                  bool replace);

}  // namespace insitu
