// SPDX-License-Identifier: GPL-3.0-or-later
// What a batch is to make: views x variants x hours x qualities, in a JSON file that a person
// writes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "renderer/hours/site_hour.h"

namespace insitu {

// An hour as the plan names it; of neither time nor sun: that of the photographs.
struct PlannedHour {
  HourRequest request = {};
  bool is_measured() const { return request.time.empty() && !request.sun; }
};

// {
//   "site": "../gallery",                  folder, from the plan's; missing: the plan's own
//   "views": ["IMG_1"],                    missing: every photograph
//   "variants": ["building", "tower"],     "building" is the folder building/; missing: that alone
//   "hours": ["measured", "16:30", "2024-12-21T12:00", {"azimuth_deg": 180, "elevation_deg": 30}],
//   "qualities": ["draft", "final", "avr1"],  missing: final; avr0 to avr2: as --avr of
//   insitu-render "options": ["--grain"]                 of insitu-render, for all jobs
// }
struct BatchPlan {
  std::filesystem::path file;
  SitePaths site;
  std::vector<std::string> views, qualities;
  std::vector<std::string> variants;  // as SitePaths has them: "" is building/
  std::vector<PlannedHour> hours;
  std::vector<std::string> options;

  std::string name() const { return file.stem().string(); }
  std::filesystem::path folder() const { return site.root / "work/batch" / name(); }
  // The contact sheet.
  std::filesystem::path sheet() const { return site.montages() / (name() + ".sheet.html"); }
};

// Throws InputError at the plan's line: no JSON, an unknown key, an empty list, something named
// twice, no such site, view, variant or quality, no time.
BatchPlan ReadBatchPlan(const std::filesystem::path& file);

}  // namespace insitu
