// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/random.h"

#include <cmath>
#include <numbers>

namespace insitu::demo {
namespace {

uint64_t Scramble(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

double UnitInterval(uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

double Smooth(double t) { return t * t * (3 - 2 * t); }

}  // namespace

Random::Random(uint64_t a, uint64_t b, uint64_t c)
    : state_(Scramble(Scramble(Scramble(a + 1) + b) + c)) {}

uint64_t Random::Bits() { return Scramble(state_ += 0x9e3779b97f4a7c15ull); }

double Random::Uniform() { return UnitInterval(Bits()); }

double Random::Gaussian() {
  const double radius = std::sqrt(-2 * std::log(1 - Uniform()));
  return radius * std::cos(2 * std::numbers::pi * Uniform());
}

double CellNoise(int64_t i, int64_t j, uint64_t seed) {
  const uint64_t mixed = static_cast<uint64_t>(i) * 0x9e3779b97f4a7c15ull +
                         static_cast<uint64_t>(j) * 0xc2b2ae3d27d4eb4full + seed;
  return UnitInterval(Scramble(mixed));
}

double ValueNoise(double u, double v, uint64_t seed) {
  const double u0 = std::floor(u), v0 = std::floor(v);
  const auto i = static_cast<int64_t>(u0), j = static_cast<int64_t>(v0);
  const double s = Smooth(u - u0), t = Smooth(v - v0);
  const double below = std::lerp(CellNoise(i, j, seed), CellNoise(i + 1, j, seed), s);
  const double above = std::lerp(CellNoise(i, j + 1, seed), CellNoise(i + 1, j + 1, seed), s);
  return std::lerp(below, above, t);
}

}  // namespace insitu::demo
