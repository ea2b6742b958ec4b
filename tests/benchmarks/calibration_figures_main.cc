// SPDX-License-Identifier: GPL-3.0-or-later
// calibration_figures: prints what calibration/ reaches on the shared data as JSON.
#include <json/writer.h>
#include <unistd.h>

#include <iostream>

#include "tests/benchmarks/calibration_figures.h"

int main() {
  const auto shared = insitu::SharedFolder();
  if (!shared) {
    std::cerr << "SKIPPED: no shared data; INSITU_SHARED names its folder\n";
    return 77;
  }
  const std::filesystem::path work = std::filesystem::temp_directory_path() /
                                     ("insitu_calibration_figures_" + std::to_string(getpid()));
  Json::Value json;
  json["mrcal_figueroa_overpass"] = insitu::FigueroaFigures(*shared, work);
  json["boofcv_sony_hx5v_chess"] = insitu::BoofcvFigures(*shared, work);
  json["opencv_stereo_chessboard"] = insitu::OpencvFigures(*shared, work);
  json["metric_cameras"] = insitu::MetricFigures(*shared);
  std::filesystem::remove_all(work);
  std::cout << json << "\n";
}
