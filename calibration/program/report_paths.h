// SPDX-License-Identifier: GPL-3.0-or-later
// Where reports lie that one stage writes and others look into: JSON, with its page beside it.
#pragma once

#include "calibration/program/site.h"

namespace insitu {

// Of the measurement of light.
inline std::filesystem::path LightReportPath(const SitePaths& site) {
  return site.root / "work/light/report.json";
}
inline std::filesystem::path LightPagePath(const SitePaths& site) {
  return LightReportPath(site).replace_extension(".html");
}

}  // namespace insitu
