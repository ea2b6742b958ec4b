// SPDX-License-Identifier: GPL-3.0-or-later
// The coordinates of imported files in one system of metres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reconstruction/exchange/survey_file.h"

namespace insitu {

// Puts x first where a file follows its system's axes, and converts every position to `target`, or
// where the files are in degrees and there is no target to the UTM zone of their first point.
// Heights stay. Without any system coordinates are taken as metres. Returns what was done, in
// words. Throws InputError: systems mixed, named and unnamed mixed, unknown, not in metres, or a
// local one that is to be converted; degrees without a system; a place PROJ cannot convert.
std::vector<std::string> ConvertToOneSystem(const std::optional<std::string>& file_crs,
                                            const std::optional<std::string>& target,
                                            std::vector<SurveyFile>* files);

}  // namespace insitu
