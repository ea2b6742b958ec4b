// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/read_colmap_model.h"

#include <algorithm>

#include "reconstruction/colmap/colmap_binary.h"
#include "reconstruction/colmap/colmap_files.h"
#include "reconstruction/colmap/colmap_text.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

bool HasFiles(const fs::path& folder, const std::string& ending) {
  for (const char* name : {"cameras", "images", "points3D"}) {
    if (!fs::is_regular_file(folder / (name + ending))) return false;
  }
  return true;
}

bool IsInTrack(const ColmapPoint& point, const ColmapTrackElement& element) {
  return std::find(point.track.begin(), point.track.end(), element) != point.track.end();
}

void RequireReferencesOfImage(const ColmapFiles& files, uint32_t id, const ColmapImage& image) {
  const auto fault = [&](const std::string& message) {
    return ColmapError(files.images_path, files.is_binary, files.place_of_image.at(id), message);
  };
  if (!files.model.cameras.contains(image.camera)) {
    throw fault("image '" + image.name + "' has camera " + std::to_string(image.camera) +
                ", which " + files.cameras_path.filename().string() + " does not hold");
  }
  for (uint32_t i = 0; i < image.keypoints.size(); ++i) {
    if (!image.keypoints[i].point) continue;
    const auto point = files.model.points.find(*image.keypoints[i].point);
    if (point != files.model.points.end() && IsInTrack(point->second, {id, i})) continue;
    throw fault("keypoint " + std::to_string(i) + " of image '" + image.name + "' is of point " +
                std::to_string(*image.keypoints[i].point) + ", which " +
                files.points_path.filename().string() +
                (point == files.model.points.end() ? " does not hold" : " says is not seen there"));
  }
}

void RequireReferencesOfPoint(const ColmapFiles& files, uint64_t id, const ColmapPoint& point) {
  for (const ColmapTrackElement& element : point.track) {
    const auto image = files.model.images.find(element.image);
    const bool is_known = image != files.model.images.end() &&
                          element.keypoint < image->second.keypoints.size() &&
                          image->second.keypoints[element.keypoint].point == id;
    if (is_known) continue;
    throw ColmapError(files.points_path, files.is_binary, files.place_of_point.at(id),
                      "point " + std::to_string(id) + " is seen as keypoint " +
                          std::to_string(element.keypoint) + " of image " +
                          std::to_string(element.image) + ", which " +
                          files.images_path.filename().string() + " does not say");
  }
}

}  // namespace

bool HasColmapModel(const fs::path& folder) {
  return HasFiles(folder, ".bin") || HasFiles(folder, ".txt");
}

ColmapModel ReadColmapModel(const fs::path& folder) {
  if (!HasColmapModel(folder)) {
    throw InputError(folder,
                     "no COLMAP model, expected cameras, images and points3D, all three .bin or "
                     ".txt");
  }
  const ColmapFiles files =
      HasFiles(folder, ".bin") ? ReadColmapBinaryFiles(folder) : ReadColmapTextFiles(folder);
  for (const auto& [id, image] : files.model.images) RequireReferencesOfImage(files, id, image);
  for (const auto& [id, point] : files.model.points) RequireReferencesOfPoint(files, id, point);
  return files.model;
}

}  // namespace insitu
