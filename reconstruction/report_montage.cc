// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/json_file.h"
#include "reconstruction/report_sections.h"

namespace insitu {

Json::Value MontageSection(const std::vector<ProjectedPoint>& points) {
  Json::Value json(Json::arrayValue);
  for (const ProjectedPoint& projected : points) {
    Json::Value point;
    point["name"] = projected.name;
    point["position"] = ToJson(Eigen::VectorXd(projected.position));
    point["views"] = Json::Value(Json::arrayValue);
    for (const ProjectedPoint::View& seen : projected.views) {
      Json::Value view;
      view["photo"] = seen.photo;
      view["pixel"] = ToJson(Eigen::VectorXd(seen.pixel));
      view["sigma_major_px"] = seen.sigma_major_px;
      view["sigma_minor_px"] = seen.sigma_minor_px;
      view["sigma_mm"] = seen.sigma_mm;
      point["views"].append(view);
    }
    json.append(point);
  }
  return json;
}

}  // namespace insitu
