// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/spectrum/color_temperature.h"

#include <cmath>

#include "calibration/files/error.h"
#include "radiometry/spectrum/color.h"

namespace insitu {
namespace {

constexpr double kFarthest = 0.05;                  // [CIE 15: no correlated temperature beyond]
constexpr double kHottest = 5, kColdest = 1000;     // [1e6 / K]
constexpr double kSecondRadiation = 1.438776877e7;  // [nm K]
constexpr int kSteps = 200;                         // of reciprocal temperature; then bisection

// CIE 1960.
Eigen::Vector2d UvOf(const Spectrum& light, const SpectralBins& bins) {
  const Eigen::Vector3d xyz = Tristimulus(light, bins);
  return Eigen::Vector2d(4 * xyz.x(), 6 * xyz.y()) / (xyz.x() + 15 * xyz.y() + 3 * xyz.z());
}

Eigen::Vector2d PlanckianUv(double mired, const SpectralBins& bins) {
  return UvOf(BlackBody(1e6 / mired, bins), bins);
}

}  // namespace

Spectrum BlackBody(double kelvin, const SpectralBins& bins) {
  INSITU_CHECK(kelvin > 0);
  const auto radiance = [&](double nm) {
    return std::pow(nm / 560, -5) / std::expm1(kSecondRadiation / (nm * kelvin));
  };
  Spectrum light = Spectrum::Zero();
  for (int i = 0; i < bins.count; ++i) light[i] = radiance(bins.Center(i)) / radiance(560);
  return light;
}

std::optional<ColorTemperature> CorrelatedColorTemperature(const Spectrum& light,
                                                           const SpectralBins& bins) {
  if (!(Tristimulus(light, bins).minCoeff() > 0)) return std::nullopt;
  const Eigen::Vector2d uv = UvOf(light, bins);
  const auto distance = [&](double mired) { return (PlanckianUv(mired, bins) - uv).norm(); };
  double best = kHottest, step = (kColdest - kHottest) / kSteps;
  for (int i = 1; i <= kSteps; ++i) {
    if (distance(kHottest + i * step) < distance(best)) best = kHottest + i * step;
  }
  for (; step > 1e-3; step /= 2) {
    for (const double next : {best - step, best + step}) {
      if (next >= kHottest && distance(next) < distance(best)) best = next;
    }
  }
  const double away = distance(best);
  if (best <= kHottest + 0.01 || away > kFarthest) return std::nullopt;
  const bool is_green = (uv - PlanckianUv(best, bins)).y() > 0;
  return ColorTemperature{1e6 / best, is_green ? away : -away};
}

}  // namespace insitu
