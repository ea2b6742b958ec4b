// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light_report.h"

#include <cmath>
#include <numbers>
#include <ostream>
#include <sstream>

#include "calibration/files/json_file.h"
#include "radiometry/natural_environment.h"

namespace insitu {
namespace {

constexpr double kReportedDistance = 200;  // [m]

Json::Value SamplesToJson(const std::vector<PixelSample>& samples,
                          const std::vector<double>& residuals, const SceneGeometry& scene) {
  Json::Value array(Json::arrayValue);
  for (size_t i = 0; i < residuals.size(); ++i) {
    Json::Value json;
    json["photo"] = scene.cameras[samples[i].photo].photo;
    json["pixel"] = ToJson(Eigen::VectorXd(samples[i].pixel));
    json["polygon"] = scene.polygons[*samples[i].polygon].name;
    json["distance"] = samples[i].distance;
    json["relative_residual"] = residuals[i];
    array.append(json);
  }
  return array;
}

void AddAir(const LightMeasurement& measured, Json::Value* air) {
  const NaturalEnvironment& environment = measured.environment;
  const SpectralBins& bins = environment.spectra.bins();
  const AtmosphereFit& fit = measured.air_fit;
  Json::Value& json = *air;
  json["horizon_rgb"] = ToJson(environment.spectra.RgbFromSpectrum(environment.air.horizon));
  json["transmittance_per_m_sigma"] = BinsJson(fit.transmittance_sigma, bins);
  json["transmittance_200m_rgb"] = ToJson(TransmittanceRgb(environment, kReportedDistance));
  json["condition"] = BinsJson(fit.condition, bins);
  json["rms_over_sigma"] = fit.rms;
  json["samples"] = SamplesToJson(measured.samples.haze, fit.residuals, environment.scene);
}

double MeanOverBins(const Spectrum& spectrum, const SpectralBins& bins) {
  return spectrum.head(bins.count).mean();
}

// What was found of the sky's shape, a uniform one's too.
void AddSky(const LightMeasurement& measured, Json::Value* sky) {
  const SkyFit& fit = measured.sky.fit;
  const SpectralBasis& spectra = measured.environment.spectra;
  Json::Value& json = *sky;
  json["is_uniform"] = fit.shape.IsUniform();
  json["photos"] = measured.sky.photos;
  json["cells"] = fit.cells;
  if (!fit.level) return;
  json["gradation_sigma"] = BinsJson(fit.sigma.gradation, spectra.bins());
  json["glow_sigma"] = BinsJson(fit.sigma.glow, spectra.bins());
  json["photographed_rgb"] = ToJson(spectra.RgbFromSpectrum(*fit.level));
  json["photographed_radiance"] = BinsJson(*fit.level, spectra.bins());
  json["photographed_radiance_sigma"] = BinsJson(fit.level_sigma, spectra.bins());
  if (const auto& residual = measured.daylight_fit.sky_over_sigma) {
    json["residual_over_sigma"] = *residual;  // of the inversion, in which it counted
  }
  json["heights"].append(fit.lowest);
  json["heights"].append(fit.highest);
  json["rms_of_ln"] = fit.rms;
}

// The paper's L, that of D65 or as stated. [Durisch92, §7]
Spectrum RelativeSpectrum(const LightMeasurement& measured) {
  const SpectralBins& bins = measured.environment.spectra.bins();
  const auto& table = measured.samples.daylight_spectrum;
  return table ? Sampled(*table, bins) : IlluminantD65(bins);
}

// The paper's k, one for all wavelengths: that of the same luminance. [Durisch92, §4.3]
double WeightOf(const Spectrum& radiance, const LightMeasurement& measured) {
  const SpectralBins& bins = measured.environment.spectra.bins();
  return Tristimulus(radiance, bins).y() / Tristimulus(RelativeSpectrum(measured), bins).y();
}

// A row of the paper's table, in whose unit rho = 1 / sr at the samples: ours is 1 / pi there.
// [Durisch92, Tab. 1]
Json::Value TableOne(const LightMeasurement& measured) {
  const NaturalEnvironment& environment = measured.environment;
  const Daylight& light = environment.light;
  const auto weight = [&](const Spectrum& radiance) {
    return WeightOf(radiance, measured) / std::numbers::pi;
  };
  Json::Value json;
  json["input_images"] = static_cast<int>(environment.scene.cameras.size());
  json["natural_polygons"] = static_cast<int>(environment.scene.polygons.size());
  if (environment.scene.sun) {
    json["omega_s"] = light.sun_solid_angle;
    json["k_s"] = weight(light.sun_radiance);
  }
  json["k_u"] = weight(light.ambient_radiance);
  json["m_h"] = light.polar_facets;
  json["k_h"] = weight(light.sky_radiance);
  return json;
}

void AddLight(const LightMeasurement& measured, Json::Value* light) {
  const NaturalEnvironment& environment = measured.environment;
  const SpectralBasis& spectra = environment.spectra;
  const Daylight& daylight = environment.light;
  const DaylightFit& fit = measured.daylight_fit;
  Json::Value& json = *light;
  json["relative_spectrum"] = BinsJson(RelativeSpectrum(measured), spectra.bins());
  json["k_s"] = WeightOf(daylight.sun_radiance, measured);
  json["k_u"] = WeightOf(daylight.ambient_radiance, measured);
  json["k_h"] = WeightOf(daylight.sky_radiance, measured);
  if (measured.as_printed) json["table_1"] = TableOne(measured);
  json["sun_radiance_sigma"] = BinsJson(fit.sun_sigma, spectra.bins());
  json["sun_irradiance_rgb"] = ToJson(SunIrradianceRgb(environment));
  json["ambient_radiance_sigma"] = BinsJson(fit.ambient_sigma, spectra.bins());
  json["ambient_radiance_rgb"] = ToJson(spectra.RgbFromSpectrum(daylight.ambient_radiance));
  json["sky_radiance_sigma"] = BinsJson(fit.sky_sigma, spectra.bins());
  json["sky_radiance_rgb"] = ToJson(spectra.RgbFromSpectrum(daylight.sky_radiance));
  json["open_sky_radiance_rgb"] = ToJson(OpenSkyRgb(environment));
  AddSky(measured, &json["seen_sky"]);
  json["reflectance_known"] = measured.reflectance_known;
  json["condition"] = fit.condition;
  json["rms_over_sigma"] = fit.rms;
  json["samples"] = SamplesToJson(measured.samples.daylight, fit.residuals, environment.scene);
}

// Where a photograph is of another exposure than the site's unit.
void AddExposures(const ExposureFit& fit, Json::Value* cameras) {
  for (Json::ArrayIndex i = 0; i < fit.photos.size(); ++i) {
    if (!fit.photos[i].IsOne()) (*cameras)[i]["exposure"] = ToJson(fit.photos[i].gain);
  }
}

Json::Value Provenance(const SceneGeometry& scene) {
  Json::Value json;
  json["software"] = "insitu " INSITU_VERSION;
  for (const char* input : {"work/reconstruction/scene.json", "work/input_images",
                            "survey/samples.json", "survey/materials.json", "survey/foreground"}) {
    json["inputs"].append(input);
  }
  for (const PosedCamera& posed : scene.cameras) json["inputs"].append("photos/" + posed.photo);
  return json;
}

// "0.52 px, 61 edges", or why there is none.
void PrintQuality(const ImageQuality& quality, std::ostream& out) {
  if (const auto& spread = quality.point_spread) {
    out << "point spread sigma " << spread->center_sigma;
    if (spread->corner_sigma != spread->center_sigma) {
      out << " px in the centre, " << spread->corner_sigma;
    }
    out << " px (+- " << spread->sigma_error << ", " << spread->edges << " pieces of edges)";
  } else {
    out << "too few sharp, straight edges for its point spread: rendered as ideal";
  }
  if (const auto& grain = quality.grain) {
    const Eigen::Vector3d sigma = grain->Variance(Eigen::Vector3d::Constant(0.18)).cwiseSqrt();
    out << "; grain " << 100 * sigma[1] / 0.18 << " % at mid grey";
  }
  out << "\n";
}

std::ostream& operator<<(std::ostream& out, const Eigen::Vector3d& rgb) {
  return out << rgb[0] << " " << rgb[1] << " " << rgb[2];
}

// Uniform, or how it is spread; and how bright the photographs show it.
void PrintSky(const LightMeasurement& measured, std::ostream& out) {
  const SkyFit& fit = measured.sky.fit;
  const SpectralBasis& spectra = measured.environment.spectra;
  const auto mean = [&](const Spectrum& spectrum) {
    return MeanOverBins(spectrum, spectra.bins());
  };
  out << "Sky by direction    ";
  if (!fit.level) {
    out << "no photograph shows enough of it: taken as uniform\n";
    return;
  }
  if (fit.shape.IsUniform()) {
    out << "uniform, gradation 0 +- " << mean(fit.sigma.gradation);
  } else {
    out << "gradation " << mean(fit.shape.gradation) << " +- " << mean(fit.sigma.gradation)
        << ", glow " << mean(fit.shape.glow) << " +- " << mean(fit.sigma.glow);
  }
  constexpr double kToDegrees = 180 / std::numbers::pi;
  out << "; " << fit.cells << " places in " << measured.sky.photos << " photographs, "
      << std::lround(kToDegrees * fit.lowest) << " to " << std::lround(kToDegrees * fit.highest)
      << " degrees high, photographed as " << spectra.RgbFromSpectrum(*fit.level) << " +- "
      << 100 * mean(fit.level_sigma) / mean(*fit.level) << " %";
  if (const auto& residual = measured.daylight_fit.sky_over_sigma) {
    out << ", met to " << *residual << " sigma";
  }
  out << "\n";
}

void PrintTableOne(const Json::Value& row, std::ostream& out) {
  out << "As in Table 1:     ";
  if (row.isMember("k_s")) {
    out << " Omega_s " << std::defaultfloat << row["omega_s"].asDouble() << " sr, k_s "
        << std::fixed << row["k_s"].asDouble() << ",";
  }
  out << " k_u " << row["k_u"].asDouble() << ", m_h " << row["m_h"].asInt() << ", k_h "
      << row["k_h"].asDouble() << "\n";
}

}  // namespace

Eigen::Vector3d TransmittanceRgb(const NaturalEnvironment& environment, double distance) {
  const SpectralBasis& spectra = environment.spectra;
  const Spectrum white = spectra.SpectrumFromRgb(Eigen::Vector3d::Ones());
  return spectra.RgbFromSpectrum(white * TransmittanceOver(environment.air, distance));
}

Eigen::Vector3d SunIrradianceRgb(const NaturalEnvironment& environment) {
  const Daylight& light = environment.light;
  return environment.spectra.RgbFromSpectrum(light.sun_radiance * light.sun_solid_angle);
}

Eigen::Vector3d OpenSkyRgb(const NaturalEnvironment& environment) {
  const Daylight& light = environment.light;
  return environment.spectra.RgbFromSpectrum(light.sky_radiance + light.ambient_radiance);
}

std::string BriefReport(const LightMeasurement& measured) {
  const NaturalEnvironment& environment = measured.environment;
  const DaylightFit& fit = measured.daylight_fit;
  const SpectralBasis& spectra = environment.spectra;
  const Daylight& light = environment.light;
  std::ostringstream out;
  out.setf(std::ios::fixed);
  out.precision(3);
  out << "Horizon colour      " << spectra.RgbFromSpectrum(environment.air.horizon) << " (RGB)\n"
      << "Haze: transmittance " << TransmittanceRgb(environment, kReportedDistance)
      << " over 200 m, " << measured.samples.haze.size() << " samples, residuals "
      << measured.air_fit.rms << " sigma\n"
      << "Sun: irradiance     " << SunIrradianceRgb(environment) << " across its rays\n"
      << "Sky: radiance       " << spectra.RgbFromSpectrum(light.sky_radiance) << "\n"
      << "Ambient: radiance   " << spectra.RgbFromSpectrum(light.ambient_radiance)
      << ", with the sky " << OpenSkyRgb(environment) << "\n";
  PrintSky(measured, out);
  out << "Daylight: " << measured.samples.daylight.size() << " samples, residuals " << fit.rms
      << " sigma, condition " << fit.condition << "\n";
  if (measured.as_printed) PrintTableOne(TableOne(measured), out);
  for (size_t i = 0; i < environment.qualities.size(); ++i) {
    out << environment.scene.cameras[i].photo << ": ";
    PrintQuality(environment.qualities[i], out);
  }
  return out.str();
}

std::vector<Eigen::Vector3d> ReadPhotoGains(const SitePaths& site) {
  RequireResult(site.environment(), "insitu-light");
  std::vector<Eigen::Vector3d> gains;
  for (const JsonNode& camera :
       JsonNode::Load(site.environment()).At("scene").At("cameras").Items()) {
    const auto exposure = camera.Find("exposure");
    gains.push_back(exposure ? exposure->Vector3() : Eigen::Vector3d(Eigen::Vector3d::Ones()));
    if (gains.back().minCoeff() <= 0) throw exposure->Error("is no exposure, expected above 0");
  }
  return gains;
}

void WriteEnvironment(const SitePaths& site, const LightMeasurement& measured) {
  Json::Value json = DescriptionOf(measured.environment, site.environment());
  AddExposures(measured.exposure_fit, &json["scene"]["cameras"]);
  json["provenance"] = Provenance(measured.environment.scene);
  AddAir(measured, &json["air"]);
  AddLight(measured, &json["light"]);
  json["warnings"] = Json::Value(Json::arrayValue);
  for (const Sentence& warning : measured.warnings) json["warnings"].append(warning.text());
  WriteJson(site.environment(), json);
}

}  // namespace insitu
