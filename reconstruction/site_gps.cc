// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/site_gps.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "calibration/files/json_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/exif.h"
#include "reconstruction/geometry/coordinate_system.h"

namespace insitu {
namespace {

bool HasOwnDatum(const Survey& survey) {
  return !survey.camera_positions.empty() ||
         std::ranges::any_of(survey.control_points, [](const ControlPoint& point) {
           return point.role == ControlRole::kControl;
         });
}

Eigen::Vector3d LeverArm(const SitePaths& site) {
  if (!std::filesystem::exists(site.description())) return Eigen::Vector3d::Zero();
  const auto arm = JsonNode::Load(site.description()).Find("gps_lever_arm_m");
  return arm ? arm->Vector3() : Eigen::Vector3d::Zero();
}

std::string RemarkOf(const GpsPositions& gps, size_t photos, size_t stated,
                     const Eigen::Vector3d& arm) {
  const Eigen::Vector3d& sigma = gps.positions[0].sigma;
  std::string text = "no control: the satellite positions of " +
                     std::to_string(gps.positions.size()) + " of " + std::to_string(photos) +
                     " photos are observed, in " + gps.system + ", heights as stated, sigma " +
                     Formatted("%.2g, %.2g, %.2g m", sigma.x(), sigma.y(), sigma.z());
  text += stated == 0 ? ", which no photo states" : " of the first, as the photos state";
  if (stated > 0 && stated < gps.positions.size()) text += " (not all)";
  if (arm.isZero()) text += "; the antenna is taken to be at the lens";
  return text + "; receivers err alike within minutes, so position is known no better than one is";
}

}  // namespace

GpsPositions FindGpsPositions(const SitePaths& site, const SitePhotos& photos,
                              const Survey& survey) {
  GpsPositions gps;
  if (HasOwnDatum(survey)) return gps;
  const Eigen::Vector3d arm = LeverArm(site);
  std::optional<CoordinateConversion> conversion;
  size_t stated = 0;
  for (size_t i = 0; i < photos.paths.size(); ++i) {
    const auto exif = ReadExifPosition(photos.paths[i]);
    if (!exif) continue;
    if (!conversion) {
      const CoordinateSystem zone = CoordinateSystem::UtmZone(exif->longitude, exif->latitude);
      gps.system = zone.name();
      conversion.emplace(*CoordinateSystem::FromText("EPSG:4326"), zone);
    }
    const auto plan = (*conversion)({exif->longitude, exif->latitude});
    if (!plan) continue;
    stated += exif->is_sigma_stated ? 1 : 0;
    gps.positions.push_back({photos.names[i],
                             {plan->x(), plan->y(), exif->altitude},
                             exif->sigma_m,
                             PositionRole::kWeighted,
                             {photos.paths[i], 0},
                             arm});
  }
  if (!gps.positions.empty()) gps.remark = RemarkOf(gps, photos.paths.size(), stated, arm);
  return gps;
}

}  // namespace insitu
