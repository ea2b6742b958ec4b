// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_appearance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <vector>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::ElementsAre;

// Who orders does not wait, and of what was ordered meanwhile only the last is told.
TEST(AppearanceThread, TellsTheFirstAndTheLastOfOrdersThatComeWhileItIsBusy) {
  const ScratchFolder folder;
  SitePaths site;
  site.root = folder.path();
  std::vector<std::pair<int, int>> told;  // serial, revision
  std::promise<void> begun, released, ended;
  AppearanceThread thread(site, [&](const LiveAppearance& now, const Json::Value& message) {
    EXPECT_EQ(message["type"], "light");
    told.emplace_back(now.serial, message["revision"].asInt());
    if (now.serial == 3) ended.set_value();
    if (now.serial != 1) return;
    begun.set_value();
    released.get_future().wait();
  });
  thread.Order({1, 10, std::nullopt});
  begun.get_future().wait();
  thread.Order({2, 20, std::nullopt});
  thread.Order({3, 30, std::nullopt});
  released.set_value();
  EXPECT_EQ(ended.get_future().wait_for(std::chrono::minutes(1)), std::future_status::ready);
  thread.Stop();
  EXPECT_THAT(told, ElementsAre(std::pair(1, 10), std::pair(3, 30)));
}

}  // namespace
}  // namespace insitu
