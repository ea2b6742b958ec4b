// SPDX-License-Identifier: GPL-3.0-or-later
// The demo of README.md and the end-to-end tests: the campus and its pavilion.
#pragma once

#include "datasets_synthetic/site_folder.h"

namespace insitu::demo {

inline constexpr int kDemoSiteSteps = 5;

SiteSummary MakeDemoSite(const std::filesystem::path& folder, const SiteOptions& options = {});

}  // namespace insitu::demo
