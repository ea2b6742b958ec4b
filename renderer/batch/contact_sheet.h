// SPDX-License-Identifier: GPL-3.0-or-later
// The page at the end of a batch: every picture small, with its time, or why it is not there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/batch/batch_jobs.h"

namespace insitu {

struct SheetEntry {
  BatchJob job;
  bool is_done = false;  // its results hold
  double seconds = 0;
  std::vector<std::string> warnings = {};
  std::string fault = {};       // why it is not done, as it told when it last ran; may be empty
  std::string simulation = {};  // what the picture states; empty: the photograph's light
};

// One HTML file without scripts and outside references but links to the pictures beside it, so that
// it can be read from its folder alone. Pictures that cannot be read are only named.
std::string ContactSheet(const BatchPlan& plan, const std::vector<SheetEntry>& entries);

}  // namespace insitu
