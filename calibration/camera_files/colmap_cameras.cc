// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "calibration/camera_files/camera_file_formats.h"
#include "calibration/files/whole_file.h"
#include "calibration/lens/colmap_lens.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

struct Word {
  int line;
  std::string text;
};

std::vector<Word> Words(const fs::path& path) {
  std::istringstream stream(ReadWhole(path));
  std::vector<Word> words;
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    std::istringstream cells(text);
    for (std::string word; cells >> word && !word.starts_with('#');) words.push_back({line, word});
  }
  return words;
}

double Number(const fs::path& path, const Word& word) {
  double value = 0;
  const char* end = word.text.data() + word.text.size();
  const auto parsed = std::from_chars(word.text.data(), end, value);
  if (parsed.ec == std::errc() && parsed.ptr == end && std::isfinite(value)) return value;
  throw InputError(path, word.line, "\"" + word.text + "\", expected a finite number");
}

// ---- COLMAP --------------------------------------------------------------------------------
// [colmap.github.io/cameras.html, src/colmap/sensor/models.h]

struct ColmapLine {
  int line = 0;
  std::string id;
  ColmapLens lens;
};

std::vector<ColmapLine> ReadColmapLines(const fs::path& path) {
  std::map<int, std::vector<Word>> lines;
  for (const Word& word : Words(path)) lines[word.line].push_back(word);
  std::vector<ColmapLine> cameras;
  for (const auto& [line, words] : lines) {
    if (words.size() < 5) {
      throw InputError(path, line, "cut short, expected CAMERA_ID MODEL WIDTH HEIGHT PARAMS");
    }
    ColmapLine camera{line,
                      words[0].text,
                      {words[1].text,
                       static_cast<int>(Number(path, words[2])),
                       static_cast<int>(Number(path, words[3])),
                       {}}};
    for (size_t i = 4; i < words.size(); ++i) {
      camera.lens.params.push_back(Number(path, words[i]));
    }
    cameras.push_back(camera);
  }
  return cameras;
}

ColmapLine ChooseColmapLine(const fs::path& path, const std::string& id) {
  const std::vector<ColmapLine> cameras = ReadColmapLines(path);
  if (cameras.size() == 1) return cameras.front();
  std::string ids;
  for (const ColmapLine& camera : cameras) {
    if (camera.id == id) return camera;
    ids += " " + camera.id;
  }
  throw InputError(path, "holds " + std::to_string(cameras.size()) + " cameras," + ids +
                             ", expected one, or to stand in a folder named after its number");
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

CameraFile ReadColmapCamera(const fs::path& path, const CameraFileOptions& options) {
  const auto [line, id, lens] = ChooseColmapLine(path, options.camera);
  const auto model = FindColmapLensModel(lens.model);
  const auto error = [&, line = line](const std::string& message) {
    return InputError(path, line, message);
  };
  if (model && static_cast<size_t>(model->params) != lens.params.size()) {
    throw error(std::to_string(lens.params.size()) + " parameters, expected " +
                std::to_string(model->params) + " of " + lens.model);
  }
  if (lens.width <= 0 || lens.height <= 0) {
    throw error("a frame without pixels, expected WIDTH and HEIGHT");
  }
  const std::string format = "COLMAP " + lens.model;
  if (model) {
    if (const auto camera = CameraFromColmap(lens)) return {*camera, format, 0, std::nullopt};
  }
  static const std::set<std::string> kFitted = {"SIMPLE_RADIAL_FISHEYE", "RADIAL_FISHEYE",
                                                "OPENCV_FISHEYE", "THIN_PRISM_FISHEYE", "FOV"};
  if (!model || !kFitted.contains(lens.model)) {
    throw error("model " + lens.model +
                " is not read, or its numbers are not a lens's; expected "
                "one of COLMAP 3.8, e.g. OPENCV");
  }
  const std::vector<double> p = WithTwoFocalLengths(lens);
  if (lens.model != "FOV") {
    return FisheyeCamera(path, line, format, FisheyeOf(lens.model, p), lens.width, lens.height);
  }
  return FittedCamera(
      path, line, format, [&](const Eigen::Vector2d& pixel) { return FovSight(p, pixel); },
      lens.width, lens.height);
}

}  // namespace insitu
