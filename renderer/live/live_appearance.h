// SPDX-License-Identifier: GPL-3.0-or-later
// What follows from an adjusted scene and takes longer than the adjustment: the planned building
// over the photographs and the light, in a thread of their own, so that a mark never waits for
// them.
#pragma once

#include <json/value.h>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "calibration/files/sentence.h"
#include "calibration/program/site.h"
#include "renderer/live/live_building.h"
#include "renderer/live/live_light.h"

namespace insitu {

struct LiveAppearance {
  int serial = 0;               // of the adjustment whose light it holds
  Json::Value light, building;  // messages; the light's has a revision and, of no samples, no more
  std::shared_ptr<const NaturalEnvironment> environment;  // what `light` tells of; null: nothing
  Sentence building_fault;                                // why there is no building
};

// A scene of which that is to be told; `scene` is null where nothing is adjusted.
struct AppearanceOrder {
  int serial = 0, revision = 0;
  std::optional<SceneGeometry> scene;
};

class AppearanceThread {
 public:
  // `tell` is called from the thread, once the building is known and once the light is, each time
  // with both: what is not known anew is that of the order before.
  using Tell = std::function<void(const LiveAppearance& appearance, const Json::Value& message)>;
  AppearanceThread(const SitePaths& site, Tell tell);
  ~AppearanceThread();

  // What was ordered before and is not begun yet is not told.
  void Order(AppearanceOrder order);
  // The building may be another one now: a stage has run.
  void ForgetBuilding();
  void Stop();

 private:
  void Work(const std::stop_token& stop);
  void Building(const AppearanceOrder& order);
  struct Lit {
    Json::Value message;
    std::shared_ptr<const NaturalEnvironment> environment;
  };
  Lit LightOf(const AppearanceOrder& order);  // beside Building
  void TellLight(const AppearanceOrder& order, Lit lit);

  const SitePaths site_;
  const Tell tell_;
  LinearPhotos linear_;  // the light's
  // The thread's.
  std::optional<BuildingWireframe> building_;
  LiveAppearance last_;

  std::mutex mutex_;
  std::condition_variable_any ordered_;
  std::optional<AppearanceOrder> order_;
  bool forgets_building_ = false;
  std::jthread thread_;
};

}  // namespace insitu
