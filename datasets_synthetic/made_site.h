// SPDX-License-Identifier: GPL-3.0-or-later
// A place before anything is built, how it is photographed, and what is measured there.
#pragma once

#include <Eigen/Core>
#include <set>
#include <string>
#include <vector>

#include "datasets_synthetic/lens.h"
#include "datasets_synthetic/plan.h"
#include "datasets_synthetic/scene.h"
#include "datasets_synthetic/water.h"

namespace insitu::demo {

// What site.json says of place and time.
struct SiteRecord {
  std::string name, local_time, sky;
  double latitude = 0, longitude = 0;  // [deg]
};

// What a surveyor picks, by name.
struct SurveyPlan {
  std::set<std::string> check_points;
  std::set<std::string> control_points;     // besides targets and what lies far away
  std::vector<std::string> upright_boxes;   // whose edges show the zenith
  std::string level;                        // the face that the paper measures haze on
  std::set<std::string> matt;               // those that are better for it, if that one mirrors
  std::string shadows;                      // the face that shadows are measured on
  Material daylight = Material::kConcrete;  // that samples of the light are taken on
};

// All in the site frame; survey coordinates are origin + site coordinates.
struct Site {
  SiteRecord record;
  SurveyPlan survey;
  Eigen::Vector3d origin;           // [m], survey coordinates of the site frame's origin
  double azimuth = 0;               // [rad], of the plan's x axis about z, from the survey's x axis
  Eigen::Vector3d zenith;           // unit, 0.3 degrees off z
  bool has_sun = true;              // false: overcast, `sun` means nothing
  Eigen::Vector3d sun;              // unit, towards the sun
  Eigen::Vector3d true_north;       // unit
  Scene natural;                    // all that is surveyed
  Scene blockers;                   // the same without level ground, which shades nothing
  Scene scenery;                    // far ground and hills: seen, not surveyed, too far to shade
  std::vector<NamedPoint> targets;  // survey targets on the ground
  std::vector<View> views;
  Waves waves;  // of its water
};

}  // namespace insitu::demo
