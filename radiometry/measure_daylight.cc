// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure_daylight.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "calibration/files/error.h"
#include "calibration/program/program.h"
#include "radiometry/daylight_warnings.h"
#include "radiometry/measure/measure_image_quality.h"
#include "radiometry/measure/photograph_set.h"
#include "radiometry/one_unit.h"
#include "radiometry/site_photographs.h"
#include "radiometry/transport/photographed_light.h"
#include "reconstruction/geometry/ray_scene.h"

namespace insitu {
namespace {

constexpr double kUnseenSigma = 0.5;  // of what unseen surroundings are taken to send
constexpr double kCurved = 1e-3;      // share by which twice a code is not twice the light
// While samples are being chosen: at once, within a fraction of the sigmas.
constexpr SurroundingsDetail kSoFar = {
    .directions = 1024, .piece_m = 0.8, .piece_directions = 32, .rounds = 2};

std::map<std::string, NaturalMaterial> MaterialsOfPolygons(const SitePaths& site,
                                                           const SceneGeometry& scene,
                                                           std::vector<Sentence>* warnings) {
  std::map<std::string, NaturalMaterial> materials = ReadNaturalMaterials(site);
  std::string missing;
  for (const Polygon& polygon : scene.polygons) {
    if (!materials.try_emplace(polygon.material).second) continue;
    missing += (missing.empty() ? "" : ", ") + polygon.material;
  }
  if (!missing.empty()) {
    warnings->push_back(Sentence("lightNoMaterial",
                                 "materials without an entry in survey/materials.json, taken as "
                                 "purely diffuse: {materials}",
                                 {{"materials", missing}}));
  }
  return materials;
}

// Of the spectrum that App. A makes of an RGB triplet with independent errors.
Spectrum SpectrumSigma(const SpectralBasis& spectra, const Eigen::Vector3d& rgb_sigma) {
  Spectrum variance = Spectrum::Zero();
  for (int c = 0; c < 3; ++c) {
    variance += spectra.SpectrumFromRgb(Eigen::Vector3d::Unit(c) * rgb_sigma[c]).square();
  }
  return variance.sqrt();
}

Spectrum HorizonColor(const std::vector<PixelSample>& samples, const SpectralBasis& spectra) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const PixelSample& sample : samples) sum += sample.rgb;
  return spectra.SpectrumFromRgb(sum / static_cast<double>(samples.size()));
}

std::vector<HazeSample> HazeSamples(const LightSamples& samples, const SpectralBasis& spectra) {
  std::vector<HazeSample> haze;
  for (const PixelSample& sample : samples.haze) {
    haze.push_back({spectra.SpectrumFromRgb(sample.rgb), SpectrumSigma(spectra, sample.rgb_sigma),
                    sample.distance});
  }
  return haze;
}

void MeasureAir(bool as_printed, LightMeasurement* measured) {
  NaturalEnvironment& environment = measured->environment;
  const Spectrum horizon = HorizonColor(measured->samples.horizon, environment.spectra);
  measured->haze = HazeSamples(measured->samples, environment.spectra);
  if (measured->haze.empty()) {
    measured->warnings.push_back(
        Sentence("lightNoHaze", "samples.json has no haze samples: the air is taken as clear"));
    measured->air_fit.air.horizon = horizon;
  } else {
    measured->air_fit =
        FitAtmosphere(measured->haze, horizon, environment.spectra.bins(), as_printed);
  }
  environment.air = measured->air_fit.air;
}

Daylight IlluminationGeometry(const SceneGeometry& scene, const LightOptions& options) {
  Daylight light;
  light.zenith_direction = scene.zenith.unit;
  light.sun_direction = scene.sun ? scene.sun->unit : scene.zenith.unit;
  light.polar_facets = options.polar_facets;
  if (options.as_printed) {
    light.sun_solid_angle = kPrintedSolidAngle;
    light.sun_is_one_direction = true;
  }
  return light;
}

// The samples' places in the local frame, on the side of their polygon that faces their camera.
std::vector<SurfacePoint> SurfacePoints(const std::vector<PixelSample>& samples,
                                        const SceneGeometry& scene) {
  std::vector<SurfacePoint> points;
  for (const PixelSample& sample : samples) {
    const Eigen::Vector3d to_camera =
        Center(scene.cameras[sample.photo].cam_from_world) - sample.point;
    const Eigen::Vector3d& normal = scene.polygons[*sample.polygon].normal;
    points.push_back({sample.point - scene.origin,
                      normal.dot(to_camera) < 0 ? Eigen::Vector3d(-normal) : normal});
  }
  return points;
}

// What each point sees of the daylight.
std::vector<LightGeometry> TraceLight(const std::vector<SurfacePoint>& points, const RayScene& rays,
                                      const Daylight& light) {
  const SkyFacets facets = MakeSkyFacets(light.zenith_direction, light.polar_facets);
  std::vector<LightGeometry> geometries;
  for (const SurfacePoint& point : points) {
    const Eigen::Vector3d origin = point.position + kSurveyClearance * point.normal;
    geometries.push_back(
        MeasureLight(light, facets, point.normal, [&](const Eigen::Vector3d& to_light) {
          return !rays.IsOccluded({origin, to_light});
        }));
  }
  return geometries;
}

Spectrum SampleBrdf(const LightSamples& samples, const SpectralBasis& spectra,
                    std::vector<Sentence>* warnings) {
  if (samples.reflectance_table) {
    return Sampled(*samples.reflectance_table, spectra.bins()) / std::numbers::pi;
  }
  if (samples.daylight_reflectance) {
    return spectra.ReflectanceFromRgb(*samples.daylight_reflectance) / std::numbers::pi;
  }
  warnings->push_back(Sentence("lightNoReflectance",
                               "samples.json has no daylight_reflectance_rgb: it is taken as 1, so "
                               "the building will come out too dark beside its surroundings"));
  return spectra.Ones() / std::numbers::pi;
}

// Codes that are no multiple of light, and no word of the camera's own curve.
bool HasAssumedResponse(const Photograph& photo) {
  if (photo.encoding == Encoding::kLinear || photo.color.has_response) return false;
  const Eigen::Vector3d quarter = photo.color.Linear(Eigen::Vector3d::Constant(0.25));
  const Eigen::Vector3d half = photo.color.Linear(Eigen::Vector3d::Constant(0.5));
  return (half - 2 * quarter).norm() > kCurved * half.norm();
}

// What each photograph tells by itself.
void MeasurePhotographs(const PhotographSet& photos, Progress* progress,
                        LightMeasurement* measured) {
  NaturalEnvironment& environment = measured->environment;
  for (size_t i = 0; i < photos.size(); ++i) {
    const auto photo = photos[i];
    environment.qualities.push_back(
        {MeasurePointSpread(*photo, EdgePiecesIn(environment.scene, i)), MeasureGrain(*photo)});
    if (HasAssumedResponse(*photo)) {
      measured->assumed_response.push_back(environment.scene.cameras[i].photo);
    }
    progress->Step();
  }
}

std::vector<DaylightSample> DaylightSamples(const LightMeasurement& measured,
                                            const std::vector<LightGeometry>& geometries) {
  const NaturalEnvironment& environment = measured.environment;
  const std::vector<PixelSample>& pixels = measured.samples.daylight;
  std::vector<DaylightSample> samples;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const Spectrum apparent = environment.spectra.SpectrumFromRgb(pixels[i].rgb);
    samples.push_back({TrueColor(apparent, environment.air, pixels[i].distance),
                       SpectrumSigma(environment.spectra, pixels[i].rgb_sigma) /
                           TransmittanceOver(environment.air, pixels[i].distance),
                       geometries[i]});
  }
  return samples;
}

// What the samples receive from around, if the light is that of `fit`.
void SetSurroundings(const PhotographedLight& light, const Spectrum& brdf,
                     std::vector<DaylightSample>* samples, std::vector<double>* unseen) {
  unseen->clear();
  for (size_t i = 0; i < samples->size(); ++i) {
    const GatheredLight around = light.AtFocus(i);
    DaylightSample& sample = (*samples)[i];
    sample.surroundings = around.surroundings_before;
    sample.geometry.sky = around.sky;
    sample.relative_sky = around.relative_sky;
    unseen->push_back(around.unseen / std::numbers::pi);
    // What no photograph shows is known to about half of what it may send.
    const Spectrum guess = kUnseenSigma * brdf * around.surroundings_before *
                           (around.unseen / std::max(std::numbers::pi - around.sky, 1e-9));
    sample.sigma = (sample.sigma.square() + guess.square()).sqrt();
  }
}

DaylightFitOptions FitOptions(const LightMeasurement& measured, const LightOptions& options) {
  const auto& table = measured.samples.daylight_spectrum;
  const SpectralBins& bins = measured.environment.spectra.bins();
  const SkyFit& sky = measured.sky.fit;
  DaylightFitOptions fit;
  fit.average_over_wavelength = options.average_over_wavelength;
  fit.as_printed = options.as_printed;
  if (table) fit.relative_spectrum = Sampled(*table, bins);
  if (measured.reflectance_known && sky.level) fit.sky = {*sky.level, sky.level_sigma};
  return fit;
}

// A sky that is quite another than the samples tell is of another exposure, or their albedo is
// wrong: it does not count, and is warned of.
DaylightFit FitWithOrWithoutSky(const LightMeasurement& measured, bool has_sun,
                                const DaylightFitOptions& options) {
  const SpectralBins& bins = measured.environment.spectra.bins();
  const auto fit_with = [&](const std::optional<SkyObservation>& sky) {
    DaylightFitOptions with = options;
    with.sky = sky;
    return FitDaylight(measured.daylight, measured.brdf, has_sun, bins, with);
  };
  const DaylightFit without = fit_with(std::nullopt);
  const Spectrum lighting = without.sky_radiance + without.ambient_radiance;
  if (!options.sky || IsAnotherSky(options.sky->radiance, lighting, bins)) return without;
  return fit_with(options.sky);
}

// Eq. (9) with photographed surroundings: what no photograph shows of them depends on the light,
// so the two take turns, from the light that (9) finds with ambient light alone.
void FitInSurroundings(const PhotographSet& photos, const std::vector<SurfacePoint>& points,
                       const LightOptions& options, LightMeasurement* measured) {
  const NaturalEnvironment& environment = measured->environment;
  PhotographedLight around(
      {environment.scene, environment.air, environment.spectra, environment.light},
      LocalImages(environment, photos, measured->exposure_fit.photos),
      {points, options.around.piece_m},
      {.bounces = options.bounces,
       .patch_directions = options.around.piece_directions,
       .point_directions = options.around.directions});
  const std::vector<DaylightSample> bare = measured->daylight;
  DaylightFit& fit = measured->daylight_fit;
  const auto refit = [&] {
    const bool has_sun = environment.scene.sun.has_value();
    fit = FitWithOrWithoutSky(*measured, has_sun, FitOptions(*measured, options));
  };
  refit();
  for (int round = 0; round < options.around.rounds; ++round) {
    Daylight light = environment.light;
    light.sun_radiance = fit.sun_radiance;
    light.sky_radiance = fit.sky_radiance + fit.ambient_radiance;
    around.Solve(light);
    measured->daylight = bare;
    SetSurroundings(around, measured->brdf, &measured->daylight, &measured->unseen);
    refit();
  }
}

double BrightestOf(const PhotographSet& photos) {
  float brightest = 0;
  for (size_t i = 0; i < photos.size(); ++i) {
    const auto photo = photos[i];
    const std::vector<float>& values = photo->linear.data;
    if (!values.empty()) brightest = std::max(brightest, *std::ranges::max_element(values));
  }
  return brightest;
}

bool KnowsReflectance(const LightSamples& samples) {
  return samples.daylight_reflectance || samples.reflectance_table;
}

// From the samples.
void MeasureAirAndLight(const SitePaths& site, const PhotographSet& photos,
                        const LightOptions& options, KeptSkyBlocks* kept,
                        LightMeasurement* measured) {
  NaturalEnvironment& environment = measured->environment;
  measured->reflectance_known = !options.as_printed && KnowsReflectance(measured->samples);
  MeasureAir(options.as_printed, measured);
  Daylight& light = environment.light;
  light = IlluminationGeometry(environment.scene, options);
  if (!options.uniform_ambient) {
    measured->sky = MeasureSky(site, photos, measured->samples.horizon,
                               options.average_over_wavelength, kept, &environment);
  }
  const std::vector<SurfacePoint> points =
      SurfacePoints(measured->samples.daylight, environment.scene);
  const RayScene rays(MeshOfPolygons(environment.scene).mesh);
  measured->daylight = DaylightSamples(*measured, TraceLight(points, rays, light));
  const bool has_sun = environment.scene.sun.has_value();
  measured->brdf = options.as_printed
                       ? Spectrum(environment.spectra.Ones() / std::numbers::pi)
                       : SampleBrdf(measured->samples, environment.spectra, &measured->warnings);
  DaylightFit& fit = measured->daylight_fit;
  if (options.uniform_ambient) {
    fit = FitDaylight(measured->daylight, measured->brdf, has_sun, environment.spectra.bins(),
                      FitOptions(*measured, options));
  } else {
    FitInSurroundings(photos, points, options, measured);
  }
  light.sun_radiance = fit.sun_radiance;
  light.ambient_radiance = fit.ambient_radiance;
  light.sky_radiance = fit.sky_radiance;
  measured->is_simplified = options.uniform_ambient || options.bounces == 0;
  measured->as_printed = options.as_printed;
  const std::vector<Sentence> warnings = DaylightWarnings(*measured);
  measured->warnings.insert(measured->warnings.end(), warnings.begin(), warnings.end());
  if (measured->reflectance_known) {
    WarnOfAnotherSky(environment, measured->sky, &measured->warnings);
  }
}

SpectralBasis BasisFor(const LightOptions& options) {
  return {Rec709(), {options.bins}, options.as_printed ? Ntsc1953() : Rec709()};
}

LightMeasurement WithoutSamples(const SitePaths& site, SceneGeometry scene,
                                const SpectralBasis& spectra) {
  LightMeasurement measured;
  NaturalEnvironment& environment = measured.environment;
  environment.scene = std::move(scene);
  environment.spectra = spectra;
  environment.materials = MaterialsOfPolygons(site, environment.scene, &measured.warnings);
  return measured;
}

// Haze that cannot be told is left out; light needs the others.
void RequireEnough(const SitePaths& site, LightSamples* samples, std::vector<Sentence>* left_out) {
  const std::filesystem::path file = site.survey() / "samples.json";
  const auto require = [&](const Sentence& list, size_t count, size_t at_least) {
    if (count >= at_least) return;
    const Sentence message(
        "lightTooFew", "{list}: {count} usable samples, expected at least {least}",
        {{"list", list.ToJson()}, {"count", int(count)}, {"least", int(at_least)}});
    throw SaidError(InputError(file, message.text()), {file}, message);
  };
  require(Sentence("nameHorizon", "horizon"), samples->horizon.size(), 1);
  require(Sentence("nameDaylight", "daylight"), samples->daylight.size(), 3);
  const auto [nearest, farthest] =
      std::minmax_element(samples->haze.begin(), samples->haze.end(),
                          [](const auto& a, const auto& b) { return a.distance < b.distance; });
  if (samples->haze.empty() || nearest->distance < farthest->distance) return;
  left_out->push_back(
      Sentence("lightOneDistance", "haze: all samples at one distance, expected different ones"));
  samples->haze.clear();
}

}  // namespace

void LightOptions::Check() const {
  INSITU_CHECK(bins >= kFewestBins && bins <= kMaxBins);
  INSITU_CHECK(polar_facets >= 1 && polar_facets <= kMostPolarFacets);
  INSITU_CHECK(uniform_ambient || !as_printed);
}

LightMeasurement MeasureDaylight(const SitePaths& site, const LightOptions& options) {
  options.Check();
  LightMeasurement measured = WithoutSamples(site, ReadSceneGeometry(site), BasisFor(options));
  NaturalEnvironment& environment = measured.environment;
  const int photographs = static_cast<int>(environment.scene.cameras.size());
  constexpr int kMeasurements = 2;  // samples, light, each about as long as a photograph
  Progress progress("haze and daylight", photographs + kMeasurements);
  PhotographSet photos = FindPhotographs(site, environment.scene, &measured.exposures);
  environment.input_images = ListInputImages(site, environment.scene);
  MeasurePhotographs(photos, &progress, &measured);
  measured.samples = ReadSamples(site, environment.scene, photos,
                                 options.as_printed ? SampleOptions{.radius = 0} : SampleOptions{});
  measured.clipped = MeasureClippedShares(environment.scene, photos);
  BringToOneUnit(&photos, &measured);
  progress.Step();
  KeptSkyBlocks once;
  MeasureAirAndLight(site, photos, options, &once, &measured);
  measured.brightest = BrightestOf(photos);
  return measured;
}

LightMeasurement MeasureDaylightSoFar(const SitePaths& site, const SceneGeometry& scene,
                                      const std::vector<Photograph>& photos, KeptSkyBlocks* kept,
                                      std::vector<Sentence>* left_out) {
  LightOptions options;
  options.around = kSoFar;
  static const SpectralBasis spectra = BasisFor({});  // takes as long as the fit
  LightMeasurement measured = WithoutSamples(site, scene, spectra);
  measured.samples = ReadSamples(site, scene, photos, {}, left_out);
  RequireEnough(site, &measured.samples, left_out);
  MeasureAirAndLight(site, photos, options, kept, &measured);
  return measured;
}

}  // namespace insitu
