// SPDX-License-Identifier: GPL-3.0-or-later
// A complete site folder with known truth.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "datasets_synthetic/building.h"
#include "datasets_synthetic/made_site.h"
#include "datasets_synthetic/spectral_light.h"

namespace insitu::demo {

// All that a site folder is made from.
struct SiteDescription {
  Site site;
  Building building;
  Daylight daylight;
};

struct SiteOptions {
  int width = 960, height = 640;  // [px], of photographs and board photographs
  int strata = 12;                // squared: directions that light comes from; for 3 x 3 pixels
  bool with_boards = true;        // false: the lens is given as a camera file
  bool is_example = false;  // with the finer light that the demo, whose bytes are fixed, lacks
  std::function<void()> step_done;  // called SiteSteps times, if set
};

struct SiteSummary {
  int photos = 0, board_photos = 0;
  int control_points = 0, check_points = 0, observations = 0, polygons = 0;
  int sun_pairs = 0, zenith_pairs = 0;
  int horizon_samples = 0, haze_samples = 0, daylight_samples = 0;
  std::string BriefReport() const;
};

inline int SiteSteps(const Site& site) { return static_cast<int>(site.views.size()) + 2; }

// Writes photos/, calibration/, survey/, building/, site.json and truth/ into `folder`. The same
// description and options give the same bytes. Throws std::runtime_error if it cannot write.
SiteSummary WriteSite(const std::filesystem::path& folder, const SiteDescription& description,
                      const SiteOptions& options);

}  // namespace insitu::demo
