// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light_page.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/photo_thumbnail.h"
#include "calibration/program/finding.h"
#include "calibration/program/report_page.h"
#include "calibration/program/report_paths.h"
#include "radiometry/light/clear_sky.h"
#include "radiometry/light_page_script.h"
#include "radiometry/light_verdict.h"
#include "radiometry/measure/further_sample.h"
#include "radiometry/spectrum/color_temperature.h"

namespace insitu {
namespace {

constexpr double kKoschmieder = 3.912;  // -ln 0.02: contrast at the meteorological range
constexpr double kDegree = std::numbers::pi / 180;

// Null where there is none.
Json::Value OrNull(const std::optional<double>& value) {
  return value ? Json::Value(*value) : Json::Value();
}

// ---- samples --------------------------------------------------------------------------------

Json::Value SampleJson(const PixelSample& sample, const SceneGeometry& scene) {
  Json::Value json;
  json["photo"] = scene.cameras[sample.photo].photo;
  json["x"] = sample.pixel.x();
  json["y"] = sample.pixel.y();
  if (sample.polygon) {
    json["polygon"] = scene.polygons[*sample.polygon].name;
    json["material"] = scene.polygons[*sample.polygon].material;
    json["distance_m"] = sample.distance;
  }
  return json;
}

Json::Value SamplesJson(const std::vector<PixelSample>& samples, const SceneGeometry& scene,
                        const std::vector<double>& residuals = {},
                        const std::vector<double>& over_sigma = {}) {
  Json::Value list(Json::arrayValue);
  for (size_t i = 0; i < samples.size(); ++i) {
    Json::Value json = SampleJson(samples[i], scene);
    if (i < residuals.size()) {
      json["residual"] = residuals[i];
      json["sigmas"] = over_sigma[i];
    }
    list.append(json);
  }
  return list;
}

Json::Value DaylightSamplesJson(const LightMeasurement& measured) {
  const DaylightFit& fit = measured.daylight_fit;
  Json::Value list = SamplesJson(measured.samples.daylight, measured.environment.scene,
                                 fit.residuals, fit.over_sigma);
  for (Json::ArrayIndex i = 0; i < list.size(); ++i) {
    const DaylightSample& sample = measured.daylight[i];
    list[i]["radiance"] = Luminance(sample.true_color, measured.environment);
    list[i]["sun_cosine"] = sample.geometry.sun / measured.environment.light.sun_solid_angle;
    list[i]["sky_share"] = sample.geometry.sky / std::numbers::pi;
    if (i < measured.unseen.size()) list[i]["unseen_share"] = measured.unseen[i];
  }
  return list;
}

Json::Value PhotosJson(const SitePaths& site, const LightMeasurement& measured) {
  const LightSamples& samples = measured.samples;
  std::set<int> sampled;
  for (const auto* list : {&samples.horizon, &samples.haze, &samples.daylight}) {
    for (const PixelSample& sample : *list) sampled.insert(sample.photo);
  }
  const std::vector<std::filesystem::path> paths = ListPhotographs(site);
  Json::Value list(Json::arrayValue);
  for (const int photo : sampled) {
    const PosedCamera& posed = measured.environment.scene.cameras[photo];
    Json::Value json;
    json["photo"] = posed.photo;
    json["width"] = posed.camera.width();
    json["height"] = posed.camera.height();
    if (!measured.exposures.empty()) {
      const ExifExposure& exposure = measured.exposures[photo];
      json["time_s"] = OrNull(exposure.time_s);
      json["f_number"] = OrNull(exposure.f_number);
      json["iso"] = OrNull(exposure.iso);
    }
    const auto path = std::find_if(paths.begin(), paths.end(),
                                   [&](const auto& p) { return p.stem() == posed.photo; });
    const auto thumbnail = path == paths.end() ? std::nullopt : PhotoThumbnail(*path);
    if (thumbnail) json["thumbnail"] = *thumbnail;
    list.append(json);
  }
  return list;
}

// Of all photographs, sampled or not.
Json::Value ExposuresJson(const LightMeasurement& measured) {
  Json::Value json;
  json["photos"] = Json::Value(Json::arrayValue);
  const ExposureFit& fit = measured.exposure_fit;
  for (size_t i = 0; i < fit.photos.size(); ++i) {
    const PhotoExposure& photo = fit.photos[i];
    Json::Value row;
    row["photo"] = measured.environment.scene.cameras[i].photo;
    row["gain"] = ToJson(photo.gain);
    row["measured"] = photo.measured;
    row["sigma"] = photo.sigma;
    row["points"] = photo.points;
    row["by_exif"] = OrNull(photo.by_exif);
    row["white_balance"] = ToJson(photo.white_balance);
    json["photos"].append(row);
  }
  json["corner_falloff"] = OrNull(fit.corner_falloff);
  json["corner_falloff_sigma"] = fit.corner_falloff_sigma;
  return json;
}

// ---- light ----------------------------------------------------------------------------------

// The spread that a light's errors give its reciprocal temperature. Bins of one third of the
// spectrum hang together, for they come from one channel.
std::optional<double> KelvinSigma(const Spectrum& light, const Spectrum& sigma,
                                  const SpectralBins& bins) {
  const auto at = CorrelatedColorTemperature(light, bins);
  if (!at) return std::nullopt;
  double variance = 0;
  for (int third = 0; third < 3; ++third) {
    Spectrum moved = light;
    for (int i = third * bins.count / 3; i < (third + 1) * bins.count / 3; ++i) {
      moved[i] += 0.1 * sigma[i];
    }
    const auto other = CorrelatedColorTemperature(moved, bins);
    if (!other) return std::nullopt;
    variance += std::pow((1 / other->kelvin - 1 / at->kelvin) / 0.1, 2);
  }
  return std::sqrt(variance) * at->kelvin * at->kelvin;
}

Json::Value LightJson(const Spectrum& light, const Spectrum& sigma,
                      const NaturalEnvironment& environment) {
  const SpectralBins& bins = environment.spectra.bins();
  Json::Value json;
  json["spectrum"] = BinsJson(light, bins);
  json["sigma"] = BinsJson(sigma, bins);
  json["luminance"] = Luminance(light, environment);
  json["luminance_sigma"] = Luminance(sigma, environment);
  if (const auto temperature = CorrelatedColorTemperature(light, bins)) {
    json["kelvin"] = temperature->kelvin;
    json["duv"] = temperature->duv;
    json["kelvin_sigma"] = OrNull(KelvinSigma(light, sigma, bins));
  }
  return json;
}

// What cloudless skies send, from clean to hazy air.
Json::Value ClearSkiesJson(double elevation, const NaturalEnvironment& environment) {
  const SpectralBins& bins = environment.spectra.bins();
  Json::Value list(Json::arrayValue);
  for (const double depth : {0.03, 0.1, 0.2, 0.4}) {
    const ClearSky sky = ClearSkyOf({.sun_elevation = elevation,
                                     .altitude = environment.scene.origin.z(),
                                     .aerosol_depth = depth},
                                    bins);
    Json::Value json;
    json["aerosol_depth"] = depth;
    json["sun_to_sky"] = SunToSky(sky.sun_normal, sky.sky_level, elevation, bins);
    for (const auto& [name, light] :
         {std::pair("sun_kelvin", &sky.sun_normal), std::pair("sky_kelvin", &sky.sky_level)}) {
      const auto temperature = CorrelatedColorTemperature(*light, bins);
      json[name] = temperature ? Json::Value(temperature->kelvin) : Json::Value();
    }
    list.append(json);
  }
  return list;
}

Json::Value DaylightJson(const LightMeasurement& measured) {
  const NaturalEnvironment& environment = measured.environment;
  const DaylightFit& fit = measured.daylight_fit;
  const double disc = environment.light.sun_solid_angle;
  const Spectrum sun = environment.light.sun_radiance * disc;
  Json::Value json;
  json["rms_over_sigma"] = fit.rms;
  json["condition"] = fit.condition;
  json["sun"] = LightJson(sun, fit.sun_sigma * disc, environment);
  json["sky"] = LightJson(OpenSky(environment), fit.sky_sigma, environment);
  json["ambient"] = LightJson(environment.light.ambient_radiance, fit.ambient_sigma, environment);
  const auto elevation = SunElevation(environment.scene);
  const double sky = std::numbers::pi * json["sky"]["luminance"].asDouble();
  if (!elevation || sky <= 0) return json;
  json["sun_elevation_deg"] = *elevation / kDegree;
  const double sun_to_sky = json["sun"]["luminance"].asDouble() * std::sin(*elevation) / sky;
  json["sun_to_sky"] = sun_to_sky;
  const double sun_part = json["sun"]["luminance_sigma"].asDouble() /
                          std::max(1e-12, json["sun"]["luminance"].asDouble());
  const double sky_part =
      json["sky"]["luminance_sigma"].asDouble() / json["sky"]["luminance"].asDouble();
  json["sun_to_sky_sigma"] = sun_to_sky * std::hypot(sun_part, sky_part);
  json["clear_skies"] = ClearSkiesJson(*elevation, environment);
  return json;
}

Json::Value HazeJsonOf(const LightMeasurement& measured) {
  Json::Value json;
  if (measured.haze.empty()) return json;
  const NaturalEnvironment& environment = measured.environment;
  const SpectralBins& bins = environment.spectra.bins();
  const int bin = static_cast<int>((555 - kFirstWavelength) / bins.Width());
  const double tau = environment.air.transmittance[bin];
  const double extinction = -std::log(tau);
  const double sigma = measured.air_fit.transmittance_sigma[bin] / tau;
  json["rms_over_sigma"] = measured.air_fit.rms;
  json["transmittance_per_m"] = BinsJson(environment.air.transmittance, bins);
  json["extinction_per_m"] = extinction;
  json["extinction_sigma_per_m"] = sigma;
  json["range_m"] = extinction > 0 ? Json::Value(kKoschmieder / extinction) : Json::Value();
  json["range_from_m"] = kKoschmieder / (extinction + sigma);
  json["range_to_m"] =
      extinction > sigma ? Json::Value(kKoschmieder / (extinction - sigma)) : Json::Value();
  return json;
}

Json::Value ClippedJson(const LightMeasurement& measured) {
  const SceneGeometry& scene = measured.environment.scene;
  Json::Value list(Json::arrayValue);
  for (const ClippedShare& clipped : measured.clipped) {
    Json::Value json;
    json["polygon"] = scene.polygons[clipped.polygon].name;
    json["photo"] = scene.cameras[clipped.photo].photo;
    json["share"] = clipped.share;
    list.append(json);
  }
  return list;
}

Json::Value AdviceJsonOf(const LightMeasurement& measured) {
  const SpectralBins& bins = measured.environment.spectra.bins();
  Json::Value advice(Json::arrayValue);
  const bool has_sun = measured.environment.scene.sun.has_value();
  if (const auto best = BestFurtherSample(measured.daylight, measured.daylight_fit, measured.brdf,
                                          has_sun, bins)) {
    advice.append("A further daylight sample would tell most " + best->where.text() +
                  Number(": it would leave %.0f %% of the sun's", 100 * best->sun_left) +
                  Number(" and %.0f %% of the sky's standard deviation.", 100 * best->sky_left));
  }
  if (const auto best = BestFurtherSample(measured.haze, measured.air_fit, bins)) {
    advice.append(Number("A further haze sample would tell most %.0f m away: it would leave ",
                         best->distance) +
                  Number("%.0f %% of the transmittance's standard deviation.", 100 * best->left));
  }
  return advice;
}

}  // namespace

Json::Value LightPageReport(const SitePaths& site, const LightMeasurement& measured) {
  const SceneGeometry& scene = measured.environment.scene;
  const SpectralBins& bins = measured.environment.spectra.bins();
  Json::Value report;
  report["verdict"] = VerdictReport(JudgeLight(measured));
  report["wavelengths_nm"] = Json::Value(Json::arrayValue);
  for (int i = 0; i < bins.count; ++i) report["wavelengths_nm"].append(bins.Center(i));
  report["photos"] = PhotosJson(site, measured);
  report["horizon_samples"] = SamplesJson(measured.samples.horizon, scene);
  report["haze_samples"] = SamplesJson(measured.samples.haze, scene, measured.air_fit.residuals,
                                       measured.air_fit.over_sigma);
  report["daylight_samples"] = DaylightSamplesJson(measured);
  report["exposure"] = ExposuresJson(measured);
  report["daylight"] = DaylightJson(measured);
  report["haze"] = HazeJsonOf(measured);
  report["clipped"] = ClippedJson(measured);
  report["advice"] = AdviceJsonOf(measured);
  return report;
}

void WriteLightPage(const SitePaths& site, const Json::Value& report) {
  WriteJson(LightReportPath(site), report);
  WriteWhole(LightPagePath(site), ReportPage("Light", report, kLightPageScript));
}

std::string VerdictLines(const SitePaths& site, const Json::Value& report) {
  const std::vector<Finding> findings = FindingsOf(report["verdict"]);
  std::string text = "Verdict: " + report["verdict"]["status"].asString() + ", see " +
                     LightPagePath(site).string() + "\n";
  for (const Finding& finding : findings) {
    text += std::string("  ") + Word(finding.severity) + ": " + finding.reason;
    text += (finding.remedy.empty() ? "" : "; " + finding.remedy) + "\n";
  }
  return text;
}

}  // namespace insitu
