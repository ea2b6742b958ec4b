// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers that are the same on every machine and for every number of threads.
#pragma once

#include <cstdint>

namespace insitu::demo {

// SplitMix64 (Steele, Lea and Flood 2014). Streams are seeded by place, never shared by threads.
class Random {
 public:
  // Any three numbers that name the stream, e.g. photo, pixel, purpose.
  Random(uint64_t a, uint64_t b, uint64_t c);

  uint64_t Bits();
  double Uniform();   // [0, 1)
  double Gaussian();  // mean 0, sigma 1

 private:
  uint64_t state_;
};

// Smooth noise over the plane, 0..1 with mean 1/2, one lattice cell per unit.
double ValueNoise(double u, double v, uint64_t seed);

// A number in [0, 1) that belongs to one cell of the lattice.
double CellNoise(int64_t i, int64_t j, uint64_t seed);

}  // namespace insitu::demo
