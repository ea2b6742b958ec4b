// SPDX-License-Identifier: GPL-3.0-or-later
// AICON 3D Studio's cameras, and the one place where its millimetres become our pixels.
//
// An .ior file holds 17 numbers a camera, in five lines: number, -999, ck (negative), xh, yh, A1,
// A2, r0 / A3 / B1, B2 / C1, C2 / the sensor's width and height [mm], its columns and rows. With
// x = ck X / Z they reproduce the image residuals that AICON wrote beside its marks to 1e-5 mm.
//
// Millimetres count from the middle of the sensor, x right, y up, and a pixel measures width over
// columns by height over rows: pixels need not be square, since the file states both sides. (Where
// they are, as in the example of JAICOV, 8688 x 5792 pixels of 4.14 um, each side is rounded to a
// micrometre by itself, and taking the width's pixel for both moves the upper edge by 0.04 px.)
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/lens/metric_camera.h"

namespace insitu {

struct AiconCamera {
  std::string number;
  MetricCamera lens;  // of kBalancedRadial
  FilePlace place;
};

// One or more, their numbers distinct. Throws InputError: unreadable, cut short, no numbers, a
// sensor or frame without size. As a camera file: ReadAiconCamera of camera_file_formats.h.
std::vector<AiconCamera> ReadAiconCameras(const std::filesystem::path& path);

// Our pixel at a position on the sensor [mm from its middle, y up].
Eigen::Vector2d AiconPixel(const MetricCamera& lens, const Eigen::Vector2d& mm);

}  // namespace insitu
