// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/colmap_binary.h"

// Little-endian, without padding.
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "calibration/files/whole_file.h"

namespace insitu {
namespace {

static_assert(std::endian::native == std::endian::little, "bytes go over as they are");

namespace fs = std::filesystem;

constexpr uint64_t kNoPoint = std::numeric_limits<uint64_t>::max();

class BinaryFile {
 public:
  explicit BinaryFile(fs::path path) : path_(std::move(path)), content_(ReadWhole(path_)) {}

  size_t offset() const { return offset_; }

  InputError Error(const std::string& message) const {
    return ColmapError(path_, true, offset_, message);
  }

  template <typename Value>
  Value Take(const std::string& what) {
    if (content_.size() - offset_ < sizeof(Value)) {
      throw Error("the file ends within a " + what + ", expected more: it is cut short");
    }
    Value value;
    std::memcpy(&value, content_.data() + offset_, sizeof(Value));
    offset_ += sizeof(Value);
    return value;
  }

  double Number(const std::string& what) {
    const auto value = Take<double>(what);
    if (!std::isfinite(value)) throw Error("a " + what + " that is not finite");
    return value;
  }

  Eigen::Vector3d Vector3(const std::string& what) {
    const double x = Number(what), y = Number(what);
    return {x, y, Number(what)};
  }

  // A number of entries of at least `size` bytes each; more than the file can hold is a fault.
  size_t Count(size_t size, const std::string& what) {
    const auto count = Take<uint64_t>("number of " + what);
    if (count > (content_.size() - offset_) / size) {
      throw Error(std::to_string(count) + " " + what +
                  " announced, expected as many to follow: "
                  "the file is cut short or no model of COLMAP");
    }
    return count;
  }

  std::string Text(const std::string& what) {
    const size_t end = content_.find('\0', offset_);
    if (end == std::string::npos) throw Error("the file ends within a " + what);
    std::string text = content_.substr(offset_, end - offset_);
    offset_ = end + 1;
    return text;
  }

  void RequireEnd() const {
    if (offset_ != content_.size()) throw Error("expected the file to end here");
  }

 private:
  fs::path path_;
  std::string content_;
  size_t offset_ = 0;
};

void ReadCameras(ColmapFiles* files) {
  BinaryFile file(files->cameras_path);
  for (size_t left = file.Count(24, "cameras"); left > 0; --left) {
    const auto id = file.Take<uint32_t>("camera id");
    const auto model_id = file.Take<int32_t>("lens model");
    const auto model = FindColmapLensModel(model_id);
    if (!model) throw file.Error("lens model " + std::to_string(model_id) + " is not COLMAP's");
    const auto width = file.Take<uint64_t>("width"), height = file.Take<uint64_t>("height");
    constexpr uint64_t kLargest = std::numeric_limits<int>::max();
    if (width == 0 || height == 0 || width > kLargest || height > kLargest) {
      throw file.Error("an image of " + std::to_string(width) + "x" + std::to_string(height) +
                       " px, expected a size above 0");
    }
    ColmapLens lens{model->name, static_cast<int>(width), static_cast<int>(height), {}};
    for (int i = 0; i < model->params; ++i) lens.params.push_back(file.Number("lens parameter"));
    if (!files->model.cameras.emplace(id, lens).second) {
      throw file.Error("camera " + std::to_string(id) + " occurs twice");
    }
  }
  file.RequireEnd();
}

Rigid3 ReadPose(BinaryFile* file) {
  const double w = file->Number("quaternion"), x = file->Number("quaternion");
  const double y = file->Number("quaternion"), z = file->Number("quaternion");
  const Eigen::Quaterniond rotation(w, x, y, z);
  if (!(rotation.norm() > 1e-9)) throw file->Error("a quaternion of 0, expected a rotation");
  return {rotation.normalized(), file->Vector3("translation")};
}

void ReadImages(ColmapFiles* files) {
  BinaryFile file(files->images_path);
  for (size_t left = file.Count(73, "images"); left > 0; --left) {
    const size_t place = file.offset();
    const auto id = file.Take<uint32_t>("image id");
    ColmapImage image;
    image.cam_from_world = ReadPose(&file);
    image.camera = file.Take<uint32_t>("camera id");
    image.name = file.Text("name");
    for (size_t keypoints = file.Count(24, "keypoints"); keypoints > 0; --keypoints) {
      const double x = file.Number("keypoint");
      ColmapKeypoint keypoint{{x, file.Number("keypoint")}, std::nullopt};
      const auto point = file.Take<uint64_t>("keypoint");
      if (point != kNoPoint) keypoint.point = point;
      image.keypoints.push_back(keypoint);
    }
    files->place_of_image[id] = place;
    if (!files->model.images.emplace(id, std::move(image)).second) {
      throw file.Error("image " + std::to_string(id) + " occurs twice");
    }
  }
  file.RequireEnd();
}

void ReadPoints(ColmapFiles* files) {
  BinaryFile file(files->points_path);
  for (size_t left = file.Count(51, "points"); left > 0; --left) {
    const size_t place = file.offset();
    const auto id = file.Take<uint64_t>("point id");
    ColmapPoint point;
    point.position = file.Vector3("position");
    for (uint8_t& channel : point.rgb) channel = file.Take<uint8_t>("colour");
    point.error_px = file.Number("error");
    for (size_t elements = file.Count(8, "track elements"); elements > 0; --elements) {
      const auto image = file.Take<uint32_t>("track element");
      point.track.push_back({image, file.Take<uint32_t>("track element")});
    }
    files->place_of_point[id] = place;
    if (!files->model.points.emplace(id, std::move(point)).second) {
      throw file.Error("point " + std::to_string(id) + " occurs twice");
    }
  }
  file.RequireEnd();
}

template <typename Value>
void Append(Value value, std::string* bytes) {
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof(Value));
  bytes->append(raw, sizeof(Value));
}

std::string CamerasBytes(const ColmapModel& model) {
  std::string bytes;
  Append<uint64_t>(model.cameras.size(), &bytes);
  for (const auto& [id, lens] : model.cameras) {
    Append<uint32_t>(id, &bytes);
    const auto lens_model = FindColmapLensModel(lens.model);
    INSITU_CHECK(lens_model.has_value());
    Append<int32_t>(lens_model->id, &bytes);
    Append<uint64_t>(static_cast<uint64_t>(lens.width), &bytes);
    Append<uint64_t>(static_cast<uint64_t>(lens.height), &bytes);
    for (const double param : lens.params) Append<double>(param, &bytes);
  }
  return bytes;
}

std::string ImagesBytes(const ColmapModel& model) {
  std::string bytes;
  Append<uint64_t>(model.images.size(), &bytes);
  for (const auto& [id, image] : model.images) {
    Append<uint32_t>(id, &bytes);
    const auto& q = image.cam_from_world.rotation;
    const auto& t = image.cam_from_world.translation;
    for (const double number : {q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z()}) {
      Append<double>(number, &bytes);
    }
    Append<uint32_t>(image.camera, &bytes);
    bytes.append(image.name).push_back('\0');
    Append<uint64_t>(image.keypoints.size(), &bytes);
    for (const ColmapKeypoint& keypoint : image.keypoints) {
      Append<double>(keypoint.position.x(), &bytes);
      Append<double>(keypoint.position.y(), &bytes);
      Append<uint64_t>(keypoint.point.value_or(kNoPoint), &bytes);
    }
  }
  return bytes;
}

std::string PointsBytes(const ColmapModel& model) {
  std::string bytes;
  Append<uint64_t>(model.points.size(), &bytes);
  for (const auto& [id, point] : model.points) {
    Append<uint64_t>(id, &bytes);
    for (int i = 0; i < 3; ++i) Append<double>(point.position[i], &bytes);
    for (const uint8_t channel : point.rgb) Append<uint8_t>(channel, &bytes);
    Append<double>(point.error_px, &bytes);
    Append<uint64_t>(point.track.size(), &bytes);
    for (const ColmapTrackElement& element : point.track) {
      Append<uint32_t>(element.image, &bytes);
      Append<uint32_t>(element.keypoint, &bytes);
    }
  }
  return bytes;
}

}  // namespace

ColmapFiles ReadColmapBinaryFiles(const fs::path& folder) {
  ColmapFiles files;
  files.cameras_path = folder / "cameras.bin";
  files.images_path = folder / "images.bin";
  files.points_path = folder / "points3D.bin";
  files.is_binary = true;
  ReadCameras(&files);
  ReadImages(&files);
  ReadPoints(&files);
  return files;
}

void WriteColmapBinary(const fs::path& folder, const ColmapModel& model) {
  WriteWhole(folder / "cameras.bin", CamerasBytes(model));
  WriteWhole(folder / "images.bin", ImagesBytes(model));
  WriteWhole(folder / "points3D.bin", PointsBytes(model));
}

}  // namespace insitu
