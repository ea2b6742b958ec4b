// SPDX-License-Identifier: GPL-3.0-or-later
// What the fiducial marks of a scan say of each other, and what was mixed up if they do not agree.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/camera_files/film.h"
#include "calibration/files/sentence.h"

namespace insitu {

struct FiducialReview {
  std::string mark;
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();  // mapped - measured, of the bitmap
  Eigen::Vector2d residual_mm = Eigen::Vector2d::Zero();  // the same on the film, y up
  double redundancy = 0;                                  // of its less checked coordinate, 0..1
  std::optional<double> w = {};  // largest residual in its own sigma; nullopt: cannot be checked
  std::optional<double> off_px = {};  // from where the others put it; nullopt: they cannot
};

struct ScanReview {
  int needed = 3;                      // marks without which there is no map
  std::optional<FilmMap> map;          // nullopt: fewer, or on one line
  int redundancy = 0;                  // coordinates more than the map's elements
  double px_per_mm = 0, turn_deg = 0;  // how the scan lay; counter-clockwise on the screen
  std::vector<FiducialReview> marks;   // worst first
  std::map<std::string, Eigen::Vector2d> predicted;  // [px], of certified marks not placed here
  bool is_usable = false;            // no mistake is found, and insitu-calibrate takes it
  std::vector<Sentence> suspicions;  // with what to do, for people
};

// The sigma [px] of a coordinate that w refers to, times a dubious mark's: a careful hand on a
// scan.
inline constexpr double kFiducialSigma_px = 0.5;

// `certified` are the camera's marks [mm], `size` the bitmap's [px]. From two marks on places of
// others are predicted.
ScanReview ReviewScan(const std::vector<Fiducial>& marks,
                      const std::map<std::string, Eigen::Vector2d>& certified,
                      FilmTransformation transformation, const Eigen::Vector2i& size);

}  // namespace insitu
