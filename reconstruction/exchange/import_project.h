// SPDX-License-Identifier: GPL-3.0-or-later
// Whole projects of other adjustment programs as a Network with start values, so that our solution
// can be held against theirs.
#pragma once

#include <Eigen/Core>
#include <filesystem>
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

struct AiconOptions {
  double mark_sigma_mm = 0.0005;  // of every image coordinate, a priori
};

// AICON 3D Studio: the files NAME.obc, .phc, .eor, .ior and .scale (may be missing), all in mm,
// from a folder that holds one such set, or any file of it. Adjusted are c xh yh A1 A2 B1 B2; A3 C1
// C2 stay. Left out, and remarked: marks that are flagged, or whose point has no coordinates.
// Throws InputError.
ImportedProject ReadAiconProject(const std::filesystem::path& path,
                                 const AiconOptions& options = {});

// A script of DBAT (Damped Bundle Adjustment Toolbox) with the tables it names; lens model 3, or 1
// and 2 without affinity. Photos are placed by the script's prior orientations, else by resection;
// points by intersection. Control without sigma is fixed. Throws InputError: a fault in a file,
// what we cannot do (other lens models), a photo that cannot be placed.
ImportedProject ReadDbatProject(const std::filesystem::path& script);

}  // namespace insitu
