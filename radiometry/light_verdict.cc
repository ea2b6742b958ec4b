// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light_verdict.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibration/files/wording.h"
#include "radiometry/daylight_warnings.h"
#include "radiometry/light/clear_sky.h"
#include "radiometry/sample_verdict.h"

namespace insitu {
namespace {

constexpr double kFaintSun = 2;        // times its sigma
constexpr double kBrightGround = 0.7;  // reflectance that surroundings would need: snow
constexpr double kMuchGround = 0.5;    // [sr] that a sample must see of its surroundings
constexpr double kMuchClipped = 0.05, kTooMuchClipped = 0.3;  // of a polygon's pixels
constexpr double kHazeSigma = 0.05;                 // of the transmittance over kHazeReach
constexpr double kHazeReach = 200;                  // [m]
constexpr double kCleanAir = 0.03, kHazyAir = 0.4;  // aerosol optical depths
constexpr double kBeyondClear = 1.3;                // times what the cleanest air lets through

// ---- sun, sky and what is around ------------------------------------------------------------

void JudgeSun(const LightMeasurement& measured, std::vector<Finding>* findings) {
  if (!measured.environment.scene.sun) {
    findings->push_back({Severity::kNote, "no sun was surveyed: the sky is taken as overcast",
                         "mark tips and their shadows where the photographs show sunlight"});
    return;
  }
  if (!SeesSun(measured.daylight)) {
    findings->push_back({Severity::kFail,
                         "the sun was surveyed, but no daylight sample lies in it: it stays dark",
                         "choose samples in full sun, too; of an overcast day take the sun out of "
                         "survey/directions.json"});
    return;
  }
  const DaylightFit& fit = measured.daylight_fit;
  const double sun = Luminance(fit.sun_radiance, measured.environment);
  const double sigma = Luminance(fit.sun_sigma, measured.environment);
  if (sun < kFaintSun * sigma || sun <= 0) {
    findings->push_back(
        {Severity::kFail,
         "the sun was surveyed, but the samples do not show it: its radiance is found as " +
             ShortNumber(sun) + " +- " + ShortNumber(sigma),
         "look whether the samples that the sun should reach lie in sunlight, and whether its "
         "direction is right; of an overcast day take the sun out of survey/directions.json"});
    return;
  }
  const int bins = measured.environment.spectra.bins().count;
  const auto dark = (fit.sun_radiance.head(bins) <= 0).count();
  if (dark == 0) return;
  findings->push_back({Severity::kReview,
                       "the sun sends nothing in " + std::to_string(dark) + " of " +
                           std::to_string(bins) + " bands of the spectrum",
                       "choose more samples in full sun, of a neutral colour"});
}

// Irradiance on the level.
Spectrum LevelIrradiance(const NaturalEnvironment& environment) {
  const auto elevation = SunElevation(environment.scene);
  const double sine = elevation ? std::sin(*elevation) : 0;
  const Daylight& light = environment.light;
  return light.sun_radiance * light.sun_solid_angle * sine +
         std::numbers::pi * OpenSky(environment);
}

// What the surroundings send by the samples [luminance]; the largest, where they are known.
double BrightestSurroundings(const LightMeasurement& measured) {
  double brightest = 0;
  bool is_known = false;
  for (const DaylightSample& sample : measured.daylight) {
    const double hidden = sample.geometry.ambient - sample.geometry.sky;
    if (!sample.surroundings || hidden < kMuchGround) continue;
    is_known = true;
    brightest = std::max(brightest, Luminance(*sample.surroundings / hidden, measured.environment));
  }
  if (is_known || (!measured.daylight.empty() && measured.daylight[0].surroundings)) {
    return brightest;
  }
  return Luminance(measured.environment.light.ambient_radiance, measured.environment);
}

void JudgeSurroundings(const LightMeasurement& measured, std::vector<Finding>* findings) {
  const double sent = BrightestSurroundings(measured);
  const double received =
      Luminance(LevelIrradiance(measured.environment), measured.environment) / std::numbers::pi;
  const std::string figure = "the surroundings would send " + ShortNumber(sent);
  if (sent > measured.brightest) {
    findings->push_back({Severity::kFail,
                         figure + ", where the photographs show nothing brighter than " +
                             ShortNumber(measured.brightest),
                         "look at daylight_reflectance_rgb and at samples in deep shade: they "
                         "take what others miss for light from around"});
  } else if (received > 0 && sent > kBrightGround * received) {
    findings->push_back(
        {sent > received ? Severity::kFail : Severity::kReview,
         figure + Number(", as if they reflected %.0f %% of the daylight", 100 * sent / received),
         "look at daylight_reflectance_rgb (white paper has 0.9, concrete 0.3 to 0.5) and choose "
         "samples in open and in deep shade; fresh snow alone reflects so much"});
  }
}

void JudgeSunToSky(const LightMeasurement& measured, std::vector<Finding>* findings) {
  const NaturalEnvironment& environment = measured.environment;
  const auto elevation = SunElevation(environment.scene);
  const Spectrum sky = std::numbers::pi * OpenSky(environment);
  const Spectrum sun = environment.light.sun_radiance * environment.light.sun_solid_angle;
  if (!elevation || Luminance(sun, environment) <= 0) return;
  const SpectralBins& bins = environment.spectra.bins();
  const auto clear = [&](double depth) {
    const ClearSky by_model = ClearSkyOf({.sun_elevation = *elevation,
                                          .altitude = environment.scene.origin.z(),
                                          .aerosol_depth = depth},
                                         bins);
    return SunToSky(by_model.sun_normal, by_model.sky_level, *elevation, bins);
  };
  if (Luminance(sky, environment) <= 0) {
    findings->push_back({Severity::kFail, "the sky is found black under a sun that shines",
                         "choose samples in open shade, too"});
    return;
  }
  const double found = SunToSky(sun, sky, *elevation, bins);
  const std::string figures = Number("sun : sky on the level is %.1f", found) +
                              Number(", where a cloudless sky gives %.1f", clear(kHazyAir)) +
                              Number(" (hazy) to %.1f (clean air)", clear(kCleanAir));
  if (found > kBeyondClear * clear(kCleanAir)) {
    findings->push_back({Severity::kReview, figures + ": the sky is found too dark",
                         "choose samples in open shade that see much of the sky; photographs of "
                         "strong contrast (the camera's picture style) do this too"});
  } else if (found < clear(kHazyAir) / kBeyondClear) {
    findings->push_back({Severity::kNote, figures + ": the sun is weak for a cloudless sky",
                         "right under thin cloud, or where clouds light the shade; else look at "
                         "the samples in the sun"});
  }
}

// ---- enough of them -------------------------------------------------------------------------

void JudgeGeometry(const LightMeasurement& measured, std::vector<Finding>* findings) {
  if (measured.daylight_fit.condition > kPoorCondition) {
    findings->push_back({Severity::kReview,
                         Number("the daylight samples hardly tell sun, sky and surroundings apart "
                                "(condition %.0f)",
                                measured.daylight_fit.condition),
                         "choose some in sun, in open shade and in deep shade"});
  }
  if (measured.daylight.size() <= 3) {
    findings->push_back({Severity::kReview, "three daylight samples: an error would not show",
                         "choose a dozen, in several photographs"});
  }
  const auto unseen = NamesOfUnseen(measured);
  if (unseen.empty()) return;
  const bool are_most = 2 * unseen.size() > measured.daylight.size();
  findings->push_back({are_most ? Severity::kReview : Severity::kNote,
                       Listing("daylight samples that no photograph shows the surroundings of, "
                               "which weigh less",
                               unseen, 4),
                       "choose samples whose surroundings lie in a photograph"});
}

// Of the photographs that give the polygons their colour.
void JudgeClipping(const LightMeasurement& measured, std::vector<Finding>* findings) {
  std::vector<std::string> names;
  double largest = 0;
  for (const ClippedShare& clipped : measured.clipped) {
    const SceneGeometry& scene = measured.environment.scene;
    const Polygon& polygon = scene.polygons[clipped.polygon];
    if (clipped.share < kMuchClipped || polygon.photo.value_or(clipped.photo) != clipped.photo) {
      continue;
    }
    names.push_back(polygon.name + Number(" %.0f %% in ", 100 * clipped.share) +
                    scene.cameras[clipped.photo].photo);
    largest = std::max(largest, clipped.share);
  }
  if (names.empty()) return;
  findings->push_back(
      {largest > kTooMuchClipped ? Severity::kReview : Severity::kNote,
       Listing("polygons that are clipped, so that their reflectance is a lower bound", names, 4),
       "photograph shorter, or state a photograph that is not clipped there as the polygon's in "
       "survey/polygons.json; the building's shadow on them comes out too dark"});
}

void JudgeReflectance(const LightMeasurement& measured, std::vector<Finding>* findings) {
  if (measured.reflectance_known) return;
  findings->push_back(
      {Severity::kReview,
       "daylight_reflectance_rgb is not stated and taken as 1: the building comes out too dark",
       "measure it beside a grey card or take it from a table (concrete 0.3 to 0.5) and write it "
       "into survey/samples.json"});
}

// What it costs was measured on a site of known light, by a filmic curve and one with a kink.
void JudgeResponse(const LightMeasurement& measured, std::vector<Finding>* findings) {
  if (measured.assumed_response.empty()) return;
  findings->push_back(
      {Severity::kNote,
       Listing("photographs whose codes are assumed to be light by the curve of their colour space "
               "(sRGB without a word)",
               measured.assumed_response, 4) +
           "; a camera's picture style is another curve, which can put sun : sky off by a tenth "
           "and all brightness by half",
       "put the camera's raw files beside them, to which insitu-light --fit-response fits it, or "
       "state "
       "its curve in photos/response.json"});
}

void JudgeHaze(const LightMeasurement& measured, std::vector<Finding>* findings) {
  if (measured.haze.empty()) {
    findings->push_back({Severity::kNote, "no haze samples: the air is taken as clear",
                         "choose some of one material near and far, where it is hazy"});
    return;
  }
  const int bins = measured.environment.spectra.bins().count;
  const Spectrum& tau = measured.environment.air.transmittance;
  const Spectrum sigma =
      kHazeReach * measured.air_fit.transmittance_sigma * tau.pow(kHazeReach - 1);
  const double mean = sigma.head(bins).mean();
  if (mean < kHazeSigma) return;
  findings->push_back({Severity::kReview,
                       Number("the transmittance over 200 m is known to %.2f only", mean),
                       "choose haze samples of one material at very different distances"});
}

}  // namespace

Spectrum OpenSky(const NaturalEnvironment& environment) {
  return environment.light.sky_radiance + environment.light.ambient_radiance;
}

double Luminance(const Spectrum& light, const NaturalEnvironment& environment) {
  return Tristimulus(light, environment.spectra.bins()).y();
}

std::optional<double> SunElevation(const SceneGeometry& scene) {
  if (!scene.sun) return std::nullopt;
  const double sine = std::clamp(scene.sun->unit.dot(scene.zenith.unit), -1.0, 1.0);
  return sine > 0 ? std::optional(std::asin(sine)) : std::nullopt;
}

std::vector<Finding> JudgeLight(const LightMeasurement& measured) {
  std::vector<Finding> findings;
  JudgeSun(measured, &findings);
  JudgeSamples(measured, &findings);
  JudgeSurroundings(measured, &findings);
  JudgeSunToSky(measured, &findings);
  JudgeGeometry(measured, &findings);
  JudgeClipping(measured, &findings);
  JudgeReflectance(measured, &findings);
  JudgeResponse(measured, &findings);
  JudgeHaze(measured, &findings);
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  return findings;
}

}  // namespace insitu
