// SPDX-License-Identifier: GPL-3.0-or-later
// DBAT's cameras, and the one place where its pixels and principal points become ours and back.
//
// DBAT measures image points in pixels from the top-left *corner* of the picture, x right, y down:
// the centre of the top-left pixel is at (0.5, 0.5). (Its marks of the camera calibration data lie
// 0.49 and 0.56 +- 0.01 px right of and below the dots' centroids in our pixels.) Its principal
// point is in mm from the same corner, y down; ours is y up. Hence origin_px = (-0.5, -0.5) and
// yp = -pp_y. The two conventions cancel in every residual.
//
// Its <sensor> is width,height in mm, so that pixels need not be square; "auto,height" means that
// they are. The width of a camera that DBAT adjusted is written as its own aspect has stretched it,
// by 2 - <aspect>; the stretch is taken out again.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "calibration/files/xml_file.h"
#include "calibration/lens/metric_camera.h"

namespace insitu {

constexpr double kDbatFirstPixelCenter = 0.5;

struct DbatCamera {
  std::string id = "1", name;
  int width = 0, height = 0;        // [px]
  Eigen::Vector2d sensor_mm{0, 0};  // as it was before `aspect` stretched its width
  double focal_mm = 0;              // nominal
  double cc_mm = 0;                 // camera constant
  Eigen::Vector2d pp_mm{0, 0};      // principal point from the top-left corner, y down
  double aspect = 1, skew = 0;      // 1 - aspect is MetricCamera's aspect
  std::array<double, 3> K{};        // [mm^-2, mm^-4, mm^-6]
  std::array<double, 2> P{};        // [mm^-1]
  int K_count = 3, P_count = 2;     // how many there are to estimate
  int model = 3;

  Eigen::Vector2d pixel_mm() const {
    return sensor_mm.cwiseQuotient(Eigen::Vector2d(width, height));
  }
};

// A <camera> element, in a script or in a camera file. What it does not state has DBAT's default:
// cc the focal length, pp the middle of the sensor, no distortion. Throws InputError: a missing or
// senseless size, neither <focal> nor <cc>, a unit other than mm, a lens model that is no
// kBackwardBrown (4, 5, -1). As a camera file: ReadDbatCamera of camera_file_formats.h.
DbatCamera ParseDbatCamera(const XmlNode& camera);

// The camera's default values of cc, pp, K, P, aspect and skew.
DbatCamera WithDefaults(DbatCamera camera);

MetricCamera MetricFromDbat(const DbatCamera& camera);
DbatCamera DbatFromMetric(const MetricCamera& camera);  // of kBackwardBrown; focal = cc

}  // namespace insitu
