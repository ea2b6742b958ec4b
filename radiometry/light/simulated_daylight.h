// SPDX-License-Identifier: GPL-3.0-or-later
// Daylight with the sun elsewhere: the measured one, scaled by what a cloudless sky's would be.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "radiometry/light/clear_sky.h"
#include "radiometry/light/daylight.h"

namespace insitu {

constexpr double kLowestSimulatedSun = 0.05;  // [rad], 2.9 degrees: lower air masses are no plane's

// The model of [Bird, Riordan 1986] gives sun and sky at both elevations, in air of the aerosol
// depth by which it explains the measured sun over sky best. By wavelength the measured sun is
// multiplied by the model's ratio across the rays, sky and ambient light by that on the level; the
// sky keeps its shape, whose glow goes with the sun. Clouds, ground and water vapour stay as they
// were.
struct SimulatedDaylight {
  Daylight light;
  double aerosol_depth = 0;  // optical, at 500 nm
  Spectrum sun_ratio = Spectrum::Ones(), sky_ratio = Spectrum::Ones();
  Spectrum level_ratio = Spectrum::Ones();  // of all that open level ground receives
};

// `sun`: unit, world. nullopt: no sun was measured, or one of the two stands lower than
// kLowestSimulatedSun. `altitude` [m].
std::optional<SimulatedDaylight> DaylightUnder(const Daylight& measured, const Eigen::Vector3d& sun,
                                               double altitude, const SpectralBins& bins);

}  // namespace insitu
