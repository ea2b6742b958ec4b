// SPDX-License-Identifier: GPL-3.0-or-later
// From the survey's files to what the page is told of them: adjustment, light, the building.
#pragma once

#include <json/value.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "renderer/live/live_building.h"
#include "renderer/live/live_light.h"
#include "renderer/live/live_solution.h"

namespace insitu {

// The newest results.
struct LiveState {
  LiveResult result;            // its message holds type and revision
  Json::Value light, building;  // messages, maybe null
  bool is_lit = false;          // false: light and building are still to come
  std::shared_ptr<const NaturalEnvironment> environment;  // what `light` tells of; null: nothing
  std::vector<std::string> file_faults;                   // files that took no part
};

// Not safe for several threads at once.
class LiveWorker {
 public:
  explicit LiveWorker(SitePaths site);

  // Lenses and the building may be others now: a stage has run.
  void ForgetStages();

  // What the files say as they stand. Throws nothing for their content.
  LiveState Adjust(int revision);
  // Then the light and the building of the same scene, which take longer.
  void AddLight(int revision, LiveState* state);
  void AddBuilding(LiveState* state);

 private:
  SitePaths site_;
  LinearPhotos linear_;
  std::vector<LivePhoto> photos_;
  bool has_lenses_ = false;
  std::optional<BuildingWireframe> building_;
  std::map<std::string, Rigid3> poses_;
};

}  // namespace insitu
