// SPDX-License-Identifier: GPL-3.0-or-later
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <initializer_list>

#include "calibration/camera_files/camera_file_formats.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

// A YAML file with its path, for messages.
struct Yaml {
  fs::path path;
  YAML::Node node;

  int Line() const { return node.Mark().line + 1; }
  InputError Error(const std::string& message) const { return {path, Line(), message}; }
  std::optional<Yaml> Find(std::initializer_list<const char*> keys) const;
  Yaml At(std::initializer_list<const char*> keys) const;
  double Number() const;
  std::vector<double> Numbers() const;  // a sequence, or the data of a matrix
};

std::optional<Yaml> Yaml::Find(std::initializer_list<const char*> keys) const {
  if (!node.IsMap()) return std::nullopt;
  for (const char* key : keys) {
    if (const YAML::Node found = node[key]) return Yaml{path, found};
  }
  return std::nullopt;
}

Yaml Yaml::At(std::initializer_list<const char*> keys) const {
  if (auto found = Find(keys)) return *found;
  throw Error(std::string("\"") + *keys.begin() + "\" is missing");
}

double Yaml::Number() const {
  double number = 0;
  if (node.IsScalar() && YAML::convert<double>::decode(node, number) && std::isfinite(number)) {
    return number;
  }
  throw Error("expected a finite number");
}

std::vector<double> Yaml::Numbers() const {
  if (const auto data = Find({"data"})) return data->Numbers();
  if (!node.IsSequence()) throw Error("expected a matrix or a list of numbers");
  std::vector<double> numbers;
  for (const YAML::Node& item : node) {
    if (item.IsSequence()) {
      for (const YAML::Node& number : item) numbers.push_back(Yaml{path, number}.Number());
    } else {
      numbers.push_back(Yaml{path, item}.Number());
    }
  }
  return numbers;
}

// OpenCV heads its files with "%YAML:1.0", which is not YAML's own "%YAML 1.0".
Yaml Load(const fs::path& path) {
  std::string text = ReadWhole(path);
  if (text.starts_with("%YAML:")) text = "#" + text;
  try {
    Yaml yaml{path, YAML::Load(text)};
    if (!yaml.node.IsMap()) throw InputError(path, "no camera in it, expected keys and values");
    return yaml;
  } catch (const YAML::Exception& error) {
    throw InputError(path, error.mark.line + 1, "not YAML: " + error.msg);
  }
}

Eigen::Vector2i SizeOf(const Yaml& yaml, const CameraFileOptions& options) {
  const auto width = yaml.Find({"image_width", "image_Width", "width"});
  const auto height = yaml.Find({"image_height", "image_Height", "height"});
  if (width && height) {
    return {static_cast<int>(width->Number()), static_cast<int>(height->Number())};
  }
  if (const auto size = yaml.Find({"image_size", "imageSize"})) {
    const std::vector<double> numbers = size->Numbers();
    if (numbers.size() == 2) return {static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
  }
  if (options.photo_size) return *options.photo_size;
  throw yaml.Error(
      "does not tell the size of its photographs, expected image_width and "
      "image_height");
}

// fx fy cx cy of a 3 x 3 matrix.
std::vector<double> Core(const Yaml& matrix) {
  const std::vector<double> k = matrix.Numbers();
  if (k.size() != 9) {
    throw matrix.Error(std::to_string(k.size()) + " numbers, expected the 9 of a camera matrix");
  }
  if (k[1] != 0) throw matrix.Error("a camera matrix with skew, expected 0 in its second place");
  return {k[0], k[4], k[2], k[5]};
}

std::vector<double> Coefficients(const std::optional<Yaml>& node) {
  if (!node) return {};
  std::vector<double> coefficients = node->Numbers();
  if (coefficients.size() == 14 && coefficients[12] == 0 && coefficients[13] == 0) {
    coefficients.resize(12);
  }
  if (coefficients.size() <= 12) return coefficients;
  throw node->Error("a tilted sensor or " + std::to_string(coefficients.size()) +
                    " distortion coefficients, expected at most 12 of OpenCV's");
}

CameraFile OpencvCamera(const Yaml& yaml, const std::string& format, const Yaml& matrix,
                        const std::optional<Yaml>& distortion, const CameraFileOptions& options) {
  const Eigen::Vector2i size = SizeOf(yaml, options);
  std::vector<double> intrinsics = Core(matrix);
  const std::vector<double> k = Coefficients(distortion);
  const auto kind = yaml.Find({"distortion_model", "model_type", "camera_model"});
  const std::string name = kind && kind->node.IsScalar() ? kind->node.Scalar() : "";
  if (name == "equidistant" || name == "fisheye" || yaml.Find({"fisheye_model"})) {
    return FisheyeCamera(yaml.path, matrix.Line(), format, {intrinsics, k}, size.x(), size.y());
  }
  intrinsics.insert(intrinsics.end(), k.begin(), k.end());
  return ExactCamera(yaml.path, matrix.Line(), format, intrinsics, size.x(), size.y());
}

CameraFile StereoCamera(const Yaml& yaml, const CameraFileOptions& options) {
  if (options.camera == "left" || options.camera == "M1") {
    return OpencvCamera(yaml, "OpenCV YAML, left of a pair", yaml.At({"M1"}), yaml.Find({"D1"}),
                        options);
  }
  if (options.camera == "right" || options.camera == "M2") {
    return OpencvCamera(yaml, "OpenCV YAML, right of a pair", yaml.At({"M2"}), yaml.Find({"D2"}),
                        options);
  }
  throw InputError(yaml.path,
                   "holds two cameras, M1 and M2, expected to stand in a folder that "
                   "says which one: calibration/left or calibration/right");
}

// BoofCV: t1 t2 are OpenCV's p1 p2. Where its pixels count from is not documented; half a pixel
// more or less changes nothing on its own example (RMS 0.149 px both ways), so it is taken as
// OpenCV's.
CameraFile BoofcvCamera(const Yaml& yaml) {
  const Yaml pinhole = yaml.At({"pinhole"});
  const auto number = [&](const char* key) { return pinhole.At({key}).Number(); };
  if (number("skew") != 0) throw pinhole.Error("a camera with skew, expected 0");
  std::vector<double> intrinsics = {number("fx"), number("fy"), number("cx"), number("cy")};
  if (const auto lens = yaml.Find({"radial_tangential"})) {
    std::vector<double> radial = lens->At({"radial"}).Numbers();
    if (radial.size() > 3) throw lens->Error("more than three radial coefficients");
    radial.resize(3, 0);
    intrinsics.insert(intrinsics.end(), {radial[0], radial[1], lens->At({"t1"}).Number(),
                                         lens->At({"t2"}).Number(), radial[2]});
  }
  return ExactCamera(yaml.path, pinhole.Line(), "BoofCV YAML", intrinsics,
                     static_cast<int>(number("width")), static_cast<int>(number("height")));
}

}  // namespace

CameraFile ReadYamlCamera(const fs::path& path, const CameraFileOptions& options) {
  const Yaml yaml = Load(path);
  if (yaml.Find({"pinhole"})) return BoofcvCamera(yaml);
  if (yaml.Find({"M1"})) return StereoCamera(yaml, options);
  const auto matrix = yaml.Find({"camera_matrix", "Camera_Matrix", "cameraMatrix", "K"});
  if (!matrix) {
    throw InputError(path,
                     "no camera in it, expected camera_matrix and distortion_coefficients "
                     "(OpenCV, ROS), M1 and D1 (a stereo pair) or pinhole (BoofCV)");
  }
  const bool is_ros = yaml.Find({"distortion_model"}).has_value();
  return OpencvCamera(yaml, is_ros ? "ROS YAML" : "OpenCV YAML", *matrix,
                      yaml.Find({"distortion_coefficients", "Distortion_Coefficients", "distCoeffs",
                                 "dist_coeffs", "D"}),
                      options);
}

}  // namespace insitu
