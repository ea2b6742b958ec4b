// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict/camera_context.h"

#include <algorithm>
#include <cmath>

#include "reconstruction/geometry/plane.h"

namespace insitu {

const CameraContext& ContextOf(const CameraContexts& cameras, int camera) {
  static const CameraContext kUnknown;
  const auto found = cameras.find(camera);
  return found == cameras.end() ? kUnknown : found->second;
}

bool IsCalibratedAt(const CameraContext& camera, const Eigen::Vector2d& pixel) {
  const Json::Value& report = camera.calibration;
  if (report.isObject() && report.isMember("cells")) {
    const Json::Value& rows = report["cells"]["counts"];
    const auto cell = [](double at, double size, Json::ArrayIndex count) {
      const double index = std::floor((at + 0.5) / size * count);
      return static_cast<Json::ArrayIndex>(std::clamp(index, 0.0, count - 1.0));
    };
    const Json::Value& row = rows[cell(pixel.y(), report["height"].asDouble(), rows.size())];
    return row[cell(pixel.x(), report["width"].asDouble(), row.size())].asInt() > 0;
  }
  return camera.calibrated_region.empty() || IsInside(camera.calibrated_region, pixel);
}

}  // namespace insitu
