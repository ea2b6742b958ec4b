// SPDX-License-Identifier: GPL-3.0-or-later
// Colour: the CIE 1931 standard observer on the renderer's bins, RGB spaces of any primaries.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiometry/spectrum/spectrum.h"

namespace insitu {

// Colour-matching functions averaged over each bin times its width; rows x, y, z.
// Tabulated at 5 nm (radiometry/data, with source and licence), linear between.
Eigen::Matrix<double, 3, kMaxBins> ColorMatching(const SpectralBins& bins);

// Relative spectral distribution of CIE standard illuminant D65, averaged over each bin, 1 at 560
// nm.
Spectrum IlluminantD65(const SpectralBins& bins);

// The weight k for which k D65 is as bright as a radiance.
double WeightOfD65(const Spectrum& radiance, const SpectralBins& bins);

// Tristimulus values of a colour stimulus. [Durisch92, Eq. (11)]  k = 1 / integral of y.
Eigen::Vector3d Tristimulus(const Spectrum& stimulus, const SpectralBins& bins);

// Chromaticity x, y, z (sum 1) of tristimulus values with a positive sum. [Durisch92, Eq. (12)]
Eigen::Vector3d Chromaticity(const Eigen::Vector3d& tristimulus);

// The spectrum locus: chromaticities of pure spectral colours, in steps of 5 nm.
struct SpectralColor {
  double wavelength = 0;  // [nm]
  Eigen::Vector2d chromaticity;
};
std::vector<SpectralColor> SpectrumLocus();

// Chromaticities (x, y) of the primaries and of the white point.
struct RgbPrimaries {
  Eigen::Vector2d red, green, blue, white;
};
RgbPrimaries Rec709();     // white D65
RgbPrimaries Ntsc1953();   // white C, the standard NTSC monitor of [Durisch92, App. A]
RgbPrimaries DisplayP3();  // white D65 [SMPTE EG 432-1]
RgbPrimaries Rec2020();    // white D65 [ITU-R BT.2020]

// The matrix M of [Durisch92, Eq. (13)]: RGB = M XYZ, white (1, 1, 1) at Y = 1.
// Throws std::invalid_argument for primaries on one line.
Eigen::Matrix3d RgbFromXyz(const RgbPrimaries& primaries);

}  // namespace insitu
