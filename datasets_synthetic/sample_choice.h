// SPDX-License-Identifier: GPL-3.0-or-later
// Pixels that a careful person would measure light on, chosen from the finished photographs.
#pragma once

#include <string>
#include <vector>

#include "datasets_synthetic/forward_model.h"

namespace insitu::demo {

struct ChosenPixel {
  int view = 0;
  int x = 0, y = 0;     // [px]
  std::string polygon;  // empty: sky
};

struct ChosenSamples {
  std::vector<ChosenPixel> horizon;   // one of each photograph, in the sky
  std::vector<ChosenPixel> haze;      // level ground in full sun, near to far, where it is matt
  std::vector<ChosenPixel> mirrored;  // the same on the face that mirrors, as the paper has it
  std::vector<ChosenPixel> daylight;  // one material in varied light
};

// Each lies 4 px or more from the edge of its polygon, of a shadow, of a pane or of a target, and
// is not clipped. Small photographs may yield fewer.
ChosenSamples ChooseSamples(const SurveyPlan& plan, const std::vector<RenderedView>& renderings);

// For each surveyed face the view that shows most of it, -1 if fewer than 100 px.
std::vector<int> BestViews(const Scene& natural, const std::vector<RenderedView>& renderings);

}  // namespace insitu::demo
