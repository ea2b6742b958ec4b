// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/colmap_subset.h"

namespace insitu {
namespace {

size_t ImagesOf(const ColmapPoint& point) {
  std::set<uint32_t> images;
  for (const ColmapTrackElement& element : point.track) images.insert(element.image);
  return images.size();
}

}  // namespace

void KeepImages(const std::set<uint32_t>& ids, ColmapModel* model) {
  std::erase_if(model->images, [&](const auto& image) { return !ids.contains(image.first); });
  std::set<uint32_t> cameras;
  for (const auto& [id, image] : model->images) cameras.insert(image.camera);
  std::erase_if(model->cameras,
                [&](const auto& camera) { return !cameras.contains(camera.first); });
  for (auto& [id, point] : model->points) {
    std::erase_if(point.track, [&](const auto& element) { return !ids.contains(element.image); });
  }
  std::erase_if(model->points, [](const auto& point) { return ImagesOf(point.second) < 2; });
  for (auto& [id, image] : model->images) {
    for (ColmapKeypoint& keypoint : image.keypoints) {
      if (keypoint.point && !model->points.contains(*keypoint.point)) keypoint.point.reset();
    }
  }
}

}  // namespace insitu
