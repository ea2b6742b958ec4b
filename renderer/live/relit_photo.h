// SPDX-License-Identifier: GPL-3.0-or-later
// A photograph as the measured light says it would look without the sun, and in the sun alone. A
// weight of light that is wrong leaves shadows where there is no sun, or light where it is alone.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "calibration/photo/raster.h"
#include "radiometry/natural_environment.h"

namespace insitu {

struct RelitPhoto {
  Raster without_sun, sun_alone;  // linear, in the photograph's unit
  std::vector<bool> is_relit;     // by pixel, row by row; the others are as in the photograph
};

// By wavelength, of a pixel that shows a surveyed polygon, L being its colour and d its distance:
// the haze is removed, L0 = (L - Linf) tau^-d + Linf (8); rays to the sun's disc and the sky
// against the polygons, without the building, give Es, Eu, Eh (3)-(5); rho = L0 / (kd E) (10)
// reflects what is left of E (6), L0' = L0 (Eu + Eh) / E or L0 Es / E; the same haze is added (2).
// Pixels on no polygon, of a mirroring material or without any light keep their colour.
//
// `photo` is a photograph of scene.cameras[camera] made smaller by the same factor in both
// directions, or whole. Deterministic. `is_stopped` is asked each row: then nullopt.
std::optional<RelitPhoto> RelightPhoto(const NaturalEnvironment& environment, int camera,
                                       const Raster& photo,
                                       const std::function<bool()>& is_stopped = {});

}  // namespace insitu
