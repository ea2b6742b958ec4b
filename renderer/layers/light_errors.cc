// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/layers/light_errors.h"

#include <algorithm>
#include <vector>

#include "calibration/files/json_file.h"

namespace insitu {
namespace {

Spectrum SigmaOf(const JsonNode& light, const char* name, const SpectralBins& bins) {
  Spectrum sigma = Spectrum::Zero();
  const auto node = light.Find(name);
  const std::vector<double> numbers = node ? node->Numbers() : std::vector<double>();
  for (int i = 0; i < std::min<int>(bins.count, static_cast<int>(numbers.size())); ++i) {
    sigma[i] = numbers[static_cast<size_t>(i)];
  }
  return sigma;
}

Eigen::Vector3d Relative(const SpectralBasis& spectra, const Spectrum& sigma,
                         const Spectrum& radiance) {
  const Eigen::Vector3d error = spectra.RgbFromSpectrum(sigma);
  const Eigen::Vector3d value = spectra.RgbFromSpectrum(radiance);
  return (value.array() > 0).select(error.cwiseMax(0).cwiseQuotient(value), 0.0);
}

}  // namespace

LightErrors ReadLightErrors(const SitePaths& site, const NaturalEnvironment& natural) {
  const JsonNode root = JsonNode::Load(site.environment());
  const JsonNode light = root.At("light");
  const SpectralBasis& spectra = natural.spectra;
  const Daylight& daylight = natural.light;
  return {Relative(spectra, SigmaOf(light, "sun_radiance_sigma", spectra.bins()),
                   daylight.sun_radiance),
          Relative(spectra, SigmaOf(light, "sky_radiance_sigma", spectra.bins()),
                   daylight.ambient_radiance + daylight.sky_radiance)};
}

}  // namespace insitu
