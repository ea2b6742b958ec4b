// SPDX-License-Identifier: GPL-3.0-or-later
// A script of DBAT and the tables it names, as stated: ids, DBAT's pixels and principal points.
// [Börlin, Murtiyoso, Grussenmeyer: Implementing functional modularity in processing, ISPRS 2019]
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/camera_files/dbat_camera.h"
#include "calibration/files/error.h"

namespace insitu {

// A table whose columns a format string names: "id,label,x,y,z,sx,sy,sz".
struct DbatTable {
  struct Row {
    FilePlace place;
    std::map<std::string, std::string> cells;  // by column

    InputError Error(const std::string& message) const;
    const std::string& Text(const std::string& column) const;
    double Number(const std::string& column) const;
    std::optional<double> Find(const std::string& column) const;  // nullopt: no such column
  };
  std::vector<Row> rows;
};

// Throws InputError: a row with another number of cells than the format has.
DbatTable ReadDbatTable(const std::filesystem::path& path, const std::string& format);

struct DbatControlPoint {
  std::string id, label;
  Eigen::Vector3d position, sigma;  // [unit of the project]; sigma 0: fixed
  FilePlace place;
};
// Columns id, x, y, z; optional label, sx, sy, sz, sxy, sxyz.
std::vector<DbatControlPoint> ReadDbatControl(const std::filesystem::path& path,
                                              const std::string& format);

struct DbatMark {
  std::string image, point;
  Eigen::Vector2d pixel;           // DBAT's, see dbat_camera.h
  std::optional<double> sigma_px;  // nullopt: the table has no column for it
  FilePlace place;
};
// Columns im, id, x, y; optional sxy.
std::vector<DbatMark> ReadDbatMarks(const std::filesystem::path& path, const std::string& format);

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
