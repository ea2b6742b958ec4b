// SPDX-License-Identifier: GPL-3.0-or-later
// What is missing for a montage, and why, in the order in which a person would do it.
#pragma once

#include <json/value.h>

#include <vector>

#include "calibration/files/sentence.h"
#include "calibration/program/site.h"

namespace insitu {

struct ToDoInput {
  SitePaths site;
  Json::Value tables;                 // as SiteEdit has them
  Json::Value adjusted, light, film;  // messages, maybe null
  std::vector<Sentence> file_faults;  // files that take no part
};

// [{text, why, where: {photo, point, table, mode}, run}], of `where` and `run` what applies.
Json::Value ToDo(const ToDoInput& input);

}  // namespace insitu
