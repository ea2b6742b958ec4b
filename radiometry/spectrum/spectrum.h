// SPDX-License-Identifier: GPL-3.0-or-later
// Spectral distributions sampled in equal bins over the visible spectrum, 380 to 780 nm.
#pragma once

#include <Eigen/Core>

namespace insitu {

constexpr double kFirstWavelength = 380;  // [nm]
constexpr double kLastWavelength = 780;   // [nm]
constexpr int kFewestBins = 3;
constexpr int kMaxBins = 16;

// One value a bin: spectral radiance, irradiance, reflectance or transmittance, as its name says.
// Radiances and irradiances share an arbitrary unit per site. Bins beyond SpectralBins::count hold
// zero and carry no colour.
using Spectrum = Eigen::Array<double, kMaxBins, 1>;

struct SpectralBins {
  int count = kMaxBins;  // 16, or 9 as in [Durisch92, §7]; kFewestBins..kMaxBins

  double Width() const { return (kLastWavelength - kFirstWavelength) / count; }      // [nm]
  double Edge(int bin) const { return kFirstWavelength + bin * Width(); }            // [nm]
  double Center(int bin) const { return kFirstWavelength + (bin + 0.5) * Width(); }  // [nm]
};

}  // namespace insitu
