// SPDX-License-Identifier: GPL-3.0-or-later
// live_feedback_speed SITE: what the adjustment, the building and the light after a changed mark
// cost, the page left out.
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>

#include "renderer/live/live_building.h"
#include "renderer/live/live_light.h"
#include "renderer/live/live_worker.h"

namespace insitu {
namespace {

constexpr int kTimes = 6;

void Time(const char* what, const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
  work();
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  std::printf("  %-12s %7.1f ms, of the processors %7.1f ms\n", what, time.count(),
              1000.0 * static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC);
}

void Measure(const SitePaths& site) {
  LiveWorker worker(site);
  LinearPhotos photos(site);
  const bool has_building = std::filesystem::exists(site.artificial());
  const BuildingWireframe building =
      has_building ? ReadBuildingWireframe(site) : BuildingWireframe();
  for (int i = 0; i < kTimes; ++i) {
    LiveState state;
    Time("adjustment", [&] { state = worker.Adjust(i, [](int, const auto&) {}); });
    if (!state.result.scene) return;
    Time("building", [&] { LiveBuilding(building, *state.result.scene); });
    Time("light", [&] { LiveLight(site, *state.result.scene, photos); });
  }
}

}  // namespace
}  // namespace insitu

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) insitu::Measure(insitu::SitePaths{argv[i]});
}
