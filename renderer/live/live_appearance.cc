// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_appearance.h"

#include <filesystem>
#include <future>
#include <utility>

#include "calibration/files/error.h"

namespace insitu {

AppearanceThread::AppearanceThread(const SitePaths& site, Tell tell)
    : site_(site), tell_(std::move(tell)), linear_(site) {
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

AppearanceThread::~AppearanceThread() { Stop(); }

void AppearanceThread::Stop() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
}

void AppearanceThread::Order(AppearanceOrder order) {
  const std::lock_guard lock(mutex_);
  order_ = std::move(order);
  ordered_.notify_one();
}

void AppearanceThread::ForgetBuilding() {
  const std::lock_guard lock(mutex_);
  forgets_building_ = true;
}

void AppearanceThread::Work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (ordered_.wait(lock, stop, [&] { return order_.has_value(); })) {
    const AppearanceOrder order = *std::exchange(order_, std::nullopt);
    if (std::exchange(forgets_building_, false)) building_.reset();
    lock.unlock();
    // Both at once: the building takes a tenth of the light's time, but at a moment when the page
    // has the adjustment to draw.
    auto light = std::async(std::launch::async, [&] { return LightOf(order); });
    Building(order);
    TellLight(order, light.get());
    lock.lock();
  }
}

void AppearanceThread::Building(const AppearanceOrder& order) {
  if (!order.scene) return;
  last_.building_fault = {};
  try {
    if (!building_ && std::filesystem::exists(site_.artificial())) {
      building_ = ReadBuildingWireframe(site_);
    }
    last_.building = Json::nullValue;
    if (!building_) return;
    last_.building = LiveBuilding(*building_, *order.scene);
  } catch (const std::exception& error) {
    last_.building_fault = SentenceOf(error);
    return;
  }
  last_.building["type"] = "building";
  tell_(last_, last_.building);
}

AppearanceThread::Lit AppearanceThread::LightOf(const AppearanceOrder& order) {
  Lit lit;
  if (order.scene) lit.message = LiveLight(site_, *order.scene, linear_, &lit.environment);
  return lit;
}

void AppearanceThread::TellLight(const AppearanceOrder& order, Lit lit) {
  last_.light = std::move(lit.message);
  last_.environment = std::move(lit.environment);
  last_.light["type"] = "light";
  last_.light["revision"] = order.revision;
  last_.serial = order.serial;
  tell_(last_, last_.light);
}

}  // namespace insitu
