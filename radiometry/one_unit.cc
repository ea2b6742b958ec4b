// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/one_unit.h"

#include <vector>

namespace insitu {
namespace {

std::vector<bool> Mirrors(const NaturalEnvironment& environment) {
  std::vector<bool> mirrors;
  for (const Polygon& polygon : environment.scene.polygons) {
    const auto& specular = environment.materials.at(polygon.material).specular;
    mirrors.push_back(specular && specular->weight > 0);
  }
  return mirrors;
}

}  // namespace

void BringToOneUnit(PhotographSet* photos, LightMeasurement* measured) {
  const NaturalEnvironment& environment = measured->environment;
  measured->exposure_fit =
      MeasureExposures(environment.scene, *photos, measured->exposures, Mirrors(environment));
  const std::vector<PhotoExposure>& exposures = measured->exposure_fit.photos;
  for (size_t i = 0; i < photos->size(); ++i) {
    if (!exposures[i].IsOne()) photos->SetFactor(i, FactorOfGain(exposures[i].gain));
  }
  LightSamples& samples = measured->samples;
  for (auto* list : {&samples.horizon, &samples.haze, &samples.daylight}) {
    for (PixelSample& sample : *list) {
      const Eigen::Vector3d& gain = exposures[sample.photo].gain;
      sample.rgb = sample.rgb.cwiseQuotient(gain);
      sample.rgb_sigma = sample.rgb_sigma.cwiseQuotient(gain);
    }
  }
}

}  // namespace insitu
