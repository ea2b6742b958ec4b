// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/aicon_camera.h"

#include <algorithm>

#include "calibration/camera_files/camera_file_formats.h"
#include "calibration/files/text_table.h"

namespace insitu {
namespace {

constexpr size_t kNumbers = 17;  // of a camera

// All words of the file, each as a row of its own.
std::vector<TextRow> Words(const std::filesystem::path& path) {
  std::vector<TextRow> words;
  for (const TextRow& row : ReadTextRows(path, WordSeparator::kBlanks)) {
    for (const std::string& word : row.words) words.push_back({path, row.line, {word}});
  }
  if (words.empty()) throw InputError(path, "is empty");
  if (words.size() % kNumbers == 0) return words;
  throw words.back().Error(
      "the file ends within a camera: " + std::to_string(words.size()) +
      " numbers, expected 17 a camera (number, -999, ck, xh, yh, A1, A2, r0, A3, B1, B2, C1, C2, "
      "sensor width and height, pixels)");
}

int Pixels(const TextRow& word, const char* what) {
  const int pixels = word.Integer(0, what);
  if (pixels <= 0) throw word.Error("sensor and image must have a size");
  return pixels;
}

MetricCamera LensOf(const TextRow* words) {
  static const char* const kNames[] = {"camera number",
                                       "-999",
                                       "ck",
                                       "xh",
                                       "yh",
                                       "A1",
                                       "A2",
                                       "r0",
                                       "A3",
                                       "B1",
                                       "B2",
                                       "C1",
                                       "C2",
                                       "sensor width",
                                       "sensor height"};
  std::vector<double> n(std::size(kNames), 0);
  for (size_t i = 0; i < n.size(); ++i) n[i] = words[i].Number(0, kNames[i]);
  if (!(n[2] < 0)) {
    throw words[2].Error("ck is not negative, as AICON's principal distances are");
  }
  if (!(n[13] > 0 && n[14] > 0)) throw words[13].Error("sensor and image must have a size");
  MetricCamera lens;
  lens.model = MetricModel::kBalancedRadial;
  lens.width = Pixels(words[15], "image width");
  lens.height = Pixels(words[16], "image height");
  lens.pixel_mm = {n[13] / lens.width, n[14] / lens.height};
  lens.origin_px = {(lens.width - 1) / 2.0, (lens.height - 1) / 2.0};
  lens.balanced_radius_mm = n[7];
  lens.parameters = {-n[2], n[3], n[4], n[5], n[6], n[8], n[9], n[10], n[11], n[12]};
  return lens;
}

}  // namespace

std::vector<AiconCamera> ReadAiconCameras(const std::filesystem::path& path) {
  const std::vector<TextRow> words = Words(path);
  std::vector<AiconCamera> cameras;
  for (size_t first = 0; first < words.size(); first += kNumbers) {
    const std::string& number = words[first].words[0];
    const bool is_known =
        std::any_of(cameras.begin(), cameras.end(),
                    [&](const AiconCamera& camera) { return camera.number == number; });
    if (is_known) throw words[first].Error("camera \"" + number + "\" stands twice");
    cameras.push_back({number, LensOf(&words[first]), words[first].place()});
  }
  return cameras;
}

Eigen::Vector2d AiconPixel(const MetricCamera& lens, const Eigen::Vector2d& mm) {
  return {lens.origin_px.x() + mm.x() / lens.pixel_mm.x(),
          lens.origin_px.y() - mm.y() / lens.pixel_mm.y()};
}

CameraFile ReadAiconCamera(const std::filesystem::path& path, const CameraFileOptions& options) {
  const std::vector<AiconCamera> cameras = ReadAiconCameras(path);
  for (const AiconCamera& camera : cameras) {
    if (cameras.size() > 1 && camera.number != options.camera) continue;
    return MetricCameraFile(path, camera.place.line, "AICON .ior", camera.lens);
  }
  throw InputError(path, "holds " + std::to_string(cameras.size()) +
                             " cameras, expected one, or to stand in a folder named after its "
                             "number");
}

}  // namespace insitu
