// SPDX-License-Identifier: GPL-3.0-or-later
// A script of DBAT with the tables it names, as stated: ids, DBAT's pixels and principal points.
// [Börlin, Murtiyoso, Grussenmeyer: Implementing functional modularity in processing, ISPRS 2019]
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "calibration/camera_files/dbat_camera.h"
#include "calibration/files/error.h"
#include "reconstruction/exchange/dbat_tables.h"

namespace insitu {

struct DbatImage {
  std::string id, photo, camera;  // photo: the file's name without ending; camera: an id or empty
  FilePlace place;
};

struct DbatOrientation {
  std::string image;
  Eigen::Vector3d center;           // [unit of the project]
  Eigen::Vector3d omega_phi_kappa;  // [rad]
  FilePlace place;
};

struct DbatScript {
  double metres_per_unit = 1;
  std::vector<DbatCamera> cameras;  // with the initial values that the operations ask for
  std::vector<DbatImage> images;
  std::vector<DbatControlPoint> control, check;
  std::vector<DbatMark> marks;  // all with sigma
  std::vector<DbatOrientation> prior_orientations;
  bool start_from_prior_orientations = false;
  int min_rays = 0;                // points with fewer are left out
  std::vector<bool> is_estimated;  // by parameter of kBackwardBrown; all false: camera fixed
};

// Throws InputError at the offending line of the script or of a table.
DbatScript ReadDbatScript(const std::filesystem::path& path);

}  // namespace insitu
