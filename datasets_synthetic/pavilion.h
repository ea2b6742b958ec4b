// SPDX-License-Identifier: GPL-3.0-or-later
// The demo's planned building: a pavilion with glass windows, a tapered mast and a stone ball.
#pragma once

#include "datasets_synthetic/building.h"

namespace insitu::demo {

// `azimuth` [rad]: of the building's x axis about z. The base reaches into the ground.
Building MakePavilion(double azimuth);

}  // namespace insitu::demo
