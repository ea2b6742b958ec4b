// SPDX-License-Identifier: GPL-3.0-or-later
// A drawing put onto its photograph.
#pragma once

#include "renderer/levels/avr_levels.h"

namespace insitu {

// The drawing's colour over the photograph by `shares`, one channel of its size, 0..1; where that
// is 0 the pixel is the photograph's, bit for bit. What is covered counts as building.
RenderResult DrawnOnto(const DrawnView& view, const Raster& shares);

}  // namespace insitu
