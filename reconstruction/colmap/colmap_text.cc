// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/colmap_text.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "calibration/camera_files/colmap_cameras.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// One line, taken apart word by word.
class Words {
 public:
  Words(const fs::path& path, size_t line, std::string_view text)
      : path_(path), line_(line), rest_(text) {
    SkipBlanks();
  }

  bool IsAtEnd() const { return rest_.empty(); }

  InputError Error(const std::string& message) const {
    return ColmapError(path_, false, line_, message);
  }

  // What is left, blanks within included.
  std::string Rest(const std::string& what) {
    if (rest_.empty()) throw Error("ends before its " + what);
    return std::string(rest_);
  }

  std::string Word(const std::string& what) {
    if (rest_.empty()) throw Error("ends before its " + what);
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t"));
    rest_.remove_prefix(word.size());
    SkipBlanks();
    return std::string(word);
  }

  double Number(const std::string& what) {
    const std::string word = Word(what);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      throw Error(what + " is '" + word + "', expected a finite number");
    }
    return value;
  }

  template <typename Integer>
  Integer Whole(const std::string& what) {
    const std::string word = Word(what);
    Integer value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) {
      throw Error(what + " is '" + word + "', expected a whole number");
    }
    return value;
  }

  Eigen::Vector3d Vector3(const std::string& what) {
    Eigen::Vector3d vector;
    for (int i = 0; i < 3; ++i) vector[i] = Number(what);
    return vector;
  }

 private:
  void SkipBlanks() {
    const size_t first = rest_.find_first_not_of(" \t\r");
    rest_.remove_prefix(first == std::string_view::npos ? rest_.size() : first);
    const size_t last = rest_.find_last_not_of(" \t\r");
    rest_ = rest_.substr(0, last == std::string_view::npos ? 0 : last + 1);
  }

  const fs::path& path_;
  size_t line_;
  std::string_view rest_;
};

// A file line by line; comments may state how many entries follow, which tells a file cut short.
class TextFile {
 public:
  explicit TextFile(fs::path path) : path_(std::move(path)), content_(ReadWhole(path_)) {}

  const fs::path& path() const { return path_; }
  size_t line() const { return line_; }

  // The next line that is neither blank nor a comment.
  std::optional<Words> NextEntry() {
    while (const auto text = NextLine()) {
      const Words words(path_, line_, *text);
      if (words.IsAtEnd()) continue;
      if (text->starts_with("#")) {
        ReadCount(*text);
        continue;
      }
      return words;
    }
    return std::nullopt;
  }

  // The next line, blank or not.
  std::optional<Words> NextWords() {
    const auto text = NextLine();
    if (!text) return std::nullopt;
    return Words(path_, line_, *text);
  }

  void RequireCount(size_t entries) const {
    if (!count_ || *count_ == entries) return;
    throw InputError(path_, static_cast<int>(line_),
                     "ends after " + std::to_string(entries) + " entries, expected " +
                         std::to_string(*count_) + " as its head says");
  }

 private:
  std::optional<std::string_view> NextLine() {
    if (begin_ >= content_.size()) return std::nullopt;
    size_t end = content_.find('\n', begin_);
    if (end == std::string::npos) end = content_.size();
    const std::string_view text = std::string_view(content_).substr(begin_, end - begin_);
    begin_ = end + 1;
    line_ += 1;
    return text;
  }

  // "# Number of images: 3, mean observations per image: 1001.3"
  void ReadCount(std::string_view comment) {
    if (!comment.starts_with("# Number of ")) return;
    const size_t colon = comment.find(": ");
    if (colon == std::string_view::npos) return;
    size_t count = 0;
    const char* end = comment.data() + comment.size();
    if (std::from_chars(comment.data() + colon + 2, end, count).ec == std::errc()) count_ = count;
  }

  fs::path path_;
  std::string content_;
  size_t begin_ = 0, line_ = 0;
  std::optional<size_t> count_;
};

void ParseCameras(ColmapFiles* files) {
  for (const auto& [id, camera] : ReadColmapCameras(files->cameras_path)) {
    files->model.cameras.emplace(id, camera.lens);
  }
}

Rigid3 ReadPose(Words* words) {
  const double w = words->Number("QW"), x = words->Number("QX");
  const double y = words->Number("QY"), z = words->Number("QZ");
  const Eigen::Quaterniond rotation(w, x, y, z);
  if (!(rotation.norm() > 1e-9)) throw words->Error("the quaternion is 0, expected a rotation");
  return {rotation.normalized(), words->Vector3("translation")};
}

std::vector<ColmapKeypoint> ReadKeypoints(Words words) {
  std::vector<ColmapKeypoint> keypoints;
  while (!words.IsAtEnd()) {
    ColmapKeypoint keypoint;
    keypoint.position.x() = words.Number("keypoint's x");
    keypoint.position.y() = words.Number("keypoint's y");
    const auto point = words.Whole<int64_t>("keypoint's point id");
    if (point < -1)
      throw words.Error("point id " + std::to_string(point) + ", expected -1 or more");
    if (point >= 0) keypoint.point = static_cast<uint64_t>(point);
    keypoints.push_back(keypoint);
  }
  return keypoints;
}

void ParseImages(ColmapFiles* files) {
  TextFile file(files->images_path);
  while (auto words = file.NextEntry()) {
    const auto id = words->Whole<uint32_t>("image id");
    ColmapImage image;
    image.cam_from_world = ReadPose(&*words);
    image.camera = words->Whole<uint32_t>("camera id");
    image.name = words->Rest("name");
    files->place_of_image[id] = file.line();
    const auto keypoints = file.NextWords();
    if (!keypoints) {
      throw words->Error("image '" + image.name +
                         "' has no line of keypoints, expected one, empty "
                         "if need be: the file is cut short");
    }
    image.keypoints = ReadKeypoints(*keypoints);
    if (!files->model.images.emplace(id, std::move(image)).second) {
      throw words->Error("image " + std::to_string(id) + " occurs twice");
    }
  }
  file.RequireCount(files->model.images.size());
}

void ParsePoints(ColmapFiles* files) {
  TextFile file(files->points_path);
  while (auto words = file.NextEntry()) {
    const auto id = words->Whole<uint64_t>("point id");
    ColmapPoint point;
    point.position = words->Vector3("position");
    for (uint8_t& channel : point.rgb) {
      const int value = words->Whole<int>("colour");
      if (value < 0 || value > 255) throw words->Error("colour outside 0 to 255");
      channel = static_cast<uint8_t>(value);
    }
    point.error_px = words->Number("error");
    while (!words->IsAtEnd()) {
      const auto image = words->Whole<uint32_t>("track's image id");
      point.track.push_back({image, words->Whole<uint32_t>("track's keypoint")});
    }
    files->place_of_point[id] = file.line();
    if (!files->model.points.emplace(id, std::move(point)).second) {
      throw words->Error("point " + std::to_string(id) + " occurs twice");
    }
  }
  file.RequireCount(files->model.points.size());
}

// Numbers with 17 digits, each followed by a blank.
void Append(std::initializer_list<double> numbers, std::string* text) {
  for (const double number : numbers) *text += Formatted("%.17g ", number);
}

std::string CamerasText(const ColmapModel& model) {
  std::string text =
      "# Camera list with one line of data per camera:\n"
      "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
      "# Number of cameras: " +
      std::to_string(model.cameras.size()) + "\n";
  for (const auto& [id, lens] : model.cameras) {
    text += std::to_string(id) + " " + lens.model + " " + std::to_string(lens.width) + " " +
            std::to_string(lens.height) + " ";
    for (const double param : lens.params) Append({param}, &text);
    text.back() = '\n';
  }
  return text;
}

std::string ImagesText(const ColmapModel& model) {
  std::string text =
      "# Image list with two lines of data per image:\n"
      "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
      "#   POINTS2D[] as (X, Y, POINT3D_ID)\n"
      "# Number of images: " +
      std::to_string(model.images.size()) + "\n";
  for (const auto& [id, image] : model.images) {
    const auto& q = image.cam_from_world.rotation;
    const auto& t = image.cam_from_world.translation;
    text += std::to_string(id) + " ";
    Append({q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}, &text);
    text += std::to_string(image.camera) + " " + image.name + "\n";
    for (const ColmapKeypoint& keypoint : image.keypoints) {
      Append({keypoint.position.x(), keypoint.position.y()}, &text);
      text += (keypoint.point ? std::to_string(*keypoint.point) : "-1") + " ";
    }
    if (image.keypoints.empty())
      text += '\n';
    else
      text.back() = '\n';
  }
  return text;
}

std::string PointsText(const ColmapModel& model) {
  std::string text =
      "# 3D point list with one line of data per point:\n"
      "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n"
      "# Number of points: " +
      std::to_string(model.points.size()) + "\n";
  for (const auto& [id, point] : model.points) {
    text += std::to_string(id) + " ";
    Append({point.position.x(), point.position.y(), point.position.z()}, &text);
    for (const uint8_t channel : point.rgb) text += std::to_string(channel) + " ";
    Append({point.error_px}, &text);
    for (const ColmapTrackElement& element : point.track) {
      text += std::to_string(element.image) + " " + std::to_string(element.keypoint) + " ";
    }
    text.back() = '\n';
  }
  return text;
}

}  // namespace

ColmapFiles ReadColmapTextFiles(const fs::path& folder) {
  ColmapFiles files;
  files.cameras_path = folder / "cameras.txt";
  files.images_path = folder / "images.txt";
  files.points_path = folder / "points3D.txt";
  ParseCameras(&files);
  ParseImages(&files);
  ParsePoints(&files);
  return files;
}

void WriteColmapText(const fs::path& folder, const ColmapModel& model) {
  WriteWhole(folder / "cameras.txt", CamerasText(model));
  WriteWhole(folder / "images.txt", ImagesText(model));
  WriteWhole(folder / "points3D.txt", PointsText(model));
}

}  // namespace insitu
