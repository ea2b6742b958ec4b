// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/diagnosis/diagnosis.h"

namespace insitu {

std::string Text(const Diagnosis& diagnosis) {
  return diagnosis.place.path.filename().string() + ":" + std::to_string(diagnosis.place.line) +
         ": " + diagnosis.message;
}

}  // namespace insitu
