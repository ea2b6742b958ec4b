// SPDX-License-Identifier: GPL-3.0-or-later
// Whole projects of other adjustment programs as a Network with start values, so that our solution
// can be held against theirs: import_aicon.h, import_dbat.h.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reconstruction/network/network.h"

namespace insitu {

// A surveyed point whose coordinates stay out of the adjustment.
struct ImportedCheckPoint {
  int point = 0;             // index into Network::points
  Eigen::Vector3d position;  // [m], local
  Eigen::Vector3d sigma;     // [m]; 0: not stated
};

struct ImportedProject {
  Network network;
  std::vector<ImportedCheckPoint> check_points;
  std::vector<std::string> remarks;  // what was left out, and why
};

}  // namespace insitu
