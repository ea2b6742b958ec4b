// SPDX-License-Identifier: GPL-3.0-or-later
// Camera files of other programs, recognised by their endings.
#pragma once

#include <filesystem>

#include "calibration/camera_files/camera_file.h"

namespace insitu {

// What is read, by the file's ending:
//
// - .cameramodel: mrcal.
// - .yml, .yaml: OpenCV (camera_matrix, distortion_coefficients of 0 to 12 numbers; M1 D1 M2 D2 of
// a
//   stereo pair, chosen as camera "left" or "right"), ROS camera_info, BoofCV.
// - cameras.txt: COLMAP, all models of 3.8; its pixels count from the corner, ours from the centre.
// - .xml: DBAT, its models 1 to 3 (backward Brown).
// - .ior: AICON 3D Studio (balanced radial).
// - .json: OpenSfM's camera_models.json (perspective, brown, fisheye), or millimetres as they stand
//   in a certificate: {"metric": "backward_brown" | "balanced_radial", "width", "height",
//   "pixel_mm": [x, y], "origin": "corner" | "middle", "balanced_radius_mm", "parameters": {name:
//   value}}, see MetricCamera.
//
// Throws InputError: unreadable, cut short, a model that is not read, a size that nobody tells,
// a lens too wide for a plane image.
CameraFile ReadCameraFile(const std::filesystem::path& path, const CameraFileOptions& options = {});

// Whether a file's name is one that ReadCameraFile takes.
bool IsCameraFile(const std::filesystem::path& path);

// Whether such a file's content speaks of a camera, complete or not: notes, lists and settings that
// lie beside boards end alike. Throws InputError: unreadable.
bool SpeaksOfCamera(const std::filesystem::path& path);

}  // namespace insitu
