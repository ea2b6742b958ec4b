// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/dbat_camera.h"

#include <algorithm>

#include "calibration/camera_files/camera_file_formats.h"
#include "calibration/files/error_at.h"
#include "calibration/files/sentence.h"
#include "calibration/files/text_table.h"

namespace insitu {
namespace {

std::vector<double> NumbersOfCount(const XmlNode& node, size_t least, size_t most) {
  const std::vector<double> numbers = node.Numbers();
  if (numbers.size() < least || numbers.size() > most) {
    const Json::Value count = int(numbers.size()), fewest = int(least);
    throw node.Error(most > least
                         ? Sentence("dbatMoreNumbers", "{count} numbers, expected {least} or more",
                                    {{"count", count}, {"least", fewest}})
                         : Sentence("dbatNumbers", "{count} numbers, expected {least}",
                                    {{"count", count}, {"least", fewest}}));
  }
  return numbers;
}

void ParseSize(const XmlNode& element, DbatCamera* camera) {
  const std::vector<double> image = NumbersOfCount(element.At("image"), 2, 2);
  const XmlNode sensor = element.At("sensor");
  const std::vector<std::string> sizes = SplitAt(sensor.Text(), ',');
  const auto height = sizes.size() == 2 ? ParseNumber(sizes[1]) : std::nullopt;
  if (!height) {
    throw sensor.Error(
        Sentence("dbatSensor", "expected width,height in mm, the width may be \"auto\""));
  }
  if (!(image[0] >= 1 && image[0] < 1e6 && image[1] >= 1 && image[1] < 1e6 && *height > 0)) {
    throw sensor.Error(Sentence("dbatSize", "image and sensor must have a size"));
  }
  camera->width = static_cast<int>(image[0]);
  camera->height = static_cast<int>(image[1]);
  camera->sensor_mm = *height / image[1] * Eigen::Vector2d(image[0], image[1]);
  if (sizes[0] == "auto") return;
  const auto width = ParseNumber(sizes[0]);
  if (!width || !(*width > 0)) {
    throw sensor.Error(Sentence("dbatWidth", "the width must be positive or \"auto\""));
  }
  camera->sensor_mm.x() = *width;
}

// The width without the stretch by the aspect that stands beside it.
void ParseAspect(const XmlNode& element, DbatCamera* camera) {
  const auto aspect = element.Find("aspect");
  if (!aspect) return;
  camera->aspect = aspect->Number();
  if (!(camera->aspect > 0 && camera->aspect < 2)) {
    throw aspect->Error(
        Sentence("dbatAspect", "\"{text}\", expected a number near 1", {{"text", aspect->Text()}}));
  }
  const bool has_square_pixels = element.At("sensor").Text().starts_with("auto");
  if (!has_square_pixels) camera->sensor_mm.x() /= 2 - camera->aspect;
}

void ParseModel(const XmlNode& element, DbatCamera* camera) {
  const XmlNode model = element.At("model");
  camera->model = static_cast<int>(model.Number());
  const bool has_affinity = camera->aspect != 1 || camera->skew != 0;
  if (camera->model == 3 || ((camera->model == 1 || camera->model == 2) && !has_affinity)) return;
  const Json::Value text = model.Text();
  throw model.Error(
      has_affinity ? Sentence("dbatAffineModel",
                              "lens model {model} with affinity, expected 3, or 1 or 2 without "
                              "affinity: these are what we can adjust",
                              {{"model", text}})
                   : Sentence("dbatModel",
                              "lens model {model}, expected 3, or 1 or 2 without affinity: these "
                              "are what we can adjust",
                              {{"model", text}}));
}

// cc, pp, K, P, aspect, skew. A constant of 0, as blank camera files have, is not stated.
void ParseValues(const XmlNode& element, DbatCamera* camera) {
  if (const auto node = element.Find("cc"); node && node->Text() != "focal") {
    const double cc = NumbersOfCount(*node, 1, 1)[0];
    if (cc < 0) {
      throw node->Error(Sentence("dbatConstant", "the camera constant must be positive"));
    }
    if (cc > 0) camera->cc_mm = cc;
  }
  if (const auto node = element.Find("pp"); node && node->Text() != "default") {
    const std::vector<double> pp = NumbersOfCount(*node, 2, 2);
    if (pp[0] != 0 || pp[1] != 0) camera->pp_mm = {pp[0], pp[1]};
  }
  if (const auto node = element.Find("K")) {
    const std::vector<double> K = NumbersOfCount(*node, 1, 3);
    std::copy(K.begin(), K.end(), camera->K.begin());
  }
  if (const auto node = element.Find("P")) {
    const std::vector<double> P = NumbersOfCount(*node, 2, 2);
    std::copy(P.begin(), P.end(), camera->P.begin());
  }
  if (const auto node = element.Find("skew")) camera->skew = node->Number();
}

int ParseCount(const XmlNode& element, const std::string& name, int most) {
  const auto node = element.Find(name);
  if (!node) return most;
  const double count = node->Number();
  if (!(count >= 0 && count <= most)) {
    throw node->Error(
        Sentence("dbatCoefficients", "expected at most {most} coefficients", {{"most", most}}));
  }
  return static_cast<int>(count);
}

// A camera that is only to be calibrated has neither.
void RequireCalibrated(const XmlNode& camera) {
  const XmlNode cc = camera.At("cc");
  if (!(NumbersOfCount(cc, 1, 1)[0] > 0)) {
    throw cc.Error(Sentence("dbatBlank", "is not positive, expected a calibrated camera"));
  }
  NumbersOfCount(camera.At("pp"), 2, 2);
}

}  // namespace

DbatCamera WithDefaults(DbatCamera camera) {
  camera.cc_mm = camera.focal_mm;
  camera.aspect = 1;
  camera.skew = 0;
  camera.pp_mm = camera.sensor_mm / 2;
  camera.K.fill(0);
  camera.P.fill(0);
  return camera;
}

DbatCamera ParseDbatCamera(const XmlNode& element) {
  if (const auto unit = element.Find("unit"); unit && unit->Text() != "mm") {
    throw unit->Error(
        Sentence("dbatCameraUnit", "\"{unit}\", expected mm", {{"unit", unit->Text()}}));
  }
  DbatCamera camera;
  if (const auto id = element.Find("id")) camera.id = id->Text();
  if (const auto name = element.Find("name")) camera.name = name->Text();
  if (const auto focal = element.Find("focal")) {
    camera.focal_mm = focal->Number();
    if (!(camera.focal_mm > 0)) {
      throw focal->Error(Sentence("dbatFocal", "the focal length must be positive"));
    }
  }
  ParseSize(element, &camera);
  camera = WithDefaults(camera);
  ParseAspect(element, &camera);
  ParseValues(element, &camera);
  if (!(camera.cc_mm > 0))
    throw element.Error(
        Sentence("dbatNoFocal", "<focal> and <cc> are missing, expected one of them"));
  if (camera.focal_mm == 0) camera.focal_mm = camera.cc_mm;
  ParseModel(element, &camera);
  camera.K_count = ParseCount(element, "nK", 3);
  camera.P_count = ParseCount(element, "nP", 2);
  return camera;
}

MetricCamera MetricFromDbat(const DbatCamera& camera) {
  MetricCamera metric;
  metric.model = MetricModel::kBackwardBrown;
  metric.width = camera.width;
  metric.height = camera.height;
  metric.pixel_mm = camera.pixel_mm();
  metric.origin_px.setConstant(-kDbatFirstPixelCenter);
  metric.parameters = {camera.cc_mm,      camera.pp_mm.x(), -camera.pp_mm.y(), camera.K[0],
                       camera.K[1],       camera.K[2],      camera.P[0],       camera.P[1],
                       1 - camera.aspect, camera.skew};
  return metric;
}

DbatCamera DbatFromMetric(const MetricCamera& metric) {
  INSITU_CHECK(metric.model == MetricModel::kBackwardBrown);
  const std::vector<double>& p = metric.parameters;
  const Eigen::Vector2d origin = metric.origin_px.array() + kDbatFirstPixelCenter;
  const Eigen::Vector2d corner_mm = metric.pixel_mm.cwiseProduct(origin);
  DbatCamera camera;
  camera.width = metric.width;
  camera.height = metric.height;
  camera.sensor_mm = metric.pixel_mm.cwiseProduct(Eigen::Vector2d(metric.width, metric.height));
  camera.focal_mm = camera.cc_mm = p[0];
  camera.pp_mm = corner_mm + Eigen::Vector2d(p[1], -p[2]);
  camera.K = {p[3], p[4], p[5]};
  camera.P = {p[6], p[7]};
  camera.aspect = 1 - p[8];
  camera.skew = p[9];
  return camera;
}

CameraFile ReadDbatCamera(const std::filesystem::path& path, const CameraFileOptions& options) {
  const XmlNode root = XmlNode::Load(path);
  const auto list = root.Find("cameras");
  const std::vector<XmlNode> cameras = list ? list->Children("camera") : std::vector<XmlNode>();
  if (cameras.empty()) {
    throw ErrorAt({path}, Sentence("dbatCameraNone",
                                   "no camera in it, expected DBAT's <document><cameras><camera>"));
  }
  for (const XmlNode& camera : cameras) {
    const auto id = camera.Find("id");
    if (cameras.size() > 1 && !(id && id->Text() == options.camera)) continue;
    RequireCalibrated(camera);
    return MetricCameraFile(path, camera.line(), "DBAT XML",
                            MetricFromDbat(ParseDbatCamera(camera)));
  }
  throw ErrorAt({path}, Sentence("dbatSeveral",
                                 "holds several cameras, expected one, or to stand in a folder "
                                 "named after its <id>"));
}

}  // namespace insitu
