// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/spectral_light.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace insitu::demo {
namespace {

constexpr double kStepNm = 5;

// One lobe of the observer: a Gaussian with a width of its own on either side.
Spectrum Lobe(double height, double center, double left, double right) {
  const Spectrum offset = Wavelengths() - center;
  const Spectrum scaled = (offset < 0).select(offset / left, offset / right);
  return height * (-0.5 * scaled.square()).exp();
}

using Observer = Eigen::Matrix<double, 3, kBands>;

Observer MakeObserver() {
  Observer observer;
  observer.row(0) = (Lobe(1.056, 599.8, 37.9, 31.0) + Lobe(0.362, 442.0, 16.0, 26.7) +
                     Lobe(-0.065, 501.1, 20.4, 26.2))
                        .matrix()
                        .transpose();
  observer.row(1) =
      (Lobe(0.821, 568.8, 46.9, 40.5) + Lobe(0.286, 530.9, 16.3, 31.1)).matrix().transpose();
  observer.row(2) =
      (Lobe(1.217, 437.0, 11.8, 36.0) + Lobe(0.681, 459.0, 26.0, 13.8)).matrix().transpose();
  return observer / observer.row(1).sum();
}

const Observer& CieObserver() {
  static const Observer observer = MakeObserver();
  return observer;
}

// From the chromaticities of ITU-R BT.709 and its white, D65.
Eigen::Matrix3d MakeRgbFromXyz() {
  Eigen::Matrix3d primaries;
  primaries << 0.640, 0.300, 0.150,  //
      0.330, 0.600, 0.060,           //
      0.030, 0.100, 0.790;
  const Eigen::Vector3d white(0.3127 / 0.3290, 1.0, (1 - 0.3127 - 0.3290) / 0.3290);
  const Eigen::Vector3d weights = primaries.inverse() * white;
  return (primaries * weights.asDiagonal()).inverse();
}

const Observer& RgbObserver() {
  static const Observer observer = MakeRgbFromXyz() * CieObserver();
  return observer;
}

}  // namespace

const Spectrum& Wavelengths() {
  static const Spectrum wavelengths =
      Spectrum::LinSpaced(kBands, 380.0, 380.0 + kStepNm * (kBands - 1));
  return wavelengths;
}

Spectrum BlackBody(double kelvin) {
  constexpr double kSecondRadiation = 1.438777e7;  // h c / k [nm K]
  const auto planck = [kelvin](const Spectrum& nm) -> Spectrum {
    return nm.pow(-5) / ((kSecondRadiation / kelvin / nm).exp() - 1);
  };
  return planck(Wavelengths()) / planck(Spectrum::Constant(560.0))(0);
}

Spectrum Step(double center_nm, double width_nm) {
  return 1 / (1 + (-(Wavelengths() - center_nm) / width_nm).exp());
}

Spectrum Bell(double center_nm, double width_nm) {
  return (-0.5 * ((Wavelengths() - center_nm) / width_nm).square()).exp();
}

Eigen::Vector3d XyzFromSpectrum(const Spectrum& spectrum) {
  return CieObserver() * spectrum.matrix();
}

Eigen::Vector3d RgbFromSpectrum(const Spectrum& spectrum) {
  return RgbObserver() * spectrum.matrix();
}

Daylight ClearMorning() {
  Daylight daylight;
  daylight.sun_irradiance = 4.5 * BlackBody(5500);
  daylight.sky_radiance = 0.48 * BlackBody(5800) * (Wavelengths() / 550.0).pow(-1.9);
  daylight.extinction = 0.0011 * (Wavelengths() / 550.0).pow(-1.3);
  return daylight;
}

Daylight Overcast() {
  Daylight daylight;
  daylight.sun_irradiance = Spectrum::Zero();
  daylight.sky_radiance = 0.82 * BlackBody(6500);
  daylight.extinction = Spectrum::Zero();
  return daylight;
}

Spectrum ThroughAir(const Daylight& daylight, const Spectrum& radiance, double distance) {
  const Spectrum transmittance = (-distance * daylight.extinction).exp();
  return daylight.sky_radiance + (radiance - daylight.sky_radiance) * transmittance;
}

Eigen::Vector3d EffectiveTransmittance(const Daylight& daylight, double distance) {
  const Spectrum near = daylight.sun_irradiance / std::numbers::pi + daylight.sky_radiance;
  const Spectrum far = near * (-distance * daylight.extinction).exp();
  const Eigen::Array3d ratio = RgbFromSpectrum(far).array() / RgbFromSpectrum(near).array();
  return ratio.pow(1 / distance).matrix();
}

Eigen::Vector3d ReflectanceRgb(const Daylight& daylight, const Spectrum& reflectance) {
  const Spectrum white = daylight.sun_irradiance / std::numbers::pi + daylight.sky_radiance;
  const Eigen::Array3d card = RgbFromSpectrum(white).array();
  return (RgbFromSpectrum(reflectance * white).array() / card).matrix();
}

double Fresnel(double cosine, double ior) {
  const double c = std::min(1.0, std::abs(cosine));
  const double g = std::sqrt(ior * ior - 1 + c * c);
  const double ratio = (g - c) / (g + c);
  const double term = (c * (g + c) - 1) / (c * (g - c) + 1);
  return 0.5 * ratio * ratio * (1 + term * term);
}

}  // namespace insitu::demo
