// SPDX-License-Identifier: GPL-3.0-or-later
// Luminaire files of ANSI/IES LM-63 (1986 to 2019).
#pragma once

#include <filesystem>
#include <vector>

namespace insitu {

// Photometry of type C: gamma from the nadir, C about it.
struct IesPhotometry {
  std::vector<double> gamma_deg, c_deg;  // rising
  std::vector<double> candela;           // all gammas of the first C, then of the next; >= 0
};

// Candela as the file means them, multiplier and ballast factor applied; TILT is skipped.
// Throws InputError at the line: no LM-63 file, photometry of type A or B, too few or too many
// values, angles that do not rise, a negative candela.
IesPhotometry ReadIes(const std::filesystem::path& path);

}  // namespace insitu
