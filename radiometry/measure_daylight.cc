// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure_daylight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibration/files/error.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/program.h"
#include "calibration/site_cameras.h"
#include "radiometry/measure/surroundings.h"
#include "reconstruction/geometry/ray_scene.h"

namespace insitu {
namespace {

constexpr double kPoorCondition = 100;

std::vector<Photograph> ReadPhotographs(const SitePaths& site, const SceneGeometry& scene,
                                        Progress* progress) {
  const std::vector<std::filesystem::path> paths = ListPhotographs(site);
  std::vector<Photograph> photos;
  for (const PosedCamera& posed : scene.cameras) {
    const auto path = std::find_if(paths.begin(), paths.end(),
                                   [&](const auto& p) { return p.stem() == posed.photo; });
    if (path == paths.end()) {
      throw InputError(site.photos(), "no photograph \"" + posed.photo +
                                          "\", expected every one that was reconstructed");
    }
    RequirePhotographSize(*path, posed.camera.width(), posed.camera.height());
    photos.push_back(ReadPhotograph(*path));
    progress->Step();
  }
  return photos;
}

// The camera of each photograph's input image, and where that is.
std::vector<InputImage> ListInputImages(const SitePaths& site, const SceneGeometry& scene) {
  const std::vector<std::filesystem::path> paths = ListPhotographs(site);
  const std::vector<std::string> cameras = CamerasOfPhotos(site, paths);
  std::map<std::string, std::string> camera_of_photo;
  for (size_t i = 0; i < paths.size(); ++i) camera_of_photo[paths[i].stem().string()] = cameras[i];
  std::vector<InputImage> images;
  for (const PosedCamera& posed : scene.cameras) {
    const std::filesystem::path pinhole = site.pinhole_camera(camera_of_photo.at(posed.photo));
    RequireResult(pinhole, "insitu-undistort");
    images.push_back({site.input_image(posed.photo), ReadCamera(pinhole)});
  }
  return images;
}

std::map<std::string, NaturalMaterial> MaterialsOfPolygons(const SitePaths& site,
                                                           const SceneGeometry& scene,
                                                           std::vector<std::string>* warnings) {
  std::map<std::string, NaturalMaterial> materials = ReadNaturalMaterials(site);
  std::string missing;
  for (const Polygon& polygon : scene.polygons) {
    if (!materials.try_emplace(polygon.material).second) continue;
    missing += (missing.empty() ? "" : ", ") + polygon.material;
  }
  if (!missing.empty()) {
    warnings->push_back(
        "materials without an entry in survey/materials.json, taken as purely "
        "diffuse: " +
        missing);
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

AtmosphereFit MeasureAir(const LightSamples& samples, const SpectralBasis& spectra,
                         std::vector<std::string>* warnings) {
  const Spectrum horizon = HorizonColor(samples.horizon, spectra);
  if (samples.haze.empty()) {
    warnings->push_back("samples.json has no haze samples: the air is taken as clear");
    AtmosphereFit clear;
    clear.air.horizon = horizon;
    return clear;
  }
  std::vector<HazeSample> haze;
  for (const PixelSample& sample : samples.haze) {
    haze.push_back({spectra.SpectrumFromRgb(sample.rgb), SpectrumSigma(spectra, sample.rgb_sigma),
                    sample.distance});
  }
  return FitAtmosphere(haze, horizon, spectra.bins());
}

Daylight IlluminationGeometry(const SceneGeometry& scene, int polar_facets) {
  Daylight light;
  light.zenith_direction = scene.zenith.unit;
  light.sun_direction = scene.sun ? scene.sun->unit : scene.zenith.unit;
  light.polar_facets = polar_facets;
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

std::vector<LocalImage> LocalImages(const SceneGeometry& scene,
                                    const std::vector<Photograph>& photos) {
  std::vector<LocalImage> images;
  for (size_t i = 0; i < photos.size(); ++i) {
    images.emplace_back(scene.cameras[i], scene.origin, photos[i].linear);
  }
  return images;
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
                    std::vector<std::string>* warnings) {
  if (samples.daylight_reflectance) {
    return spectra.ReflectanceFromRgb(*samples.daylight_reflectance) / std::numbers::pi;
  }
  warnings->push_back(
      "samples.json has no daylight_reflectance_rgb: it is taken as 1, so the "
      "building will come out too dark beside its surroundings");
  return spectra.Ones() / std::numbers::pi;
}

void WarnOfWeakSamples(const LightMeasurement& measured, bool has_sun,
                       const std::vector<DaylightSample>& samples,
                       std::vector<std::string>* warnings) {
  const bool any_sun = std::any_of(samples.begin(), samples.end(),
                                   [](const auto& sample) { return sample.geometry.sun > 0; });
  if (!has_sun) warnings->push_back("no sun direction was measured: the sky is taken as overcast");
  if (has_sun && !any_sun) warnings->push_back("no daylight sample sees the sun: it stays dark");
  if (measured.daylight_fit.condition > kPoorCondition) {
    warnings->push_back(
        "the daylight samples hardly tell sun, sky and ambient light apart: choose "
        "some in sun, in open shade and in deep shade");
  }
}

std::vector<DaylightSample> DaylightSamples(const LightMeasurement& measured,
                                            const std::vector<Photograph>& photos,
                                            bool uniform_ambient) {
  const NaturalEnvironment& environment = measured.environment;
  const std::vector<PixelSample>& pixels = measured.samples.daylight;
  const std::vector<SurfacePoint> points = SurfacePoints(pixels, environment.scene);
  const PolygonMesh polygons = MeshOfPolygons(environment.scene);
  const RayScene rays(polygons.mesh);
  const std::vector<LightGeometry> geometries = TraceLight(points, rays, environment.light);
  std::vector<Spectrum> surroundings;
  if (!uniform_ambient) {
    const std::vector<LocalImage> images = LocalImages(environment.scene, photos);
    surroundings =
        GatherSurroundings(points, {environment.scene, rays, polygons.polygon_of_triangle, images,
                                    environment.air, environment.spectra});
  }
  std::vector<DaylightSample> samples;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const Spectrum apparent = environment.spectra.SpectrumFromRgb(pixels[i].rgb);
    samples.push_back({TrueColor(apparent, environment.air, pixels[i].distance),
                       SpectrumSigma(environment.spectra, pixels[i].rgb_sigma) /
                           TransmittanceOver(environment.air, pixels[i].distance),
                       geometries[i]});
    if (!surroundings.empty()) samples.back().surroundings = surroundings[i];
  }
  return samples;
}

void MeasureLightComponents(const std::vector<Photograph>& photos, const LightOptions& options,
                            LightMeasurement* measured) {
  NaturalEnvironment& environment = measured->environment;
  Daylight& light = environment.light;
  light = IlluminationGeometry(environment.scene, options.polar_facets);
  const std::vector<DaylightSample> samples =
      DaylightSamples(*measured, photos, options.uniform_ambient);
  const bool has_sun = environment.scene.sun.has_value();
  measured->daylight_fit =
      FitDaylight(samples, SampleBrdf(measured->samples, environment.spectra, &measured->warnings),
                  has_sun, environment.spectra.bins(), {options.average_over_wavelength});
  light.sun_radiance = measured->daylight_fit.sun_radiance;
  light.ambient_radiance = measured->daylight_fit.ambient_radiance;
  light.sky_radiance = measured->daylight_fit.sky_radiance;
  WarnOfWeakSamples(*measured, has_sun, samples, &measured->warnings);
}

LightMeasurement WithoutSamples(const SitePaths& site, SceneGeometry scene,
                                const LightOptions& options) {
  LightMeasurement measured;
  NaturalEnvironment& environment = measured.environment;
  environment.scene = std::move(scene);
  environment.spectra = SpectralBasis(Rec709(), {options.bins});
  environment.materials = MaterialsOfPolygons(site, environment.scene, &measured.warnings);
  return measured;
}

// Haze that cannot be told is left out; light needs the others.
void RequireEnough(const SitePaths& site, LightSamples* samples,
                   std::vector<InputError>* left_out) {
  const std::filesystem::path file = site.survey() / "samples.json";
  const auto require = [&](const char* list, size_t count, size_t at_least) {
    if (count >= at_least) return;
    throw InputError(file, std::string(list) + ": " + std::to_string(count) +
                               " usable samples, expected at least " + std::to_string(at_least));
  };
  require("horizon", samples->horizon.size(), 1);
  require("daylight", samples->daylight.size(), 3);
  const auto [nearest, farthest] =
      std::minmax_element(samples->haze.begin(), samples->haze.end(),
                          [](const auto& a, const auto& b) { return a.distance < b.distance; });
  if (samples->haze.empty() || nearest->distance < farthest->distance) return;
  left_out->emplace_back(file, "haze: all samples at one distance, expected different ones");
  samples->haze.clear();
}

}  // namespace

void LightOptions::Check() const {
  INSITU_CHECK(bins >= kFewestBins && bins <= kMaxBins);
  INSITU_CHECK(polar_facets >= 1 && polar_facets <= kMostPolarFacets);
}

LightMeasurement MeasureDaylight(const SitePaths& site, const LightOptions& options) {
  options.Check();
  LightMeasurement measured = WithoutSamples(site, ReadSceneGeometry(site), options);
  NaturalEnvironment& environment = measured.environment;
  constexpr int kMeasurements = 3;  // samples, air, light, each about as long as a photograph
  Progress progress("haze and daylight",
                    static_cast<int>(environment.scene.cameras.size()) + kMeasurements);
  const std::vector<Photograph> photos = ReadPhotographs(site, environment.scene, &progress);
  environment.input_images = ListInputImages(site, environment.scene);
  measured.samples = ReadSamples(site, environment.scene, photos);
  progress.Step();
  measured.reflectance_known = measured.samples.daylight_reflectance.has_value();
  measured.air_fit = MeasureAir(measured.samples, environment.spectra, &measured.warnings);
  environment.air = measured.air_fit.air;
  progress.Step();
  MeasureLightComponents(photos, options, &measured);
  return measured;
}

LightMeasurement MeasureDaylightSoFar(const SitePaths& site, const SceneGeometry& scene,
                                      const std::vector<Photograph>& photos,
                                      std::vector<InputError>* left_out) {
  const LightOptions options;
  LightMeasurement measured = WithoutSamples(site, scene, options);
  measured.samples = ReadSamples(site, scene, photos, {}, left_out);
  RequireEnough(site, &measured.samples, left_out);
  measured.reflectance_known = measured.samples.daylight_reflectance.has_value();
  measured.air_fit = MeasureAir(measured.samples, measured.environment.spectra, &measured.warnings);
  measured.environment.air = measured.air_fit.air;
  MeasureLightComponents(photos, options, &measured);
  return measured;
}

}  // namespace insitu
