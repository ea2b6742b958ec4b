// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/report_montage.h"

#include "calibration/files/json_file.h"
#include "reconstruction/geometry/projection_uncertainty.h"

namespace insitu {
namespace {

Json::Value ViewReport(const std::string& photo, const ImageUncertainty& seen) {
  Json::Value json;
  json["photo"] = photo;
  json["pixel"] = ToJson(Eigen::VectorXd(seen.pixel));
  json["covariance_px2"] = ToJson(Eigen::MatrixXd(seen.covariance_px));
  json["sigma_major_px"] = seen.major_px;
  json["sigma_minor_px"] = seen.minor_px;
  json["sigma_mm"] = 1000 * seen.major_m;  // of the major axis, at the point's distance
  return json;
}

}  // namespace

Json::Value MontageSection(const Adjustment& adjustment, const std::vector<MontagePoint>& points) {
  const SceneGeometry& scene = adjustment.scene;
  Json::Value json(Json::arrayValue);
  for (const MontagePoint& given : points) {
    Json::Value point;
    point["name"] = given.name;
    point["position"] = ToJson(Eigen::VectorXd(given.position));
    point["views"] = Json::Value(Json::arrayValue);
    for (size_t i = 0; i < scene.camera_covariances.size(); ++i) {
      const auto seen =
          ProjectWithUncertainty(scene.cameras[i], scene.camera_covariances[i], given.position);
      if (seen) point["views"].append(ViewReport(scene.cameras[i].photo, *seen));
    }
    json.append(point);
  }
  return json;
}

}  // namespace insitu
