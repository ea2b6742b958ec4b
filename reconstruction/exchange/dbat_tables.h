// SPDX-License-Identifier: GPL-3.0-or-later
// The tables that a script of DBAT names, as stated: ids, DBAT's pixels.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/files/error.h"

namespace insitu {

// A table whose columns a format string names: "id,label,x,y,z,sx,sy,sz".
struct DbatTable {
  struct Row {
    FilePlace place;
    std::map<std::string, std::string> cells;  // by column

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

}  // namespace insitu
