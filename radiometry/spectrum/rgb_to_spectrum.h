// SPDX-License-Identifier: GPL-3.0-or-later
// Spectra from RGB triplets. [Durisch92, App. A]
#pragma once

#include <Eigen/Core>
#include <optional>

#include "radiometry/spectrum/color.h"
#include "radiometry/spectrum/spectrum.h"

namespace insitu {

// A function that is constant on each of the three domains lambda_1..2..3..4, with the domain
// borders on bin edges. [Durisch92, Eqs. (18), (19)]
struct PiecewiseBasis {
  int second = 0, third = 0;  // first bin of the second and third domain
  Eigen::Vector3d weights;    // c_1i, c_2i, c_3i >= 0
  bool exact = true;          // false: no non-negative solution, nearest two-transition box instead
};
Spectrum DomainIndicator(int first_bin, int end_bin);                      // Eq. (19)
Spectrum Evaluate(const PiecewiseBasis& basis, const SpectralBins& bins);  // Eq. (18)

// The two branches of the search of [Durisch92, App. A] for a basis function of given tristimulus
// values: of the non-negative solutions that with the lowest peak, nullopt where there is none; and
// the box 0 s 0 or s 0 s of the same Y that comes nearest.
std::optional<PiecewiseBasis> FindExactBasis(const Eigen::Vector3d& tristimulus,
                                             const SpectralBins& bins);
PiecewiseBasis FindNearestBox(const Eigen::Vector3d& tristimulus, const SpectralBins& bins);

// The first, or where it has none the second.
PiecewiseBasis FindBasis(const Eigen::Vector3d& tristimulus, const SpectralBins& bins);

// RGB <-> spectrum for one RGB space, built on the renderer's own bins, so that
// RGB -> spectrum -> RGB is the identity to rounding.
class SpectralBasis {
 public:
  explicit SpectralBasis(const RgbPrimaries& primaries = Rec709(), const SpectralBins& bins = {});
  // RGB of one space on the basis functions of another's primaries, whose white plays no part.
  SpectralBasis(const RgbPrimaries& primaries, const SpectralBins& bins,
                const RgbPrimaries& basis_primaries);

  const SpectralBins& bins() const { return bins_; }
  const RgbPrimaries& basis_primaries() const { return basis_primaries_; }
  // 1 in every bin that is used, 0 beyond.
  Spectrum Ones() const;

  // Weights c = W^-1 RGB, then their combination of the basis. [Durisch92, Eqs. (14), (17)]
  // Linear; non-negative for colours inside the gamut if all three bases are exact: those of
  // Rec. 709 are, with 9 and with 16 bins; of NTSC's the red one is not, which leaves up to -0.3 %.
  Spectrum SpectrumFromRgb(const Eigen::Vector3d& rgb) const;
  // RGB = W c and its general form through the tristimulus values. [Durisch92, Eqs. (15), (16)]
  Eigen::Vector3d RgbFromSpectrum(const Spectrum& stimulus) const;
  // A reflectance whose colour under the RGB white is `rgb`: SpectrumFromRgb over the spectrum of
  // white, so that grey is flat and 0..1 stays 0..1. In a bin where white is zero nothing can be
  // seen of the reflectance: its luminance stands there, so grey is flat there too.
  // Departure: App. A alone makes white 0.85-2.7. On the space's own primaries, whatever those of
  // the basis are: NTSC's red is a narrow band, in which colours would change with the light's
  // spectrum.
  Spectrum ReflectanceFromRgb(const Eigen::Vector3d& rgb) const;

  const Eigen::Matrix<double, kMaxBins, 3>& basis() const { return basis_; }     // columns b, g, r
  const Eigen::Matrix3d& weights_from_rgb() const { return weights_from_rgb_; }  // W^-1

 private:
  SpectralBins bins_;
  RgbPrimaries basis_primaries_;
  Eigen::Matrix<double, kMaxBins, 3> basis_;
  Eigen::Matrix<double, 3, kMaxBins> rgb_from_spectrum_;
  Eigen::Matrix3d weights_from_rgb_;
  Eigen::Matrix<double, kMaxBins, 3> spectrum_from_rgb_;
  Eigen::Matrix<double, kMaxBins, 3> own_from_rgb_;  // the same on the space's own primaries
  Eigen::RowVector3d luminance_from_rgb_;
  Spectrum white_;  // by own_from_rgb_
};

}  // namespace insitu
