// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/reconstruct_site.h"

#include <algorithm>
#include <utility>

#include "calibration/json_file.h"
#include "calibration/site_cameras.h"
#include "calibration/whole_file.h"
#include "reconstruction/residual_report.h"

namespace insitu {
namespace {

Rigid3 Upright(const Eigen::Vector3d& center, const Eigen::Vector3d& forward) {
  const Eigen::Vector3d up = std::abs(forward.normalized().z()) < 0.999 ? Eigen::Vector3d::UnitZ()
                                                                        : Eigen::Vector3d::UnitY();
  Eigen::Matrix3d cam_from_world;
  cam_from_world.row(2) = forward.normalized();
  cam_from_world.row(0) = forward.cross(up).normalized();
  cam_from_world.row(1) = cam_from_world.row(2).cross(cam_from_world.row(0));
  const Eigen::Quaterniond rotation(cam_from_world);
  return {rotation, -(rotation * center)};
}

}  // namespace

std::map<std::string, Rigid3> ReadStartPoses(const std::filesystem::path& path,
                                             const std::vector<std::string>& photos) {
  std::map<std::string, Rigid3> poses;
  for (const auto& [photo, node] : JsonNode::Load(path).Members()) {
    if (std::find(photos.begin(), photos.end(), photo) == photos.end()) {
      throw node.Error("photo '" + photo + "' is not in the folder photos");
    }
    const Eigen::Vector3d center = node.At("center").Vector3();
    const Eigen::Vector3d forward = node.At("look_at").Vector3() - center;
    if (forward.norm() == 0) throw node.Error("expected a look_at other than the center");
    poses[photo] = Upright(center, forward);
  }
  return poses;
}

Adjustment ReconstructSite(const SitePaths& site, AdjustmentOptions options,
                           const std::filesystem::path& start_poses) {
  const std::vector<std::filesystem::path> paths = ListPhotographs(site);
  std::vector<std::string> photos;
  std::vector<Camera> cameras;
  for (const std::string& camera : CamerasOfPhotos(site, paths)) {
    photos.push_back(paths[photos.size()].stem().string());
    RequireResult(site.camera(camera), "insitu-calibrate");
    cameras.push_back(ReadCamera(site.camera(camera)));
  }
  const Survey survey = ReadSurvey(site, photos);
  if (!start_poses.empty()) options.initial_cam_from_world = ReadStartPoses(start_poses, photos);
  Adjustment adjustment = Adjust(survey, photos, cameras, options);
  const Json::Value report = ResidualReport(adjustment, survey);
  const std::string page = ResidualPage(report);
  WriteSceneGeometry(site, adjustment.scene);
  WriteJson(site.residual_report(), report);
  WriteWhole(site.residual_page(), page);
  return adjustment;
}

}  // namespace insitu
