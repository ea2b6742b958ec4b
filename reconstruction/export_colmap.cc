// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>

#include "calibration/colmap_lens.h"
#include "calibration/error.h"
#include "reconstruction/colmap_model.h"
#include "reconstruction/export_survey.h"

namespace insitu {
namespace {

uint32_t CameraId(const PosedCamera& posed, const std::filesystem::path& folder,
                  ColmapModel* model) {
  const auto lens = ColmapFromCamera(posed.camera);
  if (!lens) {
    throw InputError(folder, "COLMAP has no lens equal to " + posed.camera.lens_model() +
                                 "; export from a site calibrated with LENSMODEL_OPENCV8");
  }
  for (const auto& [id, known] : model->cameras) {
    if (known == *lens) return id;
  }
  const auto id = static_cast<uint32_t>(model->cameras.size() + 1);
  model->cameras.emplace(id, *lens);
  return id;
}

const PosedCamera& Posed(const std::vector<PosedCamera>& cameras, const std::string& photo,
                         const std::filesystem::path& folder) {
  for (const PosedCamera& posed : cameras) {
    if (posed.photo == photo) return posed;
  }
  throw InputError(folder, "photo \"" + photo + "\" is not posed");
}

void AddImages(const std::vector<PosedCamera>& cameras,
               const std::vector<std::filesystem::path>& photographs,
               const std::filesystem::path& folder, ColmapModel* model) {
  uint32_t id = 0;
  for (const std::filesystem::path& photograph : photographs) {
    const PosedCamera& posed = Posed(cameras, photograph.stem().string(), folder);
    model->images[++id] = {photograph.filename().string(), CameraId(posed, folder, model),
                           posed.cam_from_world, {}};
  }
}

// Its mean error, as COLMAP has it; -1 if no photo shows it.
double MeanErrorPx(const ColmapPoint& point, const ColmapModel& model,
                   const std::vector<PosedCamera>& cameras, const std::filesystem::path& folder) {
  double sum = 0;
  int count = 0;
  for (const ColmapTrackElement& element : point.track) {
    const ColmapImage& image = model.images.at(element.image);
    const std::string photo = std::filesystem::path(image.name).stem().string();
    const auto pixel = Posed(cameras, photo, folder)
                           .camera.Project(image.cam_from_world * point.position);
    if (!pixel) continue;
    const Eigen::Vector2d& mark = image.keypoints[element.keypoint].position;
    sum += (ColmapFromPixel(*pixel) - mark).norm();
    ++count;
  }
  return count ? sum / count : -1;
}

}  // namespace

SurveyExport ExportColmap(const Survey& survey, const std::vector<PosedCamera>& cameras,
                          const std::vector<std::filesystem::path>& photographs,
                          const std::filesystem::path& folder) {
  ColmapModel model;
  AddImages(cameras, photographs, folder, &model);
  std::map<std::string, uint32_t> images;
  for (const auto& [id, image] : model.images) {
    images[std::filesystem::path(image.name).stem().string()] = id;
  }
  std::map<std::string, uint64_t> points;
  for (const ControlPoint& point : survey.control_points) {
    const uint64_t id = points.size() + 1;
    points[point.name] = id;
    model.points[id].position = point.position;
  }
  size_t left_out = 0;
  for (const ImageObservation& mark : survey.observations) {
    const auto point = points.find(mark.point);
    if (point == points.end() && ++left_out) continue;
    const uint32_t id = images.at(mark.photo);
    ColmapImage& image = model.images.at(id);
    model.points.at(point->second)
        .track.push_back({id, static_cast<uint32_t>(image.keypoints.size())});
    image.keypoints.push_back({ColmapFromPixel(mark.pixel), point->second});
  }
  std::erase_if(model.points, [](const auto& entry) { return entry.second.track.empty(); });
  for (auto& [id, point] : model.points) {
    point.error_px = MeanErrorPx(point, model, cameras, folder);
  }
  WriteColmapText(folder, model);
  SurveyExport done;
  for (const char* name : {"cameras.txt", "images.txt", "points3D.txt"}) {
    done.written.push_back(folder / name);
  }
  done.report.push_back("sigmas are left out, and nothing tells COLMAP that points are surveyed");
  if (left_out) {
    done.report.push_back(std::to_string(left_out) +
                          " marks of points without coordinates are left out");
  }
  return done;
}

}  // namespace insitu
