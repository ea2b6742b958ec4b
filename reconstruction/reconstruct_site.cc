// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/reconstruct_site.h"

#include <algorithm>
#include <utility>

#include "calibration/files/json_file.h"
#include "calibration/files/sha256.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/distinct_photographs.h"
#include "calibration/photo/photo_thumbnail.h"
#include "reconstruction/adjustment/adjust.h"
#include "reconstruction/adjustment/find_start_values.h"
#include "reconstruction/report/input_files.h"
#include "reconstruction/report/large_report.h"
#include "reconstruction/report/montage_points.h"
#include "reconstruction/report/residual_csv.h"
#include "reconstruction/report/residual_page.h"
#include "reconstruction/report/residual_report.h"
#include "reconstruction/site_gps.h"
#include "reconstruction/site_photos.h"
#include "reconstruction/site_sun.h"
#include "reconstruction/survey/read_survey.h"

namespace insitu {
namespace {

constexpr double kSlips = 0.05;  // of a photo's marks: more outside are no slips of the pen

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

CameraContext ContextOfCamera(const SitePaths& site, const std::string& camera) {
  CameraContext context;
  context.model_file = site.camera(camera).lexically_relative(site.root).generic_string();
  context.calibrated_region = ReadCalibratedRegion(site.camera(camera));
  if (std::filesystem::exists(site.calibration_report(camera))) {
    context.calibration = ReadJson(site.calibration_report(camera));
  }
  return context;
}

ReportContext SiteContext(const SitePaths& site, const SitePhotos& photos,
                          const AdjustmentOptions& options, const Adjustment& adjustment,
                          const std::optional<TiePoints>& tie_points) {
  ReportContext context;
  context.options = options;
  context.inputs = HashInputs(site, photos.site_cameras);
  for (size_t i = 0; i < adjustment.poses.size(); ++i) {
    context.cameras.try_emplace(adjustment.poses[i].camera,
                                ContextOfCamera(site, photos.site_cameras[i]));
  }
  if (tie_points && !tie_points->program.empty()) {
    context.programs[tie_points->program] = tie_points->program_version;
  }
  const ReportExtent extent = ExtentOf(adjustment);
  for (size_t i = 0; i < photos.paths.size(); ++i) {
    if (!extent.photos_in_full.contains(photos.names[i])) continue;
    const auto thumbnail = PhotoThumbnail(photos.paths[i]);
    if (thumbnail) context.thumbnails[photos.names[i]] = *thumbnail;
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

// Lenses that the adjustment changed; without any, those of an earlier run go.
void WriteAdjustedLenses(const SitePaths& site, const SitePhotos& photos,
                         const Adjustment& adjustment, bool is_self_calibrating) {
  std::filesystem::remove_all(site.adjusted_camera().parent_path());
  if (!is_self_calibrating) return;
  for (size_t i = 0; i < adjustment.poses.size(); ++i) {
    const std::string& camera = adjustment.cameras[adjustment.poses[i].camera].name;
    WritePosedCamera(site.adjusted_camera(photos.site_cameras[i]),
                     {camera, adjustment.scene.cameras[i].camera, Rigid3()},
                     "lens adjusted by insitu-reconstruct --self-calibrate");
  }
}

// What the almanac says to the sun that was measured, for the report; a warning where they differ.
std::optional<Json::Value> CheckSun(const SitePaths& site, const SitePhotos& photos,
                                    const Survey& survey, Adjustment* adjustment) {
  const SceneGeometry& scene = adjustment->scene;
  const auto circumstances = SunCircumstancesOf(site, photos, survey);
  if (!circumstances || !scene.sun) return std::nullopt;
  const auto verdict = JudgeSun(*scene.sun, scene.zenith, *circumstances);
  if (!verdict) return std::nullopt;
  if (!verdict->agrees) adjustment->warnings.push_back(verdict->message);
  return verdict->ToJson();
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

Adjustment ReconstructSite(const SitePaths& site, const AdjustmentOptions& options,
                           const std::filesystem::path& start_poses, const std::string& command) {
  const SitePhotos site_photos = ReadSitePhotos(site);
  const std::vector<std::string>& photos = site_photos.names;
  const auto tie_points = TiePointsOf(site, photos);
  Survey survey =
      ReadSurvey(site, photos, tie_points ? SurveyFolder::kOptional : SurveyFolder::kRequired);
  survey.tie_points = tie_points;
  // A fault of input is told before the photographs are read.
  RequireMarksOnPhotographs(survey, photos, site_photos.cameras, kSlips);
  const GpsPositions gps = FindGpsPositions(site, site_photos, survey);
  survey.camera_positions.insert(survey.camera_positions.end(), gps.positions.begin(),
                                 gps.positions.end());
  RequireSizes(site_photos.paths, site_photos.cameras);
  RequireDistinctPhotographs(site_photos.paths);
  std::map<std::string, Rigid3> estimates;
  if (!start_poses.empty()) estimates = ReadStartPoses(start_poses, photos);
  Adjustment adjustment =
      Adjust(survey, photos, site_photos.cameras, options, site_photos.lenses, estimates);
  if (!gps.remark.empty()) adjustment.warnings.push_back(gps.remark);
  const std::optional<Json::Value> sun = CheckSun(site, site_photos, survey, &adjustment);
  ReportContext context = SiteContext(site, site_photos, options, adjustment, tie_points);
  context.command = command;
  context.start_estimates = static_cast<int>(estimates.size());
  if (!start_poses.empty()) {
    context.inputs.push_back({"--start " + start_poses.filename().string(), Sha256(start_poses)});
  }
  Json::Value report = ResidualReport(adjustment, survey, context);
  if (sun) report["sun_check"] = *sun;
  const std::string page = ResidualPage(report);
  WriteSceneGeometry(site, adjustment.scene);
  WriteAdjustedLenses(site, site_photos, adjustment, options.is_self_calibrating);
  WriteJson(site.residual_report(), report);
  WriteWhole(site.residual_page(), page);
  WriteWhole(site.observations_csv(), ObservationsCsv(adjustment));
  WriteWhole(site.points_csv(), PointsCsv(adjustment));
  return adjustment;
}

}  // namespace insitu
