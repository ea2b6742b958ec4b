// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "reconstruction/exchange/import_project.h"

namespace insitu {

struct AiconOptions {
  double mark_sigma_mm = 0.0005;  // of every image coordinate, a priori

  void Check() const;  // throws CheckError that names the field: a sigma that is not above 0
};

// AICON 3D Studio: the files NAME.obc, .phc, .eor, .ior and .scale (may be missing), all in mm,
// from a folder that holds one such set, or any file of it. Adjusted are c xh yh A1 A2 B1 B2; A3 C1
// C2 stay. Left out, and remarked: marks that are flagged, or whose point has no coordinates.
// Throws InputError.
ImportedProject ReadAiconProject(const std::filesystem::path& path,
                                 const AiconOptions& options = {});

}  // namespace insitu
