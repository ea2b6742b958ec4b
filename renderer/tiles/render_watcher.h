// SPDX-License-Identifier: GPL-3.0-or-later
// Who looks on while pictures are rendered.
#pragma once

#include <string>

#include "calibration/photo/raster.h"
#include "renderer/tiles/finished_tile.h"

namespace insitu {

// Costs the render nothing: none of it waits for anybody.
class RenderWatcher {
 public:
  virtual ~RenderWatcher() = default;

  // A picture begins. `photo`: what its tiles show where nothing is computed; stays until End.
  virtual void Begin(const std::string& name, const Raster& photo) = 0;
  // A tile is there, also one that an earlier run has left; from any thread.
  virtual void Take(const FinishedTile& tile) = 0;
  virtual void End(bool is_whole) = 0;  // false: it was stopped
};

}  // namespace insitu
