// SPDX-License-Identifier: GPL-3.0-or-later
// Input images of photographs of any size: Reproject a band of rows at a time. [Durisch92, §4.1]
#pragma once

#include <filesystem>

#include "calibration/lens/camera.h"
#include "calibration/photo/photograph.h"

namespace insitu {

// Writes the EXR that WriteExr would write of Reproject, with the same values, in the memory of the
// photograph's codes and of some hundred rows. Throws std::runtime_error: cannot be written.
void WriteReprojected(const std::filesystem::path& exr, const CodedPhotograph& photo,
                      const Camera& source, const Camera& target);

}  // namespace insitu
