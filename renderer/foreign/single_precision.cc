// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/single_precision.h"

#include <limits>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"

namespace insitu {

std::string SinglePrecisionNote(const std::filesystem::path& file, double largest) {
  const double step = largest * std::numeric_limits<float>::epsilon();
  if (step < 1e-3) return "";
  return InputError(file,
                    Formatted("holds coordinates up to %.0f m in single precision, to %.3f m: "
                              "export about a local origin and place it with placement.json",
                              largest, step))
      .what();
}

}  // namespace insitu
