// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/colmap_cameras.h"

#include <cmath>
#include <limits>
#include <set>

#include "calibration/camera_files/camera_file_formats.h"
#include "calibration/files/text_table.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

// ---- the table -----------------------------------------------------------------------------

uint32_t IdOf(const TextRow& row, size_t word) {
  const double id = row.Number(word, "the camera's id");
  if (id >= 0 && id <= std::numeric_limits<uint32_t>::max() && id == std::floor(id)) {
    return static_cast<uint32_t>(id);
  }
  throw row.Error("camera id is \"" + row.words[word] + "\", expected a whole number");
}

ColmapLens LensOf(const TextRow& row) {
  if (row.words.size() < 5) {
    throw row.Error("cut short, expected CAMERA_ID MODEL WIDTH HEIGHT PARAMS");
  }
  ColmapLens lens;
  lens.model = row.words[1];
  const auto model = FindColmapLensModel(lens.model);
  if (!model) throw row.Error("lens model '" + lens.model + "' is not one of COLMAP's");
  lens.width = row.Integer(2, "the width");
  lens.height = row.Integer(3, "the height");
  if (lens.width <= 0 || lens.height <= 0) {
    throw row.Error("a frame without pixels, expected WIDTH and HEIGHT");
  }
  for (size_t i = 4; i < row.words.size(); ++i) {
    lens.params.push_back(row.Number(i, "a parameter of the lens"));
  }
  if (static_cast<size_t>(model->params) == lens.params.size()) return lens;
  throw row.Error(std::to_string(lens.params.size()) + " parameters, expected " +
                  std::to_string(model->params) + " of " + lens.model);
}

// "# Number of cameras: 3" at its head tells a file cut short.
void RequireCount(const fs::path& path, const std::string& content, size_t cameras) {
  constexpr std::string_view kHead = "# Number of cameras: ";
  const size_t head = content.find(kHead);
  if (head == std::string::npos) return;
  const size_t begin = head + kHead.size();
  const std::vector<std::string> words =
      SplitAtBlanks(content.substr(begin, content.find('\n', begin) - begin));
  const auto count = words.empty() ? std::nullopt : ParseNumber(words[0]);
  if (!count || *count == static_cast<double>(cameras)) return;
  throw InputError(path, "ends after " + std::to_string(cameras) + " entries, expected " +
                             words[0] + " as its head says");
}

// ---- as a camera file ----------------------------------------------------------------------

ColmapCamera ChooseCamera(const fs::path& path, const std::string& id) {
  const std::map<uint32_t, ColmapCamera> cameras = ReadColmapCameras(path);
  if (cameras.size() == 1) return cameras.begin()->second;
  std::string ids;
  for (const auto& [number, camera] : cameras) {
    if (std::to_string(number) == id) return camera;
    ids += " " + std::to_string(number);
  }
  throw InputError(
      path,
      "holds " + std::to_string(cameras.size()) + " cameras," + ids +
          ", expected one, or a model's images.txt beside it, which tells whose each is, or to "
          "stand in a folder named after its number");
}

// fx fy cx cy in our pixels, and the rest; of the models that are fitted.
std::vector<double> WithTwoFocalLengths(const ColmapLens& lens) {
  std::vector<double> p = lens.params;
  if (lens.model == "SIMPLE_RADIAL_FISHEYE" || lens.model == "RADIAL_FISHEYE") {
    p.insert(p.begin(), p.front());
  }
  Eigen::Map<Eigen::Vector2d> center(&p[2]);
  center = PixelFromColmap(center);
  return p;
}

// Devernay and Faugeras: the image's radius is atan(2 r tan(omega / 2)) / omega.
std::optional<Eigen::Vector3d> FovSight(const std::vector<double>& p,
                                        const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d image((pixel.x() - p[2]) / p[0], (pixel.y() - p[3]) / p[1]);
  const double omega = p[4], radius = image.norm();
  if (radius < 1e-12 || std::abs(omega) < 1e-9) return image.homogeneous();
  if (std::abs(radius * omega) >= M_PI / 2) return std::nullopt;
  const double undistorted = std::tan(radius * omega) / (2 * std::tan(omega / 2));
  return Eigen::Vector2d(image * (undistorted / radius)).homogeneous();
}

Fisheye FisheyeOf(const std::string& model, const std::vector<double>& p) {
  Fisheye lens{{p[0], p[1], p[2], p[3]}, {p.begin() + 4, p.end()}};
  if (model == "THIN_PRISM_FISHEYE") {
    lens = {{p[0], p[1], p[2], p[3]}, {p[4], p[5], p[8], p[9]}, p[6], p[7], p[10], p[11]};
  }
  return lens;
}

}  // namespace

std::map<uint32_t, ColmapCamera> ReadColmapCameras(const fs::path& path) {
  const std::string content = ReadTextFile(path);
  std::map<uint32_t, ColmapCamera> cameras;
  for (const TextRow& row : SplitTextRows(path, content, WordSeparator::kBlanks)) {
    const uint32_t id = IdOf(row, 0);
    if (cameras.emplace(id, ColmapCamera{LensOf(row), row.place()}).second) continue;
    throw row.Error("camera " + std::to_string(id) + " occurs twice");
  }
  RequireCount(path, content, cameras.size());
  return cameras;
}

std::map<std::string, uint32_t> ReadColmapCameraOfImages(const fs::path& path) {
  constexpr size_t kCamera = 8, kName = 9;  // IMAGE_ID, QW to QZ, TX to TZ, CAMERA_ID, NAME
  std::map<std::string, uint32_t> camera_of_image;
  for (const TextRow& row : SplitTextRows(path, ReadTextFile(path), WordSeparator::kBlanks)) {
    // Every second line holds keypoints, numbers alone, or nothing.
    if (row.words.size() <= kName || ParseNumber(row.words[kName])) continue;
    std::string name = row.words[kName];
    for (size_t i = kName + 1; i < row.words.size(); ++i) name += " " + row.words[i];
    name = fs::path(name).stem().string();
    if (camera_of_image.emplace(name, IdOf(row, kCamera)).second) continue;
    throw row.Error("image '" + name + "' occurs twice");
  }
  return camera_of_image;
}

CameraFile ReadColmapCamera(const fs::path& path, const CameraFileOptions& options) {
  const auto [lens, place] = ChooseCamera(path, options.camera);
  const std::string format = "COLMAP " + lens.model;
  if (const auto camera = CameraFromColmap(lens)) return {*camera, format, 0, std::nullopt};
  static const std::set<std::string> kFitted = {"SIMPLE_RADIAL_FISHEYE", "RADIAL_FISHEYE",
                                                "OPENCV_FISHEYE", "THIN_PRISM_FISHEYE", "FOV"};
  if (!kFitted.contains(lens.model)) {
    throw InputError(path, place.line,
                     "model " + lens.model +
                         " is not read, or its numbers are not a lens's; expected "
                         "one of COLMAP 3.8, e.g. OPENCV");
  }
  const std::vector<double> p = WithTwoFocalLengths(lens);
  if (lens.model != "FOV") {
    return FisheyeCamera(path, place.line, format, FisheyeOf(lens.model, p), lens.width,
                         lens.height);
  }
  return FittedCamera(
      path, place.line, format, [&](const Eigen::Vector2d& pixel) { return FovSight(p, pixel); },
      lens.width, lens.height);
}

}  // namespace insitu
