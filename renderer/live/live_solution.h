// SPDX-License-Identifier: GPL-3.0-or-later
// What the marks made so far say: the message `adjusted` to the page.
#pragma once

#include <json/value.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/files/sentence.h"
#include "calibration/lens/camera.h"
#include "calibration/lens/photo_lens.h"
#include "calibration/lens/rigid3.h"
#include "reconstruction/adjustment/adjustment_options.h"
#include "reconstruction/adjustment/solve_survey.h"
#include "reconstruction/geometry/scene_geometry.h"
#include "reconstruction/survey/survey.h"
#include "renderer/live/live_sun.h"

namespace insitu {

// A photograph with its lens, if that is known yet.
struct LivePhoto {
  std::string name;
  std::optional<Camera> camera;
  PhotoLens lens = {};
  Sentence no_lens_because = {};  // where there is no camera: what to do
};

struct LiveInput {
  Survey survey;
  std::vector<LivePhoto> photos;
  AdjustmentOptions options = {};
  std::map<std::string, Rigid3> last_poses = {};  // of the last LiveResult
  std::optional<LiveSite> site = {};
};

struct LiveResult {
  Json::Value message;                         // without type and revision
  std::vector<PosedCamera> cameras;            // oriented photos only
  std::map<std::string, Rigid3> poses;         // of these, for the next time
  std::optional<SceneGeometry> scene;          // as the adjustment hands it on; nullopt likewise
  std::shared_ptr<const SolvedSurvey> solved;  // for derived_quantity.h; null: nothing is adjusted
};

// Adjusts what is determined and tells what is not, and why. Throws nothing for any survey that
// ReadSurvey returns: contradictions are `failed`, `left_out` and `diagnoses`. `found`, if given,
// is called once with the result's scene, while the message is still to be made.
using SceneFound = std::function<void(const std::optional<SceneGeometry>& scene)>;
LiveResult SolveLive(const LiveInput& input, const SceneFound& found = {});

// The message alone.
Json::Value LiveSolution(const LiveInput& input);

}  // namespace insitu
