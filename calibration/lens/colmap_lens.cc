// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/colmap_lens.h"

#include <algorithm>
#include <stdexcept>

#include "calibration/files/error.h"

namespace insitu {
namespace {

// fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6 is the order of both sides; missing ones are 0.
constexpr size_t kPinhole = 4, kOpencv = 8, kFullOpencv = 12;

bool IsOneOf(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// With fx and fy, and the distortion behind the principal point.
std::vector<double> TwoFocalLengths(const ColmapLens& lens) {
  if (!lens.model.starts_with("SIMPLE_") && lens.model != "RADIAL") return lens.params;
  std::vector<double> params = lens.params;
  params.insert(params.begin(), params.front());
  return params;
}

}  // namespace

const std::vector<ColmapLensModel>& ColmapLensModels() {
  static const std::vector<ColmapLensModel> models = {
      {0, "SIMPLE_PINHOLE", 3},
      {1, "PINHOLE", 4},
      {2, "SIMPLE_RADIAL", 4},
      {3, "RADIAL", 5},
      {4, "OPENCV", 8},
      {5, "OPENCV_FISHEYE", 8},
      {6, "FULL_OPENCV", 12},
      {7, "FOV", 5},
      {8, "SIMPLE_RADIAL_FISHEYE", 4},
      {9, "RADIAL_FISHEYE", 5},
      {10, "THIN_PRISM_FISHEYE", 12},
      {11, "RAD_TAN_THIN_PRISM_FISHEYE", 16},
      {12, "SIMPLE_DIVISION", 4},
      {13, "DIVISION", 5},
      {14, "SIMPLE_FISHEYE", 3},
      {15, "FISHEYE", 4},
      {16, "EUCM", 6},
      {17, "EQUIRECTANGULAR", 2},
  };
  return models;
}

std::optional<ColmapLensModel> FindColmapLensModel(const std::string& name) {
  for (const ColmapLensModel& model : ColmapLensModels()) {
    if (model.name == name) return model;
  }
  return std::nullopt;
}

std::optional<ColmapLensModel> FindColmapLensModel(int id) {
  for (const ColmapLensModel& model : ColmapLensModels()) {
    if (model.id == id) return model;
  }
  return std::nullopt;
}

std::optional<ColmapLens> ColmapFromCamera(const Camera& camera) {
  const std::string& model = camera.lens_model();
  if (!IsOneOf(model, {"LENSMODEL_PINHOLE", "LENSMODEL_OPENCV4", "LENSMODEL_OPENCV5",
                       "LENSMODEL_OPENCV8"})) {
    return std::nullopt;
  }
  std::vector<double> params = camera.intrinsics();
  while (params.size() > kOpencv && params.back() == 0) params.pop_back();
  const size_t count = params.size() <= kPinhole  ? kPinhole
                       : params.size() <= kOpencv ? kOpencv
                                                  : kFullOpencv;
  params.resize(count, 0);
  const Eigen::Vector2d center = ColmapFromPixel({params[2], params[3]});
  params[2] = center.x();
  params[3] = center.y();
  return ColmapLens{count == kPinhole  ? "PINHOLE"
                    : count == kOpencv ? "OPENCV"
                                       : "FULL_OPENCV",
                    camera.width(), camera.height(), params};
}

std::optional<Camera> CameraFromColmap(const ColmapLens& lens) {
  if (!IsOneOf(lens.model,
               {"SIMPLE_PINHOLE", "PINHOLE", "SIMPLE_RADIAL", "RADIAL", "OPENCV", "FULL_OPENCV"})) {
    return std::nullopt;
  }
  INSITU_CHECK(static_cast<int>(lens.params.size()) == FindColmapLensModel(lens.model)->params);
  std::vector<double> params = TwoFocalLengths(lens);
  const Eigen::Vector2d center = PixelFromColmap({params[2], params[3]});
  params[2] = center.x();
  params[3] = center.y();
  if (params.size() > kPinhole && params.size() < kOpencv) params.resize(kOpencv, 0);
  const char* model = params.size() == kPinhole  ? "LENSMODEL_PINHOLE"
                      : params.size() == kOpencv ? "LENSMODEL_OPENCV4"
                                                 : "LENSMODEL_OPENCV8";
  try {
    return Camera(model, params, lens.width, lens.height);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace insitu
