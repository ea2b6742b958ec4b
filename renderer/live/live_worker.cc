// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_worker.h"

#include <utility>

#include "reconstruction/survey/read_survey.h"
#include "renderer/live/live_lenses.h"

namespace insitu {

LiveWorker::LiveWorker(SitePaths site) : site_(std::move(site)) {}

void LiveWorker::ForgetStages() { has_lenses_ = false; }

LiveState LiveWorker::Adjust(
    int revision,
    const std::function<void(int serial, const std::optional<SceneGeometry>&)>& found) {
  if (!has_lenses_) photos_ = ReadLivePhotos(site_);
  has_lenses_ = true;
  std::vector<std::string> names;
  for (const LivePhoto& photo : photos_) names.push_back(photo.name);
  SurveySoFar read = ReadSurveySoFar(site_, names);
  LiveState state;
  state.serial = ++serial_;
  state.file_faults = std::move(read.faults);
  state.result = SolveLive({.survey = std::move(read.survey),
                            .photos = photos_,
                            .last_poses = poses_,
                            .site = ReadLiveSite(site_)},
                           [&](const auto& scene) { found(state.serial, scene); });
  if (!state.result.poses.empty()) poses_ = state.result.poses;
  state.result.message["type"] = "adjusted";
  state.result.message["revision"] = revision;
  return state;
}

}  // namespace insitu
