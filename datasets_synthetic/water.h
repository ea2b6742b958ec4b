// SPDX-License-Identifier: GPL-3.0-or-later
// Water whose surface is stochastic: waves of several octaves, a function of the place alone.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "datasets_synthetic/scene.h"

namespace insitu::demo {

struct Waves {
  double rms_slope = 0;              // of both directions together; 0: calm
  double longest = 2, shortest = 1;  // [m], octaves between share the slopes' variance alike
  uint64_t seed = 1;
};

// Rise over run along both axes of a level surface.
Eigen::Vector2d WaveSlope(const Waves& waves, const Eigen::Vector2d& position);

// The normal of `face` at `point`, tilted by the waves, on the side of `toward`. Haruyama and
// Barsky, IEEE CG&A 4(3) 1984; Blinn, SIGGRAPH 1978.
Eigen::Vector3d WaveNormal(const Waves& waves, const Face& face, const Eigen::Vector3d& point,
                           const Eigen::Vector3d& toward);

}  // namespace insitu::demo
