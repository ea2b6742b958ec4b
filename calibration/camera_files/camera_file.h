// SPDX-License-Identifier: GPL-3.0-or-later
// What a camera file of another program holds, as a camera of mrcal. What mrcal has no equal for is
// fitted, and the deviation stated.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "calibration/lens/camera.h"
#include "calibration/lens/metric_camera.h"

namespace insitu {

struct CameraFile {
  Camera camera;
  std::string format;                  // e.g. "OpenCV YAML", for reports
  double largest_deviation_px = 0;     // |ours - the file's| over the frame; 0: the same lens
  std::optional<MetricCamera> metric;  // as it stands in the file, where that is in millimetres
};

struct CameraFileOptions {
  std::optional<Eigen::Vector2i> photo_size;  // for files that do not tell it [px]
  std::string camera;  // which one of several that a file holds: its name or number there

  void Check() const;  // throws CheckError that names the field: a size that is not above 0
};

}  // namespace insitu
