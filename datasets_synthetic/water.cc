// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/water.h"

#include <Eigen/Geometry>
#include <cmath>

#include "datasets_synthetic/random.h"

namespace insitu::demo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Root mean square slope of ValueNoise per cell, both directions together: a cell's step has
// variance 2/12, the other axis's blend keeps 26/35 of it, the squared slope of 3t^2 - 2t^3 is 6/5.
const double kNoiseSlope = std::sqrt(2 * (2.0 / 12) * (26.0 / 35) * (6.0 / 5));

int OctavesOf(const Waves& waves) {
  return 1 + static_cast<int>(std::log2(waves.longest / waves.shortest) + 1e-9);
}

// [Rise per cell], by central differences.
Vector2d NoiseSlope(const Vector2d& cell, uint64_t seed) {
  constexpr double kStep = 1e-3;
  return Vector2d(ValueNoise(cell.x() + kStep, cell.y(), seed) -
                      ValueNoise(cell.x() - kStep, cell.y(), seed),
                  ValueNoise(cell.x(), cell.y() + kStep, seed) -
                      ValueNoise(cell.x(), cell.y() - kStep, seed)) /
         (2 * kStep);
}

}  // namespace

Vector2d WaveSlope(const Waves& waves, const Vector2d& position) {
  Vector2d slope = Vector2d::Zero();
  if (waves.rms_slope == 0) return slope;
  const int octaves = OctavesOf(waves);
  const double share = waves.rms_slope / (std::sqrt(octaves) * kNoiseSlope);
  for (int i = 0; i < octaves; ++i) {
    const double cell = waves.longest / 2 / std::exp2(i);  // a crest and a trough
    // Each octave's lattice is turned, so that no direction is the waves' own.
    const Eigen::Rotation2Dd turn(0.6 + 1.1 * i);
    slope += share * (turn * NoiseSlope(turn.inverse() * position / cell, waves.seed + i));
  }
  return slope;
}

Vector3d WaveNormal(const Waves& waves, const Face& face, const Vector3d& point,
                    const Vector3d& toward) {
  const Vector2d slope = WaveSlope(waves, face.Local(point));
  const Vector3d normal =
      (face.normal - slope.x() * face.u_axis - slope.y() * face.v_axis).normalized();
  return toward.dot(face.normal) < 0 ? Vector3d(-normal) : normal;
}

}  // namespace insitu::demo
