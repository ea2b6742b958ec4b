// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/sample_verdict.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "calibration/files/wording.h"
#include "radiometry/daylight_warnings.h"
#include "radiometry/measure/robust_weights.h"

namespace insitu {
namespace {

constexpr double kHighResidual = 3, kTooHighResidual = 10;  // RMS in units of sigma
constexpr double kDifferentEv = 0.1, kTooDifferentEv = 0.25;
constexpr int kEnoughPoints = 20;         // shared, to tell an exposure
constexpr double kUnsureExposure = 0.05;  // relative sigma
constexpr double kContradiction = 0.25;   // of logarithms: EXIF rounds to thirds of a stop
constexpr double kMuchFalloff = 0.05;
constexpr double kDarkerPhoto = 0.1;  // a photograph's median residual beside the others'
constexpr double kSignificant = 3;    // times the standard error

std::string Percent(double share) { return Number("%+.0f %%", 100 * share); }

// ---- the samples' material ------------------------------------------------------------------

std::map<std::string, std::set<std::string>> PolygonsOfMaterials(
    const std::vector<PixelSample>& samples, const SceneGeometry& scene) {
  std::map<std::string, std::set<std::string>> polygons;
  for (const PixelSample& sample : samples) {
    const Polygon& polygon = scene.polygons[*sample.polygon];
    polygons[polygon.material].insert(polygon.name);
  }
  return polygons;
}

void JudgeMaterials(const std::string& list, const std::vector<PixelSample>& samples,
                    const NaturalEnvironment& environment, std::vector<Finding>* findings) {
  const auto polygons = PolygonsOfMaterials(samples, environment.scene);
  std::vector<std::string> names, mirrors;
  for (const auto& [material, of_it] : polygons) {
    names.push_back(material + " on " + *of_it.begin());
    const auto& specular = environment.materials.at(material).specular;
    if (specular && specular->weight > 0) mirrors.push_back(material + " on " + *of_it.begin());
  }
  if (names.size() > 1) {
    findings->push_back({Severity::kFail,
                         Listing(list + " samples lie on several materials", names),
                         "choose them all on one diffuse material; where these are one and the "
                         "same, give their polygons one name of material"});
  }
  if (!mirrors.empty()) {
    findings->push_back({Severity::kFail, Listing(list + " samples lie on what mirrors", mirrors),
                         "choose a matt surface: what a mirror shows is not its own colour"});
  }
}

// ---- residuals ------------------------------------------------------------------------------

// The samples that are off by most, with their residuals.
std::vector<std::string> Worst(const std::vector<PixelSample>& samples,
                               const std::vector<double>& residuals,
                               const std::vector<double>& over_sigma, double limit,
                               const SceneGeometry& scene) {
  std::vector<size_t> order;
  for (size_t i = 0; i < over_sigma.size(); ++i) {
    if (over_sigma[i] > limit) order.push_back(i);
  }
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return over_sigma[a] > over_sigma[b]; });
  std::vector<std::string> names;
  for (const size_t i : order) {
    names.push_back(NameOf(samples[i], scene) + " by " + Percent(residuals[i]));
  }
  return names;
}

void JudgeResiduals(const std::string& list, const std::vector<PixelSample>& samples, double rms,
                    const std::vector<double>& residuals, const std::vector<double>& over_sigma,
                    const SceneGeometry& scene, std::vector<Finding>* findings) {
  const auto worst =
      Worst(samples, residuals, over_sigma, std::max(kHighResidual, 1.5 * rms), scene);
  if (rms <= kHighResidual) {
    if (!worst.empty()) {
      findings->push_back({Severity::kNote, Listing(list + " samples that are off", worst, 4),
                           "look whether a shadow, a stain or another material lies there"});
    }
    return;
  }
  findings->push_back(
      {rms > kTooHighResidual ? Severity::kFail : Severity::kReview,
       list + Number(" samples contradict one another: residuals of %.1f sigma", rms) +
           (worst.empty() ? "" : "; " + Listing("the worst", worst, 4)),
       "leave out samples in shadows that no polygon throws, on stains or on other materials; "
       "where all are off, photographs of different exposure or edited ones are the cause"});
}

// The paper's ambient light is no samples' fault.
void JudgeSimplified(const LightMeasurement& measured, std::vector<Finding>* findings) {
  const DaylightFit& fit = measured.daylight_fit;
  if (fit.rms <= kHighResidual) return;
  findings->push_back(
      {Severity::kReview,
       Number("daylight samples contradict the simplified light: residuals of %.1f sigma", fit.rms),
       "measure without --uniform-ambient and --bounces 0, which leave out how light comes back "
       "from the surroundings"});
}

// ---- exposure -------------------------------------------------------------------------------

std::set<int> SampledPhotos(const LightSamples& samples) {
  std::set<int> photos;
  for (const auto* list : {&samples.horizon, &samples.haze, &samples.daylight}) {
    for (const PixelSample& sample : *list) photos.insert(sample.photo);
  }
  return photos;
}

// Whether surfaces that others show too tell a photograph's exposure.
bool IsMeasured(const LightMeasurement& measured, int photo) {
  const std::vector<PhotoExposure>& fit = measured.exposure_fit.photos;
  return !fit.empty() && fit[photo].points >= kEnoughPoints;
}

// Of the photographs that EXIF alone tells of, what was not brought to one unit.
void JudgeStatedExposures(const LightMeasurement& measured, std::vector<Finding>* findings) {
  std::map<double, std::string> photo_of_ev;
  for (const int photo : SampledPhotos(measured.samples)) {
    if (measured.exposures.empty() || IsMeasured(measured, photo)) continue;
    const auto relative = measured.exposures[photo].Relative();
    if (!relative) continue;
    const auto& fit = measured.exposure_fit.photos;
    const double left = *relative / (fit.empty() ? 1 : fit[photo].gain.y());
    photo_of_ev[std::log2(left)] = measured.environment.scene.cameras[photo].photo;
  }
  if (photo_of_ev.empty()) return;
  const double spread = photo_of_ev.rbegin()->first - photo_of_ev.begin()->first;
  if (spread <= kDifferentEv) return;
  findings->push_back(
      {spread > kTooDifferentEv ? Severity::kFail : Severity::kReview,
       "the samples come from photographs of different exposure: by EXIF " +
           photo_of_ev.rbegin()->second + Number(" got %.1f EV more light than ", spread) +
           photo_of_ev.begin()->second,
       "survey polygons that both show, or choose all samples in photographs of one exposure"});
}

// What was brought to one unit, and photographs that do not fit.
void JudgeMeasuredExposures(const LightMeasurement& measured, std::vector<Finding>* findings) {
  std::vector<std::string> brought, unsure, contradicted, tinted;
  for (size_t i = 0; i < measured.exposure_fit.photos.size(); ++i) {
    const PhotoExposure& fit = measured.exposure_fit.photos[i];
    const std::string& photo = measured.environment.scene.cameras[i].photo;
    if (!fit.IsOne()) {
      const std::string text = photo + Number(" by %+.2f EV", std::log2(fit.measured)) +
                               Number(" +- %.2f", fit.sigma / std::log(2.0));
      (fit.sigma < kUnsureExposure ? brought : unsure).push_back(text);
      if (fit.gain.maxCoeff() > fit.gain.minCoeff()) {
        tinted.push_back(photo + Number(" (red %.2f,", fit.white_balance[0]) +
                         Number(" blue %.2f)", fit.white_balance[2]));
      }
    }
    if (!fit.by_exif || fit.points < kEnoughPoints) continue;
    const double off = std::log(*fit.by_exif / fit.measured);
    if (std::abs(off) < kContradiction + 3 * fit.sigma) continue;
    contradicted.push_back(photo + Number(" by %+.1f EV", -std::log2(std::exp(off))));
  }
  const auto say = [&](Severity severity, const char* what, const std::vector<std::string>& names,
                       const char* remedy) {
    if (names.empty()) return;
    findings->push_back({severity, Listing(what, names, 4), remedy});
  };
  say(Severity::kNote, "photographs of other exposure, brought to one unit", brought,
      "nothing; photographs made in manual mode need none of it");
  say(Severity::kReview, "photographs whose exposure is known badly", unsure,
      "survey polygons that several photographs show");
  say(Severity::kNote, "photographs of another white balance, brought to one", tinted,
      "set the camera to one white balance");
  say(Severity::kReview, "photographs that are brighter or darker than EXIF says", contradicted,
      "look whether they were edited or raw-developed one by one; develop them alike");
}

void JudgeFalloff(const ExposureFit& fit, std::vector<Finding>* findings) {
  if (!fit.corner_falloff) return;
  const double off = std::abs(*fit.corner_falloff);
  if (off < kMuchFalloff || off < kSignificant * fit.corner_falloff_sigma) return;
  findings->push_back(
      {Severity::kReview,
       Number("the photographs' corners are %+.0f %% beside their centres",
              100 * std::expm1(*fit.corner_falloff)) +
           Number(" (+- %.0f): vignetting", 100 * fit.corner_falloff_sigma),
       "let the camera or the raw developer correct it; choose samples near the centres"});
}

// Whatever else says: a photograph whose samples are all too bright or too dark.
void JudgeExposuresByResiduals(const LightMeasurement& measured, std::vector<Finding>* findings) {
  std::map<int, std::vector<double>> of_photo;
  const std::vector<double>& residuals = measured.daylight_fit.residuals;
  for (size_t i = 0; i < residuals.size(); ++i) {
    of_photo[measured.samples.daylight[i].photo].push_back(residuals[i]);
  }
  for (const auto& [photo, own] : of_photo) {
    std::vector<double> others;
    for (const auto& [other, theirs] : of_photo) {
      if (other != photo) others.insert(others.end(), theirs.begin(), theirs.end());
    }
    if (own.size() < 3 || others.size() < 3) continue;
    const double difference = Median(own) - Median(others);
    std::vector<double> deviations;
    for (const double residual : own) deviations.push_back(std::abs(residual - Median(own)));
    for (const double residual : others) deviations.push_back(std::abs(residual - Median(others)));
    const double error =
        kSigmaOverMedian * Median(deviations) * std::sqrt(1.0 / own.size() + 1.0 / others.size());
    if (std::abs(difference) < std::max(kDarkerPhoto, kSignificant * error)) continue;
    findings->push_back({Severity::kReview,
                         "the samples in " + measured.environment.scene.cameras[photo].photo +
                             " are " + Percent(difference) +
                             " beside those in other photographs: it seems to be of another "
                             "exposure",
                         "choose all samples in photographs of one exposure"});
    return;
  }
}

}  // namespace

void JudgeSamples(const LightMeasurement& measured, std::vector<Finding>* findings) {
  const NaturalEnvironment& environment = measured.environment;
  const LightSamples& samples = measured.samples;
  const AtmosphereFit& air = measured.air_fit;
  const DaylightFit& light = measured.daylight_fit;
  JudgeMaterials("daylight", samples.daylight, environment, findings);
  JudgeMaterials("haze", samples.haze, environment, findings);
  if (measured.is_simplified) {
    JudgeSimplified(measured, findings);
  } else {
    JudgeResiduals("daylight", samples.daylight, light.rms, light.residuals, light.over_sigma,
                   environment.scene, findings);
  }
  JudgeResiduals("haze", samples.haze, air.rms, air.residuals, air.over_sigma, environment.scene,
                 findings);
  JudgeStatedExposures(measured, findings);
  JudgeMeasuredExposures(measured, findings);
  JudgeExposuresByResiduals(measured, findings);
  JudgeFalloff(measured.exposure_fit, findings);
}

}  // namespace insitu
