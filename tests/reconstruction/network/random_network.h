// SPDX-License-Identifier: GPL-3.0-or-later
// Networks drawn at random around a small town with known truth, for statistics over many of them.
#pragma once

#include "reconstruction/network/network.h"

namespace insitu {

// The truth, observed without error: its unknowns are true, its observations what they would be.
// Boxes on a ground; control, tie points and vertices; sun, zenith; a distance, a height, a wall
// upright, walls perpendicular, edges marked, one camera's position surveyed. Every seed has other
// cameras, boxes, sigmas and directions.
Network MakeRandomNetwork(unsigned seed);

// Gaussian errors of their own sigma on every observation.
Network WithNoise(const Network& truth, unsigned seed);

// Start values a surveyor's first approximations might be: some centimetres and milliradians off.
Network WithRoughStart(const Network& network, unsigned seed);

}  // namespace insitu
