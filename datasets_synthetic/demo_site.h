// SPDX-License-Identifier: GPL-3.0-or-later
// A complete site folder with known truth: the demo of README.md and the end-to-end tests.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace insitu::demo {

struct DemoSiteOptions {
  int width = 960, height = 640;  // [px], of photographs and board photographs
  int strata = 12;                // squared: directions that light comes from; for 3 x 3 pixels
  bool with_boards = true;
  std::function<void()> step_done;  // called kDemoSiteSteps times, if set
};

inline constexpr int kDemoSiteSteps = 5;

struct DemoSiteSummary {
  int photos = 0, board_photos = 0;
  int control_points = 0, check_points = 0, observations = 0, polygons = 0;
  int sun_pairs = 0, zenith_pairs = 0;
  int horizon_samples = 0, haze_samples = 0, daylight_samples = 0;
  std::string BriefReport() const;
};

// Writes photos/, calibration/, survey/, building/, site.json and truth/ into `folder`. The same
// options give the same bytes. Throws std::runtime_error if it cannot write.
DemoSiteSummary MakeDemoSite(const std::filesystem::path& folder,
                             const DemoSiteOptions& options = {});

}  // namespace insitu::demo
