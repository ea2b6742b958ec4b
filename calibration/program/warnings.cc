// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/program/warnings.h"

#include <algorithm>

namespace insitu {

std::string WarningLines(const std::vector<std::string>& warnings) {
  std::string lines;
  for (std::string text : warnings) {
    std::ranges::replace(text, '\n', ' ');
    lines += "warning: " + text + "\n";
  }
  return lines;
}

}  // namespace insitu
