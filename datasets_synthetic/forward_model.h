// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs of a site before and after the building stands: sun, sky, the light that
// surfaces send each other, and one bounce in glass, panes and water.
#pragma once

#include <vector>

#include "calibration/photo/raster.h"
#include "datasets_synthetic/bounced_light.h"

namespace insitu::demo {

// What a pixel shows before the building stands.
struct PixelRecord {
  const Face* face = nullptr;  // nullptr: sky, or more than one face
  bool sky = false;
  bool plain = false;  // neither pane nor target
  float sun = 0;       // visible share of the disc
  float sky_share = 0;
  float distance = 0;  // [m]
};

struct RenderedView {
  Raster before, after;  // linear Rec. 709, in the frame of the photograph, distortion and all
  Raster mask;           // one channel, code / 255: 0 nothing near changes by 0.1 of an 8-bit
                         // sRGB code, 170 other light, 255 building
  std::vector<PixelRecord> records;  // row-major
};

struct RenderOptions {
  int strata = 12;  // squared: directions that light is gathered from for 3 x 3 pixels of a face
  // Gathers apart what the building will hide, where it is dark afterwards. The demo, whose bytes
  // are fixed, does not: its ground has darker pixels at the building's foot.
  bool gather_hidden_apart = false;
};

// 2 x 2 samples a pixel. Independent of the number of threads.
RenderedView RenderView(const BouncedLight& light, const View& view,
                        const RenderOptions& options = {});

}  // namespace insitu::demo
