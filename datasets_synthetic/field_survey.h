// SPDX-License-Identifier: GPL-3.0-or-later
// Which points a surveyor would measure on the site, and where each photograph shows them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "datasets_synthetic/made_site.h"

namespace insitu::demo {

struct Mark {
  int view = 0;           // index into Site::views
  Eigen::Vector2d pixel;  // without noise
};

enum class PointRole { kMarked, kControl, kCheck };

struct SurveyPoint {
  std::string name;
  Eigen::Vector3d position;  // site frame, without noise
  std::vector<Mark> marks;   // only where the photograph really shows it
  PointRole role = PointRole::kMarked;
};

using NamePair = std::pair<std::string, std::string>;

struct FieldSurvey {
  std::vector<SurveyPoint> points;
  std::vector<NamePair> sun_pairs;     // object point, its shadow
  std::vector<NamePair> zenith_pairs;  // bottom, top
};

// Whether a view shows a point of the scene, at least 2 px inside the frame, by ray tracing.
bool Shows(const Site& site, const View& view, const Eigen::Vector3d& point);

// Vertices, targets and shadow points. Surveyed as control: what fewer than two photographs show,
// what is too far for them to intersect, and the targets.
FieldSurvey SurveySite(const Site& site);

}  // namespace insitu::demo
