// SPDX-License-Identifier: GPL-3.0-or-later
// The readers behind ReadCameraFile, one a format in the source named after it, and what they
// share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/camera_files/camera_file.h"
#include "calibration/files/error.h"

namespace insitu {

// aicon_camera.cc, camera_json.cc, camera_yaml.cc, colmap_cameras.cc, dbat_camera.cc
CameraFile ReadAiconCamera(const std::filesystem::path& path, const CameraFileOptions& options);
CameraFile ReadJsonCamera(const std::filesystem::path& path, const CameraFileOptions& options);
CameraFile ReadYamlCamera(const std::filesystem::path& path, const CameraFileOptions& options);
CameraFile ReadColmapCamera(const std::filesystem::path& path, const CameraFileOptions& options);
CameraFile ReadDbatCamera(const std::filesystem::path& path, const CameraFileOptions& options);

// An exact equal: `intrinsics` fx fy cx cy and OpenCV's coefficients, filled up with zeros to the
// next model that mrcal has. `path` and `line` for messages, here and below.
CameraFile ExactCamera(const std::filesystem::path& path, int line, const std::string& format,
                       std::vector<double> intrinsics, int width, int height);

CameraFile FittedCamera(const std::filesystem::path& path, int line, const std::string& format,
                        const SightOfPixel& sight_of_pixel, int width, int height);

CameraFile MetricCameraFile(const std::filesystem::path& path, int line, const std::string& format,
                            const MetricCamera& metric);

// A fisheye lens: fx fy cx cy and the polynomial theta (1 + k1 theta^2 + k2 theta^4 ...) with p1 p2
// sx1 sy1 acting on it as COLMAP's THIN_PRISM_FISHEYE; in our pixels.
struct Fisheye {
  std::vector<double> intrinsics;  // fx fy cx cy
  std::vector<double> k;           // any number
  double p1 = 0, p2 = 0, sx1 = 0, sy1 = 0;
};
CameraFile FisheyeCamera(const std::filesystem::path& path, int line, const std::string& format,
                         const Fisheye& fisheye, int width, int height);

}  // namespace insitu
