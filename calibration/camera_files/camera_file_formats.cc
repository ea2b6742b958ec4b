// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/camera_file_formats.h"

#include <cmath>
#include <stdexcept>

#include "calibration/lens/invert_plane.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

void CheckSize(const fs::path& path, int line, int width, int height) {
  if (width > 0 && height > 0 && width < 1000000 && height < 1000000) return;
  throw InputError(
      path, line,
      "a frame of " + SizeText(width, height) + ", expected the photographs' width and height");
}

}  // namespace

CameraFile ExactCamera(const fs::path& path, int line, const std::string& format,
                       std::vector<double> intrinsics, int width, int height) {
  CheckSize(path, line, width, height);
  for (const size_t distortion : {0, 4, 5, 8, 12}) {
    if (intrinsics.size() > 4 + distortion) continue;
    intrinsics.resize(4 + distortion, 0);
    const std::string model =
        distortion == 0 ? "LENSMODEL_PINHOLE" : "LENSMODEL_OPENCV" + std::to_string(distortion);
    try {
      return {Camera(model, intrinsics, width, height), format, 0, std::nullopt};
    } catch (const std::invalid_argument& error) {
      throw InputError(path, line, error.what());
    }
  }
  throw InputError(
      path, line,
      std::to_string(intrinsics.size() - 4) + " distortion coefficients, expected at most 12");
}

CameraFile FittedCamera(const fs::path& path, int line, const std::string& format,
                        const SightOfPixel& sight_of_pixel, int width, int height) {
  CheckSize(path, line, width, height);
  const auto fit = FitCamera(sight_of_pixel, width, height);
  if (fit) return {fit->camera, format, fit->largest_deviation_px, std::nullopt};
  throw InputError(path, line,
                   "a lens that cannot be shown on " + SizeText(width, height) +
                       ": its distortion folds over or it looks farther than 80 "
                       "degrees off its axis, expected one for a plane image");
}

CameraFile MetricCameraFile(const fs::path& path, int line, const std::string& format,
                            const MetricCamera& metric) {
  const auto sight = [&](const Eigen::Vector2d& pixel) { return UnprojectMetric(metric, pixel); };
  CameraFile file = FittedCamera(path, line, format, sight, metric.width, metric.height);
  file.metric = metric;
  return file;
}

CameraFile FisheyeCamera(const fs::path& path, int line, const std::string& format,
                         const Fisheye& lens, int width, int height) {
  const std::vector<double>& f = lens.intrinsics;
  // Angles off the axis, as x and y, to normalised image coordinates.
  const auto distort = [&]<typename T>(const Eigen::Matrix<T, 2, 1>& angle) {
    const T x = angle.x(), y = angle.y();
    const T r2 = x * x + y * y;
    T radial(0), power(r2);
    for (const double k : lens.k) {
      radial += k * power;
      power *= r2;
    }
    return Eigen::Matrix<T, 2, 1>(
        x + x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2.0 * x * x) + lens.sx1 * r2,
        y + y * radial + 2 * lens.p2 * x * y + lens.p1 * (r2 + 2.0 * y * y) + lens.sy1 * r2);
  };
  const auto sight = [&](const Eigen::Vector2d& pixel) -> std::optional<Eigen::Vector3d> {
    const Eigen::Vector2d image((pixel.x() - f[2]) / f[0], (pixel.y() - f[3]) / f[1]);
    const auto angle = InvertPlane(distort, image, image, 1e-13);
    if (!angle || angle->norm() > M_PI) return std::nullopt;
    const double theta = angle->norm();
    const double scale = theta > 1e-12 ? std::sin(theta) / theta : 1;
    return Eigen::Vector3d(scale * angle->x(), scale * angle->y(), std::cos(theta));
  };
  return FittedCamera(path, line, format, sight, width, height);
}

}  // namespace insitu
