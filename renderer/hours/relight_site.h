// SPDX-License-Identifier: GPL-3.0-or-later
// A site at another hour, as files that a render reads as it reads those of its own hour.
#pragma once

#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "renderer/hours/site_hour.h"

namespace insitu {

struct RelitSite {
  SiteHour hour;
  double aerosol_depth = 0;
  std::string statement;  // what delivered pictures say of it
  int photos = 0;
};

// work/hours/<name>/: input_images/ and photos/ relit, and at last environment.json, with
// "simulation" beside what the measured one has. Throws InputError as SiteHourAt does, and where
// the site's own environment or images are missing.
RelitSite RelightSite(const SitePaths& site, const HourRequest& request);

}  // namespace insitu
