// SPDX-License-Identifier: GPL-3.0-or-later
// Surveys and marks as other programs write them, each file as it stands: its format is recognised
// by content, its pixels become ours, its coordinates stay in its own reference system.
//
// Where a pixel counts from, by format:
//   ours              the centre of the top-left pixel is (0, 0)
//   OpenSfM, ODM      the same ("origin at the center of the top-left pixel", doc/geometry.rst);
//                     in JSON from the middle of the picture, over its larger side
//   MicMac            the same: its images have their pixels' values at whole coordinates
//   Metashape         (0.5, 0.5) (its manual, "Camera models")
//   Pix4D             from the upper left corner (help 360035474951): (0.5, 0.5)
//   DBAT              (0.5, 0.5), see dbat_camera.h
//   AICON             mm from the middle of the picture, y up
//   tables with header  not stated: taken as ours, which the report says
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reconstruction/survey/survey.h"

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
  std::vector<SurveyedPoint> points;
  std::vector<SurveyedPoint> centers;  // camera positions
  std::vector<SurveyedMark> marks;
  std::vector<std::string> remarks;  // what was left out or assumed
};

// The size of a photo [px], which some formats divide by. nullopt: there is no such photo.
using PhotoSize = std::function<std::optional<Eigen::Vector2i>(const std::string& photo)>;

// Throws InputError at the offending line: unreadable, of no known format, cut short, senseless.
SurveyFile ReadSurveyFile(const std::filesystem::path& path, const PhotoSize& photo_size);

}  // namespace insitu
