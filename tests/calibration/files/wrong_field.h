// SPDX-License-Identifier: GPL-3.0-or-later
// What Check() of an options struct says.
#pragma once

#include <string>

#include "calibration/files/error.h"

namespace insitu {

// The condition that does not hold; empty: nothing is wrong.
template <typename Options>
std::string WrongField(const Options& options) {
  try {
    options.Check();
  } catch (const CheckError& error) {
    return error.what();
  }
  return "";
}

}  // namespace insitu
