// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_light.h"

#include <algorithm>
#include <filesystem>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/sentence.h"
#include "calibration/files/wording.h"
#include "radiometry/light_report.h"
#include "radiometry/measure/further_sample.h"
#include "radiometry/measure_daylight.h"

namespace insitu {
namespace {

constexpr double kHazeDistance = 100;    // [m], for which the transmittance is told
constexpr double kFairLight = 33;        // condition above which another sample is proposed
constexpr double kShortBase = 3;         // farthest haze sample over the nearest
constexpr double kGrossResidual = 0.25;  // relative
constexpr double kUneven = 0.3;          // spread of a sample's pixels over their mean

Json::Value ResidualsJson(const std::vector<PixelSample>& samples,
                          const std::vector<double>& residuals, const SceneGeometry& scene) {
  Json::Value list(Json::arrayValue);
  for (size_t i = 0; i < residuals.size(); ++i) {
    Json::Value row;
    row["photo"] = scene.cameras[samples[i].photo].photo;
    row["x"] = samples[i].pixel.x();
    row["y"] = samples[i].pixel.y();
    row["residual"] = residuals[i];
    list.append(row);
  }
  return list;
}

Json::Value HazeJson(const LightMeasurement& measured) {
  const NaturalEnvironment& environment = measured.environment;
  Json::Value json;
  json["horizon_rgb"] = ToJson(environment.spectra.RgbFromSpectrum(environment.air.horizon));
  json["transmittance_100m_rgb"] = ToJson(TransmittanceRgb(environment, kHazeDistance));
  if (measured.air_fit.residuals.empty()) return json;
  const int bins = environment.spectra.bins().count;
  json["transmittance_100m_sigma"] =
      kHazeDistance * measured.air_fit.transmittance_sigma.head(bins).mean();
  json["condition"] = measured.air_fit.condition.head(bins).maxCoeff();
  json["rms_over_sigma"] = measured.air_fit.rms;
  return json;
}

Json::Value DaylightJson(const LightMeasurement& measured) {
  const NaturalEnvironment& environment = measured.environment;
  const SpectralBins& bins = environment.spectra.bins();
  const DaylightFit& fit = measured.daylight_fit;
  const auto weight = [&](const Spectrum& radiance, const Spectrum& sigma) {
    Json::Value json;
    json["value"] = WeightOfD65(radiance, bins);
    json["sigma"] = WeightOfD65(sigma, bins);
    return json;
  };
  Json::Value json;
  json["k_s"] = weight(environment.light.sun_radiance, fit.sun_sigma);
  json["k_u"] = weight(environment.light.ambient_radiance, fit.ambient_sigma);
  json["k_h"] = weight(environment.light.sky_radiance, fit.sky_sigma);
  json["sun_irradiance_rgb"] = ToJson(SunIrradianceRgb(environment));
  json["open_sky_radiance_rgb"] = ToJson(OpenSkyRgb(environment));
  json["condition"] = fit.condition;
  json["rms_over_sigma"] = fit.rms;
  json["reflectance_known"] = measured.reflectance_known;
  return json;
}

// What one sample more would leave of the standard deviations.
void AdviseOnHaze(const LightMeasurement& measured, Json::Value* advice) {
  const SpectralBins& bins = measured.environment.spectra.bins();
  if (const auto best = BestFurtherSample(measured.haze, measured.air_fit, bins)) {
    advice->append(Sentence("adviceFurtherHaze",
                            "haze: one more sample of the same material {distance} m away would "
                            "leave {left} % of the transmittance's standard deviation",
                            {{"distance", Number("%.0f", best->distance)},
                             {"left", Number("%.0f", 100 * best->left)}})
                       .ToJson());
    return;
  }
  const std::vector<PixelSample>& haze = measured.samples.haze;
  if (haze.empty()) return;
  const auto [nearest, farthest] =
      std::minmax_element(haze.begin(), haze.end(),
                          [](const auto& a, const auto& b) { return a.distance < b.distance; });
  if (farthest->distance > kShortBase * nearest->distance) return;
  advice->append(Sentence("adviceHaze",
                          "haze: all samples lie {near} to {far} m away; one of the same material "
                          "much nearer or farther tells more",
                          {{"near", Number("%.0f", nearest->distance)},
                           {"far", Number("%.0f", farthest->distance)}})
                     .ToJson());
}

void AdviseOnDaylight(const LightMeasurement& measured, Json::Value* advice) {
  const bool has_sun = measured.environment.scene.sun.has_value();
  if (const auto best = BestFurtherSample(measured.daylight, measured.daylight_fit, measured.brdf,
                                          has_sun, measured.environment.spectra.bins())) {
    advice->append(Sentence("adviceFurtherDaylight",
                            "daylight: one more sample {where} would leave {sun} % of the sun's "
                            "and {sky} % of the sky's standard deviation",
                            {{"where", best->where.ToJson()},
                             {"sun", Number("%.0f", 100 * best->sun_left)},
                             {"sky", Number("%.0f", 100 * best->sky_left)}})
                       .ToJson());
  } else if (measured.daylight_fit.condition > kFairLight) {
    advice->append(Sentence("adviceShade",
                            "daylight: one more sample in open shade and one in deep shade tell "
                            "sun, sky and ambient light better apart")
                       .ToJson());
  }
}

void AdviseOnTexture(const Sentence& kind, const std::vector<PixelSample>& samples,
                     const SceneGeometry& scene, Json::Value* advice) {
  for (const PixelSample& sample : samples) {
    if (sample.unevenness < kUneven) continue;
    advice->append(Sentence("adviceTexture",
                            "{kind}: the pixels about {x}, {y} on {photo} differ by {percent} %, "
                            "by texture or an edge: an even place tells more",
                            {{"kind", kind.ToJson()},
                             {"x", Number("%.0f", sample.pixel.x())},
                             {"y", Number("%.0f", sample.pixel.y())},
                             {"photo", scene.cameras[sample.photo].photo},
                             {"percent", Number("%.0f", 100 * sample.unevenness)}})
                       .ToJson());
  }
}

void AdviseOnResiduals(const Sentence& kind, const std::vector<PixelSample>& samples,
                       const std::vector<double>& residuals, const SceneGeometry& scene,
                       Json::Value* advice) {
  for (size_t i = 0; i < residuals.size(); ++i) {
    if (std::abs(residuals[i]) < kGrossResidual) continue;
    const PixelSample& sample = samples[i];
    advice->append(
        Sentence("adviceOff",
                 "{kind}: the sample at {x}, {y} on {photo} is {percent} % off: another material, "
                 "a shadow or a reflection?",
                 {{"kind", kind.ToJson()},
                  {"x", Number("%.0f", sample.pixel.x())},
                  {"y", Number("%.0f", sample.pixel.y())},
                  {"photo", scene.cameras[sample.photo].photo},
                  {"percent", Number("%+.0f", 100 * residuals[i])}})
            .ToJson());
  }
}

Json::Value AdviceJson(const LightMeasurement& measured) {
  const SceneGeometry& scene = measured.environment.scene;
  Json::Value advice(Json::arrayValue);
  for (const Sentence& warning : measured.warnings) advice.append(warning.ToJson());
  AdviseOnDaylight(measured, &advice);
  AdviseOnHaze(measured, &advice);
  const Sentence haze("nameHaze", "haze"), daylight("nameDaylight", "daylight");
  AdviseOnTexture(Sentence("nameHorizon", "horizon"), measured.samples.horizon, scene, &advice);
  AdviseOnTexture(haze, measured.samples.haze, scene, &advice);
  AdviseOnTexture(daylight, measured.samples.daylight, scene, &advice);
  AdviseOnResiduals(haze, measured.samples.haze, measured.air_fit.residuals, scene, &advice);
  AdviseOnResiduals(daylight, measured.samples.daylight, measured.daylight_fit.residuals, scene,
                    &advice);
  return advice;
}

}  // namespace

LinearPhotos::LinearPhotos(const SitePaths& site) : site_(site) {}
LinearPhotos::~LinearPhotos() = default;

const std::vector<Photograph>& LinearPhotos::Of(const SceneGeometry& scene) {
  const std::vector<std::filesystem::path> paths = ListPhotographs(site_);
  for (const PosedCamera& posed : scene.cameras) {
    if (std::find(names_.begin(), names_.end(), posed.photo) != names_.end()) continue;
    const auto path = std::find_if(paths.begin(), paths.end(),
                                   [&](const auto& p) { return p.stem() == posed.photo; });
    if (path == paths.end()) throw InputError(site_.photos(), "no photograph " + posed.photo);
    RequirePhotographSize(*path, posed.camera.width(), posed.camera.height());
    photos_.push_back(ReadPhotograph(*path));
    names_.push_back(posed.photo);
  }
  for (size_t i = 0; i < scene.cameras.size(); ++i) {  // in the scene's order
    const auto at = std::find(names_.begin() + static_cast<std::ptrdiff_t>(i), names_.end(),
                              scene.cameras[i].photo);
    std::swap(photos_[i], photos_[at - names_.begin()]);
    std::swap(names_[i], *at);
  }
  names_.resize(scene.cameras.size());
  photos_.resize(scene.cameras.size());
  return photos_;
}

Json::Value LiveLight(const SitePaths& site, const SceneGeometry& scene, LinearPhotos& photos,
                      std::shared_ptr<const NaturalEnvironment>* environment) {
  if (!std::filesystem::exists(site.survey() / "samples.json")) return Json::nullValue;
  Json::Value message;
  message["failed"] = Json::nullValue;
  message["left_out"] = message["advice"] = Json::Value(Json::arrayValue);
  std::vector<Sentence> left_out;
  try {
    const LightMeasurement measured =
        MeasureDaylightSoFar(site, scene, photos.Of(scene), &photos.sky_blocks, &left_out);
    message["haze"] = HazeJson(measured);
    message["daylight"] = DaylightJson(measured);
    message["samples"]["haze"] =
        ResidualsJson(measured.samples.haze, measured.air_fit.residuals, scene);
    message["samples"]["daylight"] =
        ResidualsJson(measured.samples.daylight, measured.daylight_fit.residuals, scene);
    message["advice"] = AdviceJson(measured);
    if (environment) *environment = std::make_shared<NaturalEnvironment>(measured.environment);
  } catch (const std::exception& error) {
    SentenceOf(error).SayIn(&message, "failed");
  }
  for (const Sentence& fault : left_out) message["left_out"].append(fault.ToJson());
  return message;
}

}  // namespace insitu
