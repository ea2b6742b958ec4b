// SPDX-License-Identifier: GPL-3.0-or-later
// Spectra at 5 nm, the colour they are seen with, daylight and haze: the physics of the demo site.
// It shares nothing with radiometry/, so that each can check the other.
#pragma once

#include <Eigen/Core>

namespace insitu::demo {

inline constexpr int kBands = 81;  // 380, 385, ... 780 nm
using Spectrum = Eigen::Array<double, kBands, 1>;

// The wavelength of each band [nm].
const Spectrum& Wavelengths();

// Radiance of a black body at `kelvin`, 1 at 560 nm.
Spectrum BlackBody(double kelvin);

// A smooth step from 0 to 1 about `center_nm`.
Spectrum Step(double center_nm, double width_nm);

// A bell of height 1 about `center_nm`.
Spectrum Bell(double center_nm, double width_nm);

// CIE 1931 tristimulus values, Y = 1 for the spectrum 1. Analytic observer of Wyman, Sloan and
// Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2013.
Eigen::Vector3d XyzFromSpectrum(const Spectrum& spectrum);

// Linear Rec. 709 of the same; components may be negative outside the gamut.
Eigen::Vector3d RgbFromSpectrum(const Spectrum& spectrum);

// The light and the air over the site.
struct Daylight {
  Spectrum sun_irradiance;  // on a surface square to the sun
  Spectrum sky_radiance;    // uniform above the horizon, also the haze's L_infinity
  Spectrum extinction;      // [1/m]
};

// Sun as a 5500 K black body, sky as scattered sunlight, extinction by Angstrom's power law; scaled
// so that pale plaster facing the sun stays just below white in the photographs.
Daylight ClearMorning();

// No sun, a grey sky alike everywhere, air that is too clear to matter over a courtyard.
Daylight Overcast();

// Radiance after `distance` [m] of air: L = L0 t^d + L_infinity (1 - t^d), [Durisch92, Eq. (2)].
Spectrum ThroughAir(const Daylight& daylight, const Spectrum& radiance, double distance);

// Transmittance per metre that a camera's channels see over `distance` of air on a neutral surface;
// a channel is broad, so it depends a little on the distance.
Eigen::Vector3d EffectiveTransmittance(const Daylight& daylight, double distance);

// Colour of `reflectance` relative to a perfect white card in open daylight, as a grey card tells.
Eigen::Vector3d ReflectanceRgb(const Daylight& daylight, const Spectrum& reflectance);

// Unpolarised Fresnel reflectance of a dielectric of index `ior` seen from air.
double Fresnel(double cosine, double ior);

}  // namespace insitu::demo
