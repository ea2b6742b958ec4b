// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "calibration/camera_files/camera_file_formats.h"
#include "calibration/files/json_file.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

double NumberOr(const JsonNode& node, const char* key, double other) {
  const auto found = node.Find(key);
  return found ? found->Number() : other;
}

double Positive(const JsonNode& node) {
  const double number = node.Number();
  if (!(number > 0)) throw node.Error("is not positive, expected a positive number");
  return number;
}

// ---- millimetres as in a certificate -------------------------------------------------------

MetricCamera MetricOf(const JsonNode& file) {
  const JsonNode model = file.At("metric");
  MetricCamera camera;
  if (model.Text() == "balanced_radial") {
    camera.model = MetricModel::kBalancedRadial;
    camera.balanced_radius_mm = file.At("balanced_radius_mm").Number();
  } else if (model.Text() != "backward_brown") {
    throw model.Error("is \"" + model.Text() + "\", expected backward_brown or balanced_radial");
  }
  camera.width = static_cast<int>(Positive(file.At("width")));
  camera.height = static_cast<int>(Positive(file.At("height")));
  const std::vector<JsonNode> pixel = file.At("pixel_mm").Items();
  if (pixel.size() != 2) throw file.At("pixel_mm").Error("expected two numbers, width and height");
  camera.pixel_mm = {Positive(pixel[0]), Positive(pixel[1])};
  const JsonNode origin = file.At("origin");
  camera.origin_px = Eigen::Vector2d(-0.5, -0.5);
  if (origin.Text() == "middle") {
    camera.origin_px += Eigen::Vector2d(camera.width, camera.height) / 2;
  } else if (origin.Text() != "corner") {
    throw origin.Error("is \"" + origin.Text() + "\", expected corner or middle");
  }
  return camera;
}

std::vector<double> ParametersOf(const JsonNode& node, MetricModel model) {
  const std::vector<std::string>& names = ParameterNames(model);
  std::vector<double> parameters(names.size(), 0);
  for (const auto& [name, value] : node.Members()) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      std::string known;
      for (const std::string& each : names) known += " " + each;
      throw value.Error("is unknown, expected one of" + known);
    }
    parameters[found - names.begin()] = value.Number();
  }
  if (!(parameters[0] > 0)) throw node.Error("lacks a positive c, the calibrated focal length");
  return parameters;
}

// ---- OpenSfM -------------------------------------------------------------------------------

CameraFile OpensfmCamera(const fs::path& path, const JsonNode& camera) {
  const int width = camera.At("width").Integer(), height = camera.At("height").Integer();
  const double size = std::max(width, height);  // its unit of length; its origin is the middle
  const std::string kind = camera.At("projection_type").Text();
  const auto number = [&](const char* key) { return NumberOr(camera, key, 0); };
  const auto focal = camera.Find("focal");
  const double fx = size * (focal ? *focal : camera.At("focal_x")).Number();
  const double fy = size * (focal ? *focal : camera.At("focal_y")).Number();
  const std::vector<double> core = {fx, fy, (width - 1) / 2.0 + size * number("c_x"),
                                    (height - 1) / 2.0 + size * number("c_y")};
  const std::vector<double> k = {number("k1"), number("k2"), number("k3"), number("k4")};
  if (kind == "perspective" || kind == "brown") {
    return ExactCamera(
        path, camera.line(), "OpenSfM " + kind,
        {core[0], core[1], core[2], core[3], k[0], k[1], number("p1"), number("p2"), k[2]}, width,
        height);
  }
  if (kind == "fisheye" || kind == "fisheye_opencv") {
    return FisheyeCamera(path, camera.line(), "OpenSfM " + kind, {core, k}, width, height);
  }
  throw camera.At("projection_type")
      .Error("is \"" + kind +
             "\", expected perspective, brown, "
             "fisheye or fisheye_opencv");
}

}  // namespace

CameraFile ReadJsonCamera(const fs::path& path, const CameraFileOptions& options) {
  const JsonNode file = JsonNode::Load(path);
  if (file.Find("metric")) {
    MetricCamera camera = MetricOf(file);
    const JsonNode parameters = file.At("parameters");
    camera.parameters = ParametersOf(parameters, camera.model);
    return MetricCameraFile(path, parameters.line(), "metric JSON", camera);
  }
  const auto cameras = file.Members();
  for (const auto& [name, camera] : cameras) {
    if (cameras.size() == 1 || name == options.camera) return OpensfmCamera(path, camera);
  }
  throw InputError(path, "holds " + std::to_string(cameras.size()) +
                             " cameras, expected one, or \"metric\" with its millimetres");
}

}  // namespace insitu
