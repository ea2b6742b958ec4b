// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/reconstruct_site.h"

#include <algorithm>
#include <utility>

#include "calibration/json_file.h"
#include "calibration/whole_file.h"
#include "reconstruction/input_files.h"
#include "reconstruction/montage_points.h"
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

ReportContext SiteContext(const SitePaths& site, const AdjustmentOptions& options,
                          const Adjustment& adjustment, const std::string& command) {
  ReportContext context;
  context.options = options;
  context.command = command;
  context.inputs = HashInputs(site);
  if (std::filesystem::exists(site.calibration_report())) {
    context.calibration = ReadJson(site.calibration_report());
  }
  const std::vector<Eigen::Vector2d> region = ReadCalibratedRegion(site.camera());
  for (size_t i = 0; i < adjustment.cameras.size() && !region.empty(); ++i) {
    context.calibrated_region[static_cast<int>(i)] = region;
  }
  context.montage = MontagePoints(site, adjustment.scene);
  return context;
}

// Throws InputError if they are those of other photographs.
std::optional<TiePoints> TiePointsOf(const SitePaths& site,
                                     const std::vector<std::string>& photos) {
  const auto tie_points = ReadTiePoints(site);
  if (!tie_points) return std::nullopt;
  for (const auto& [photo, pose] : tie_points->cam_from_model) {
    if (std::find(photos.begin(), photos.end(), photo) != photos.end()) continue;
    throw InputError(site.tie_points(), "photo '" + photo +
                                            "' is not in the folder photos, expected the tie "
                                            "points of these: run insitu-tie-points again");
  }
  return tie_points;
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
                           const std::filesystem::path& start_poses, const std::string& command) {
  std::vector<std::string> photos;
  for (const auto& path : ListPhotographs(site)) photos.push_back(path.stem().string());
  RequireResult(site.camera(), "insitu-calibrate");
  const std::vector<Camera> cameras(photos.size(), ReadCamera(site.camera()));
  const auto tie_points = TiePointsOf(site, photos);
  Survey survey =
      ReadSurvey(site, photos, tie_points ? SurveyFiles::kOptional : SurveyFiles::kRequired);
  survey.tie_points = tie_points;
  if (!start_poses.empty()) options.initial_cam_from_world = ReadStartPoses(start_poses, photos);
  Adjustment adjustment = Adjust(survey, photos, cameras, options);
  const Json::Value report =
      ResidualReport(adjustment, survey, SiteContext(site, options, adjustment, command));
  const std::string page = ResidualPage(report);
  WriteSceneGeometry(site, adjustment.scene);
  WriteJson(site.residual_report(), report);
  WriteWhole(site.residual_page(), page);
  WriteWhole(site.observations_csv(), ObservationsCsv(adjustment));
  WriteWhole(site.points_csv(), PointsCsv(adjustment));
  return adjustment;
}

}  // namespace insitu
