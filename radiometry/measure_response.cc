// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure_response.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "calibration/color/response.h"
#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/program.h"
#include "radiometry/measure_daylight.h"
#include "radiometry/site_photographs.h"
#include "radiometry/transport/photographed_light.h"
#include "reconstruction/geometry/ray_scene.h"

namespace insitu {
namespace {

constexpr int kTurns = 4;   // of light and curve
constexpr int kGrid = 120;  // places along a photograph's longer side
constexpr size_t kMostOfASurface = 12, kMostFoci = 16;
constexpr double kOtherExposure = 0.1;  // share by which EXIF tells of another one
constexpr int kReach = 3;               // [px], of what must be even about a place
constexpr double kEven = 0.06;          // standard deviation over mean of what is even
constexpr double kDarkestCode = 0.05, kBrightestCode = 0.98;
constexpr double kFaintest = 1e-3;  // of the sky to start from
constexpr double kSunOverSky = 1;   // irradiance across its rays over the sky's radiance
constexpr int kFewestPlaces = 20;   // of the samples' material
constexpr double kWholeSun = 0.99;  // beyond, or below the rest, the sun's disc is not cut
constexpr int kDirectionsOfAPlace = 512, kDirectionsOfAPiece = 64;
constexpr double kPieceAtPlace = 0.5;  // [m]

struct Place {
  int photo = 0, polygon = 0;
  Eigen::Vector3d code = Eigen::Vector3d::Zero();
  SurfacePoint point = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};
  double distance = 0;  // [m] from the camera
};

void RequireSun(const SitePaths& site, const SceneGeometry& scene) {
  if (!scene.sun) {
    throw InputError(site.survey() / "directions.json",
                     "states no sun, expected one: sunlit and shaded places tell the response");
  }
}

std::filesystem::path FileOf(const SitePaths& site, const std::string& photo) {
  const std::vector<std::filesystem::path> paths = ListPhotographs(site);
  return *std::ranges::find_if(paths, [&](const auto& path) { return path.stem() == photo; });
}

// All of them as codes, of one exposure.
std::vector<Photograph> ReadAll(const SitePaths& site, const SceneGeometry& scene) {
  std::vector<ExifExposure> exposures;
  const PhotographSet files = FindPhotographs(site, scene, &exposures);
  std::vector<Photograph> photos;
  for (size_t i = 0; i < files.size(); ++i) {
    const std::string& photo = scene.cameras[i].photo;
    photos.push_back(*files[i]);
    if (photos.back().encoding == Encoding::kLinear) {
      throw InputError(FileOf(site, photo),
                       "is linear light, expected photographs of codes to fit a response to");
    }
    const auto first = exposures[0].Relative(), other = exposures[i].Relative();
    if (first && other && std::abs(*other / *first - 1) > kOtherExposure) {
      throw InputError(FileOf(site, photo),
                       "is of another exposure than " + scene.cameras[0].photo +
                           ", expected photographs of one exposure to fit a response to");
    }
  }
  return photos;
}

// The mean of the codes about a pixel; nullopt: near the border, uneven, too dark or bright.
std::optional<Eigen::Vector3d> EvenCode(const Raster& image, const Eigen::Vector2i& at) {
  if (at.minCoeff() < kReach || at.x() + kReach >= image.width || at.y() + kReach >= image.height) {
    return std::nullopt;
  }
  Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();
  double count = 0;
  for (int y = at.y() - kReach; y <= at.y() + kReach; ++y) {
    for (int x = at.x() - kReach; x <= at.x() + kReach; ++x, ++count) {
      const Eigen::Array3d code = image.Rgb(x, y).unaryExpr(&SrgbFromLinear).array();
      sum += code;
      squares += code.square();
    }
  }
  const Eigen::Array3d mean = sum / count;
  const Eigen::Array3d deviation = (squares / count - mean.square()).max(0).sqrt();
  const bool is_even = (deviation < kEven * mean).all() && mean.minCoeff() > kDarkestCode &&
                       mean.maxCoeff() < kBrightestCode;
  return is_even ? std::optional<Eigen::Vector3d>(mean.matrix()) : std::nullopt;
}

// Looks for even places on polygons.
class Places {
 public:
  Places(const NaturalEnvironment& environment, const std::vector<Photograph>& photos)
      : environment_(environment),
        scene_(environment.scene),
        photos_(photos),
        polygons_(MeshOfPolygons(scene_)),
        rays_(polygons_.mesh),
        facets_(MakeSkyFacets(environment.light.zenith_direction, 4)) {}

  std::vector<Place> Gather() const {
    std::map<std::pair<int, int>, std::vector<Place>> by_surface;  // photo, polygon
    for (int photo = 0; photo < static_cast<int>(photos_.size()); ++photo) {
      const Raster& image = photos_[photo].linear;
      const int step = std::max(1, std::max(image.width, image.height) / kGrid);
      for (int y = step / 2; y < image.height; y += step) {
        for (int x = step / 2; x < image.width; x += step) {
          const auto place = At(photo, {x, y});
          if (place) by_surface[{photo, place->polygon}].push_back(*place);
        }
      }
    }
    std::vector<Place> places;
    for (const auto& [surface, all] : by_surface) {
      const size_t step = (all.size() + kMostOfASurface - 1) / kMostOfASurface;
      for (size_t i = 0; i < all.size(); i += step) places.push_back(all[i]);
    }
    return places;
  }

  LightGeometry LightAt(const SurfacePoint& point) const {
    const Eigen::Vector3d origin = point.position + kSurveyClearance * point.normal;
    return MeasureLight(environment_.light, facets_, point.normal,
                        [&](const Eigen::Vector3d& to_light) {
                          return !rays_.IsOccluded({origin, to_light});
                        });
  }

 private:
  // The polygon that a pixel shows, and where; nullopt: none.
  std::optional<Place> Hit(int photo, const Eigen::Vector2d& pixel) const {
    const PosedCamera& posed = scene_.cameras[photo];
    const Eigen::Vector3d center = Center(posed.cam_from_world) - scene_.origin;
    const Eigen::Vector3d direction =
        (posed.cam_from_world.rotation.conjugate() * posed.camera.Unproject(pixel)).normalized();
    const auto hit = rays_.Nearest({center, direction});
    if (!hit) return std::nullopt;
    Place place;
    place.photo = photo;
    place.polygon = polygons_.polygon_of_triangle[hit->triangle];
    Eigen::Vector3d normal = scene_.polygons[place.polygon].normal;
    if (normal.dot(direction) > 0) normal = -normal;
    place.point = {center + hit->distance * direction, normal};
    place.distance = hit->distance;
    return place;
  }

  std::optional<Place> At(int photo, const Eigen::Vector2i& pixel) const {
    const Eigen::Vector2d at = pixel.cast<double>();
    auto place = Hit(photo, at);
    if (!place || IsMirror(place->polygon)) return std::nullopt;
    for (const auto& [x, y] : {std::pair(-2, -2), {2, -2}, {-2, 2}, {2, 2}}) {
      const auto beside = Hit(photo, at + kReach * Eigen::Vector2d(x, y));
      if (!beside || beside->polygon != place->polygon) return std::nullopt;
    }
    const auto code = EvenCode(photos_[photo].linear, pixel);
    if (!code || IsSunCut(place->point)) return std::nullopt;
    place->code = *code;
    return place;
  }

  bool IsMirror(int polygon) const {
    const auto& specular = environment_.materials.at(scene_.polygons[polygon].material).specular;
    return specular && specular->weight > 0;
  }

  bool IsSunCut(const SurfacePoint& point) const {
    const double whole = std::max(0.0, point.normal.dot(environment_.light.sun_direction)) *
                         environment_.light.sun_solid_angle;
    const double share = whole > 0 ? LightAt(point).sun / whole : 0;
    return share > 1 - kWholeSun && share < kWholeSun;
  }

  const NaturalEnvironment& environment_;
  const SceneGeometry& scene_;
  const std::vector<Photograph>& photos_;
  const PolygonMesh polygons_;
  const RayScene rays_;
  const SkyFacets facets_;
};

// The photographs by a curve of the codes that they have as sRGB.
std::vector<Photograph> Through(const std::vector<Photograph>& photos,
                                const std::array<ResponsePoints, 3>& points) {
  const std::array<ToneCurve, 3> curves = {ResponseCurve(points[0]), ResponseCurve(points[1]),
                                           ResponseCurve(points[2])};
  std::vector<Photograph> changed = photos;
  for (Photograph& photo : changed) {
    photo.color = WithResponse(photo.color, curves);
    for (size_t i = 0; i < photo.linear.data.size(); ++i) {
      float& value = photo.linear.data[i];
      value = static_cast<float>(curves[i % 3].Linear(SrgbFromLinear(value)));
    }
  }
  return changed;
}

// Numbers of the materials: 0 for that of the daylight samples.
std::map<std::string, int> NumbersOfMaterials(const SceneGeometry& scene,
                                              const LightSamples& samples) {
  std::map<std::string, int> numbers;
  for (const PixelSample& sample : samples.daylight) {
    numbers[scene.polygons[*sample.polygon].material] = 0;
  }
  for (const Polygon& polygon : scene.polygons) {
    numbers.try_emplace(polygon.material, static_cast<int>(numbers.size()));
  }
  return numbers;
}

std::vector<SurfacePoint> FociOf(const std::vector<Place>& places) {
  std::vector<SurfacePoint> foci;
  const size_t step = places.size() / kMostFoci + 1;
  for (size_t i = 0; i < places.size(); i += step) foci.push_back(places[i].point);
  return foci;
}

Eigen::Vector3d RgbOf(const NaturalEnvironment& environment, const Spectrum& spectrum) {
  return environment.spectra.RgbFromSpectrum(spectrum);
}

std::vector<ResponseSample> SamplesAt(const std::vector<Place>& places,
                                      const std::vector<Photograph>& photos, const Places& finder,
                                      const LightMeasurement& measured) {
  const NaturalEnvironment& environment = measured.environment;
  const std::vector<SurfacePoint> foci = FociOf(places);
  PhotographedLight around(
      {environment.scene, environment.air, environment.spectra, environment.light},
      LocalImages(environment, PhotographSet(photos), {}), {foci, kPieceAtPlace},
      {.patch_directions = kDirectionsOfAPiece, .point_directions = kDirectionsOfAPlace});
  Daylight light = environment.light;
  light.sky_radiance = light.sky_radiance + light.ambient_radiance;
  around.Solve(light);
  const std::map<std::string, int> materials =
      NumbersOfMaterials(environment.scene, measured.samples);
  const Eigen::Vector3d white = RgbOf(environment, environment.spectra.Ones());
  std::vector<ResponseSample> samples;
  for (const Place& place : places) {
    const GatheredLight gathered = around.At(place.point);
    const Spectrum through = TransmittanceOver(environment.air, place.distance);
    ResponseSample sample;
    sample.code = place.code;
    sample.surface = place.polygon;
    sample.material = materials.at(environment.scene.polygons[place.polygon].material);
    sample.sun = finder.LightAt(place.point).sun;
    sample.sky = gathered.sky * RgbOf(environment, gathered.relative_sky).y() / white.y();
    sample.surroundings = RgbOf(environment, gathered.surroundings_before);
    sample.through = RgbOf(environment, through).cwiseQuotient(white);
    sample.added =
        RgbOf(environment, environment.air.horizon * (environment.spectra.Ones() - through));
    samples.push_back(sample);
  }
  return samples;
}

std::array<ResponsePoints, 3> AsSrgb() {
  ResponsePoints points;
  for (int i = 0; i <= 128; ++i) points.emplace_back(i / 128.0, LinearFromSrgb(i / 128.0));
  return {points, points, points};
}

// To start from, and what is known.
ResponseFitOptions OptionsOf(const LightMeasurement& measured,
                             const std::array<ResponsePoints, 3>& present) {
  const NaturalEnvironment& environment = measured.environment;
  const Daylight& light = environment.light;
  const auto rgb = [&](const Spectrum& spectrum) { return RgbOf(environment, spectrum); };
  ResponseFitOptions options;
  options.reflectance =
      rgb(measured.brdf * std::numbers::pi).cwiseQuotient(rgb(environment.spectra.Ones()));
  options.sky = rgb(light.sky_radiance + light.ambient_radiance).cwiseMax(kFaintest);
  // However little sun a wrong curve leaves: sunlit ground is brighter than shaded.
  options.sun = rgb(light.sun_radiance).cwiseMax(kSunOverSky * options.sky / light.sun_solid_angle);
  const SkyFit& sky = measured.sky.fit;
  if (!measured.reflectance_known || !sky.level) return options;
  const int bins = environment.spectra.bins().count;
  options.sky_sigma = (sky.level_sigma / *sky.level).head(bins).mean();
  options.sky_code.emplace();
  const Eigen::Vector3d level = rgb(*sky.level);
  for (int c = 0; c < 3; ++c) {
    (*options.sky_code)[c] = ResponseCurve(present[c]).Encoded(level[c]);
  }
  return options;
}

}  // namespace

ResponseMeasurement MeasureResponse(const SitePaths& site) {
  const SceneGeometry scene = ReadSceneGeometry(site);
  RequireSun(site, scene);
  const std::vector<Photograph> photos = ReadAll(site, scene);
  Progress progress("response", kTurns);
  ResponseMeasurement result;
  result.fit.curves = AsSrgb();
  for (int turn = 0; turn < kTurns; ++turn) {
    const std::vector<Photograph> linear = Through(photos, result.fit.curves);
    std::vector<Sentence> left_out;
    const LightMeasurement measured = MeasureDaylightSoFar(site, scene, linear, &left_out);
    const Places finder(measured.environment, photos);
    const std::vector<Place> places = finder.Gather();
    const std::vector<ResponseSample> samples = SamplesAt(places, linear, finder, measured);
    if (std::ranges::count(samples, 0, &ResponseSample::material) < kFewestPlaces) {
      throw InputError(site.survey() / "samples.json",
                       "the daylight samples' material has no " + std::to_string(kFewestPlaces) +
                           " even places, expected a material of large surfaces");
    }
    result.fit = FitResponse(samples, OptionsOf(measured, result.fit.curves));
    std::set<int> surfaces;
    for (const ResponseSample& sample : samples) surfaces.insert(sample.surface);
    result.places = static_cast<int>(places.size());
    result.surfaces = static_cast<int>(surfaces.size());
    progress.Step();
  }
  return result;
}

Json::Value ResponseJson(const ResponseMeasurement& measurement) {
  Json::Value entry;
  const char* const channels[] = {"red", "green", "blue"};
  for (int c = 0; c < 3; ++c) {
    for (const auto& [code, light] : measurement.fit.curves[c]) {
      entry[channels[c]].append(ToJson(Eigen::VectorXd(Eigen::Vector2d(code, light))));
    }
  }
  Json::Value file;
  file["curves"].append(entry);
  return file;
}

std::string BriefReport(const ResponseMeasurement& measurement) {
  const Eigen::Vector3d& ratio = measurement.fit.sun_over_sky;
  const Eigen::Vector3d& sigma = measurement.fit.sun_over_sky_sigma;
  return "response fitted to " + std::to_string(measurement.places) + " places of " +
         std::to_string(measurement.surfaces) + " surfaces, residuals " +
         Formatted("%.2f", measurement.fit.rms) + " sigma; sun : sky (irradiance of the open sun " +
         "over pi times the sky's radiance) " +
         Formatted("%.2f", ratio[0] * kSolarSolidAngle / std::numbers::pi) + ", " +
         Formatted("%.2f", ratio[1] * kSolarSolidAngle / std::numbers::pi) + ", " +
         Formatted("%.2f", ratio[2] * kSolarSolidAngle / std::numbers::pi) + " known to " +
         Formatted("%.0f", 100 * sigma.maxCoeff()) + " %\n";
}

}  // namespace insitu
