// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_worker.h"

#include <filesystem>
#include <utility>

#include "calibration/files/error.h"
#include "reconstruction/survey/read_survey.h"
#include "renderer/live/live_lenses.h"

namespace insitu {

LiveWorker::LiveWorker(SitePaths site) : site_(std::move(site)), linear_(site_) {}

void LiveWorker::ForgetStages() {
  has_lenses_ = false;
  building_.reset();
}

LiveState LiveWorker::Adjust(int revision) {
  if (!has_lenses_) photos_ = ReadLivePhotos(site_);
  has_lenses_ = true;
  std::vector<std::string> names;
  for (const LivePhoto& photo : photos_) names.push_back(photo.name);
  SurveySoFar read = ReadSurveySoFar(site_, names);
  LiveState state;
  for (const InputError& fault : read.faults) state.file_faults.emplace_back(fault.what());
  state.result = SolveLive({.survey = std::move(read.survey),
                            .photos = photos_,
                            .last_poses = poses_,
                            .site = ReadLiveSite(site_)});
  if (!state.result.poses.empty()) poses_ = state.result.poses;
  state.result.message["type"] = "adjusted";
  state.result.message["revision"] = revision;
  return state;
}

void LiveWorker::AddLight(int revision, LiveState* state) {
  state->is_lit = true;
  if (!state->result.scene) return;
  state->light = LiveLight(site_, *state->result.scene, linear_, &state->environment);
  if (state->light.isNull()) return;
  state->light["type"] = "light";
  state->light["revision"] = revision;
}

void LiveWorker::AddBuilding(LiveState* state) {
  if (!state->result.scene) return;
  try {
    if (!building_ && std::filesystem::exists(site_.artificial())) {
      building_ = ReadBuildingWireframe(site_);
    }
    if (building_) state->building = LiveBuilding(*building_, *state->result.scene);
  } catch (const InputError& error) {
    state->file_faults.emplace_back(error.what());
  }
  if (!state->building.isNull()) state->building["type"] = "building";
}

}  // namespace insitu
