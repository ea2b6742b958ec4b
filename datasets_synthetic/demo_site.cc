// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/demo_site.h"

#include "datasets_synthetic/campus.h"
#include "datasets_synthetic/pavilion.h"

namespace insitu::demo {

SiteSummary MakeDemoSite(const std::filesystem::path& folder, const SiteOptions& options) {
  const Site campus = MakeCampus(options.width, options.height);
  return WriteSite(folder, {campus, MakePavilion(campus.azimuth), ClearMorning()}, options);
}

}  // namespace insitu::demo
