// SPDX-License-Identifier: GPL-3.0-or-later
// The CIE tables of radiometry/data, embedded at configure time so that programs need no path.
#pragma once

namespace insitu {

// Comma-separated, one header line, wavelengths [nm] in the first column, 380 to 780 in steps of 5.
extern const char* const kCie1931Csv;  // x, y, z of the standard observer
extern const char* const kCieD65Csv;   // relative power, 100 at 560 nm

}  // namespace insitu
