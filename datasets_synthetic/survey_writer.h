// SPDX-License-Identifier: GPL-3.0-or-later
// The surveyor's files of a site folder, with the noise of real measurements.
#pragma once

#include <filesystem>
#include <vector>

#include "datasets_synthetic/field_survey.h"
#include "datasets_synthetic/made_site.h"
#include "datasets_synthetic/sample_choice.h"
#include "datasets_synthetic/spectral_light.h"

namespace insitu::demo {

struct MeasuringNoise {
  double control_m = 0.005;  // sigma of each coordinate
  double mark_px = 0.3;      // sigma of each pixel coordinate
};

// control_points.csv and observations.csv into `folder`.
void WriteMeasurements(const std::filesystem::path& folder, const Site& site,
                       const FieldSurvey& survey, const MeasuringNoise& noise);

// polygons.json; `best_views` as BestViews gives it.
void WritePolygons(const std::filesystem::path& path, const Site& site,
                   const std::vector<int>& best_views);

void WriteDirections(const std::filesystem::path& path, const FieldSurvey& survey);

void WriteSamples(const std::filesystem::path& path, const Site& site, const ChosenSamples& samples,
                  const Daylight& daylight);

// survey/materials.json: matt, but for panes and water.
void WriteNaturalMaterials(const std::filesystem::path& path, const Site& site);

// site.json: place, time and film.
void WriteSiteDescription(const std::filesystem::path& path, const Site& site);

}  // namespace insitu::demo
