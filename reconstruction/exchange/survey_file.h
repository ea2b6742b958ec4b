// SPDX-License-Identifier: GPL-3.0-or-later
// Surveys and marks as other programs write them: pixels are ours, coordinates stay in their own
// reference system.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calibration/files/sentence.h"
#include "reconstruction/survey/survey.h"
#include "reconstruction/survey/survey_columns.h"

namespace insitu {

// A surveyed point, or a surveyed centre of projection named by its photo.
struct SurveyedPoint {
  std::string name;
  Eigen::Vector3d position;  // x east [m] or longitude [deg], y north or latitude, z height [m]
  std::optional<Eigen::Vector3d> sigma;  // [m], > 0; nullopt: not stated
  ControlRole role = ControlRole::kControl;
  FilePlace place;
};

struct SurveyedMark {
  std::string photo, point;        // photo: file name without ending
  Eigen::Vector2d pixel;           // ours
  std::optional<double> sigma_px;  // > 0; nullopt: not stated
  FilePlace place;
};

struct SurveyFile {
  std::filesystem::path path;
  std::string format;              // in words
  std::optional<std::string> crs;  // as the file names it
  bool has_axes_of_crs = false;    // x and y stand in the order of the system's definition
  bool has_degrees = false;        // the file says so, even if it names no system
  bool has_units = false;  // the file says so: its coordinates are metres, whatever the system
  std::vector<SurveyedPoint> points;
  std::vector<SurveyedPoint> centers;  // camera positions
  std::vector<SurveyedMark> marks;
  std::vector<Sentence> remarks;  // what was left out or assumed
};

// The size of a photo [px], which some formats divide by. nullopt: there is no such photo.
using PhotoSize = std::function<std::optional<Eigen::Vector2i>(const std::string& photo)>;

}  // namespace insitu
