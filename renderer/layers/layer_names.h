// SPDX-License-Identifier: GPL-3.0-or-later
// The layers of a montage by name.
#pragma once

#include <string>
#include <vector>

namespace insitu {

inline constexpr char kMontageLayer[] = "montage";
// What is left of the sum.
inline constexpr char kRestLayer[] = "rest", kRestFineLayer[] = "rest_fine";

// Those that are added up but for what is left: first the photograph, then the light as LightPart
// has it, then grain.
const std::vector<std::string>& SummedLayers();

// Names of the parts that `--layers` may choose, in the order of the file: first "montage", then
// those that are added up, from "photo" to "rest_fine", then the others.
const std::vector<std::string>& LayerNames();

// "all", or names with commas between them, in that order; with any that is added up, what is left
// of the sum, "rest" and "rest_fine". Throws InputError naming those there are.
std::vector<std::string> ChosenLayers(const std::string& text);

// Of `chosen`, those that are added up, in words.
std::string SumText(const std::vector<std::string>& chosen);

}  // namespace insitu
