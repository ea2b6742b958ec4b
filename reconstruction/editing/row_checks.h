// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a row that somebody wants can be written so that every program reads it.
#pragma once

#include <json/value.h>

#include <optional>
#include <string>
#include <vector>

#include "calibration/files/sentence.h"
#include "reconstruction/editing/edited_tables.h"

namespace insitu {

// What is wrong with a row; nullopt: nothing. `photos` are the names that rows may give.
std::optional<Sentence> FaultOfRow(const EditedTable& table, const Json::Value& row,
                                   const std::vector<std::string>& photos);

}  // namespace insitu
