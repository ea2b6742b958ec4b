// SPDX-License-Identifier: GPL-3.0-or-later
// The drawing unit, group 70 of $INSUNITS in the header of a DXF drawing.
#pragma once

#include <optional>

namespace insitu {

// Metres per drawing unit; nullopt: a number that stands for no unit (0, unitless, is none either).
std::optional<double> MetresPerDxfUnit(int insunits);

}  // namespace insitu
