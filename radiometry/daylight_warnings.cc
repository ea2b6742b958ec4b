// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/daylight_warnings.h"

#include <algorithm>
#include <cmath>

namespace insitu {
namespace {

constexpr double kMuchUnseen = 0.2;  // of a sample's hemisphere

std::string Joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

bool SeesSun(const std::vector<DaylightSample>& samples) {
  return std::any_of(samples.begin(), samples.end(),
                     [](const auto& sample) { return sample.geometry.sun > 0; });
}

std::string NameOf(const PixelSample& sample, const SceneGeometry& scene) {
  return scene.cameras[sample.photo].photo + " (" + std::to_string(std::lround(sample.pixel.x())) +
         ", " + std::to_string(std::lround(sample.pixel.y())) + ")";
}

std::vector<std::string> NamesOfUnseen(const LightMeasurement& measured) {
  std::vector<std::string> names;
  for (size_t i = 0; i < measured.unseen.size(); ++i) {
    if (measured.unseen[i] < kMuchUnseen) continue;
    names.push_back(NameOf(measured.samples.daylight[i], measured.environment.scene));
  }
  return names;
}

std::vector<Sentence> DaylightWarnings(const LightMeasurement& measured) {
  std::vector<Sentence> warnings;
  if (const auto unseen = NamesOfUnseen(measured); !unseen.empty()) {
    warnings.emplace_back(Sentence("lightUnseen",
                                   "daylight samples that receive much light from surfaces no "
                                   "photograph shows, which weigh less: {samples}",
                                   {{"samples", Joined(unseen)}}));
  }
  if (!measured.environment.scene.sun) {
    warnings.emplace_back(
        Sentence("lightOvercast", "no sun direction was measured: the sky is taken as overcast"));
  } else if (!SeesSun(measured.daylight)) {
    warnings.emplace_back(
        Sentence("lightSunUnseen", "no daylight sample sees the sun: it stays dark"));
  }
  const Daylight& light = measured.environment.light;
  if ((light.sun_radiance < 0).any() || (light.ambient_radiance < 0).any() ||
      (light.sky_radiance < 0).any()) {
    warnings.emplace_back(
        Sentence("lightNegative",
                 "least squares without bounds make a component of daylight negative, which no "
                 "light is: it is used as calculated, as the paper has it"));
  }
  if (measured.daylight_fit.condition > kPoorCondition) {
    warnings.emplace_back(
        Sentence("lightPoor",
                 "the daylight samples hardly tell sun, sky and ambient light apart: choose some "
                 "in sun, in open shade and in deep shade"));
  }
  return warnings;
}

}  // namespace insitu
