// SPDX-License-Identifier: GPL-3.0-or-later
// A photograph as it would be under another daylight.
#pragma once

#include <memory>

#include "calibration/photo/raster.h"
#include "radiometry/light/simulated_daylight.h"
#include "radiometry/natural_environment.h"

namespace insitu {

// By wavelength, of a pixel that shows a surveyed polygon, L being its colour and d its distance:
// the haze is removed (8); rays to the sun's disc and the sky's facets against the polygons,
// without the building, give the irradiances E and E' of both lights (3)-(5), the sky's by its
// shape; L0' = L0 E' / E (10, 6), where light is added with a reflectance of 1 at most; and the
// haze of the simulated air is added (2). What mirrors goes with the sky that it mirrors, what is
// no polygon's with the sky there, below the horizon with open level ground.
class Relighting {
 public:
  Relighting(const NaturalEnvironment& measured, const SimulatedDaylight& simulated);
  ~Relighting();
  Relighting(const Relighting&) = delete;
  Relighting& operator=(const Relighting&) = delete;

  // `image` in the site's unit, as `camera` saw it. With any number of threads the same.
  Raster Relit(const PosedCamera& camera, const Raster& image) const;

  const Atmosphere& air() const;  // simulated: its colour goes with the light on the level

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace insitu
