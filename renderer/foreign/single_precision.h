// SPDX-License-Identifier: GPL-3.0-or-later
// What is lost before we read it.
#pragma once

#include <filesystem>
#include <string>

namespace insitu {

// A warning of coordinates that a file stores in single precision, the largest of them `largest`
// [m]; empty: they are good to a millimetre.
std::string SinglePrecisionNote(const std::filesystem::path& file, double largest);

}  // namespace insitu
