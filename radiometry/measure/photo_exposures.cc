// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/photo_exposures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <tuple>
#include <utility>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"
#include "radiometry/measure/robust_weights.h"
#include "reconstruction/geometry/ray_scene.h"

namespace insitu {
namespace {

constexpr double kFewestPoints = 20;      // that a photograph must share to be told by them
constexpr double kPointSigma = 0.05;      // of a point's logarithm, what two photographs differ by
constexpr double kHazePerMeter = 0.001;   // of difference in distance
constexpr double kExifSigma = 0.07;       // a third of a stop, evenly spread
constexpr double kCorrelatedPoints = 25;  // that tell no more than one
constexpr double kFloorSigma = 0.003;
constexpr double kLeastGain = 0.02, kLeastBalance = 0.03;  // logarithms below are taken as none
constexpr double kSureSigmas = 3;
constexpr double kDarkest = 0.01;     // value of a photograph whose noise does not yet count
constexpr double kOffSurface = 0.02;  // [m]
constexpr int kPasses = 15;
const Eigen::Vector3d kLuminance(0.2126, 0.7152, 0.0722);

// A point on a polygon as two photographs show it.
struct SharedPoint {
  int first = 0, second = 0;
  double radius_difference = 0;  // of squared distances from the centre, the corner's being 1
  double sigma = 0;              // of the logarithms below
  Eigen::Vector4d log_ratio;     // first over second: luminance, red, green, blue
};

// Values about a pixel; nullopt: near the border, clipped or dark.
std::optional<Eigen::Vector4d> ValuesAt(const Photograph& photo, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2i at = pixel.array().round().cast<int>();
  const Raster& image = photo.linear;
  if (at.minCoeff() < 1 || at.x() > image.width - 2 || at.y() > image.height - 2) {
    return std::nullopt;
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = at.y() - 1; y <= at.y() + 1; ++y) {
    for (int x = at.x() - 1; x <= at.x() + 1; ++x) {
      if (IsClipped(photo, x, y)) return std::nullopt;
      sum += image.Rgb(x, y);
    }
  }
  const Eigen::Vector3d rgb = sum / 9;
  if (rgb.minCoeff() < kDarkest) return std::nullopt;
  return Eigen::Vector4d(kLuminance.dot(rgb), rgb.x(), rgb.y(), rgb.z());
}

double SquaredRadius(const Camera& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d center((camera.width() - 1) / 2.0, (camera.height() - 1) / 2.0);
  return (pixel - center).squaredNorm() / center.squaredNorm();
}

// A place as a photograph shows it.
struct ShownPlace {
  int photo = 0;
  Eigen::Vector2d pixel;
  double distance = 0;                         // [m]
  std::optional<Eigen::Vector4d> values = {};  // nullopt: it tells nothing
};
// The same in all photographs that show it, first in the one it was chosen in.
using SharedPlace = std::vector<ShownPlace>;

// Looks for surfaces that photographs share.
class SharedSurfaces {
 public:
  SharedSurfaces(const SceneGeometry& scene, const std::vector<bool>& mirrors)
      : scene_(scene), mirrors_(mirrors), polygons_(MeshOfPolygons(scene)), rays_(polygons_.mesh) {}

  // Over a grid of about `pixels` of a photograph, with all later and earlier ones.
  void Gather(int photo, int pixels, std::vector<SharedPlace>* places) const {
    const Camera& camera = scene_.cameras[photo].camera;
    const double area = static_cast<double>(camera.width()) * camera.height();
    const int step = std::max(1, static_cast<int>(std::sqrt(area / pixels)));
    for (int y = step / 2; y < camera.height(); y += step) {
      for (int x = step / 2; x < camera.width(); x += step) {
        if (auto place = PlaceAt(photo, Eigen::Vector2d(x, y))) places->push_back(*place);
      }
    }
  }

 private:
  std::optional<SharedPlace> PlaceAt(int photo, const Eigen::Vector2d& pixel) const {
    const PosedCamera& posed = scene_.cameras[photo];
    const Eigen::Vector3d center = Center(posed.cam_from_world) - scene_.origin;
    const Eigen::Vector3d direction =
        (posed.cam_from_world.rotation.conjugate() * posed.camera.Unproject(pixel)).normalized();
    const auto hit = rays_.Nearest({center, direction});
    if (!hit) return std::nullopt;
    const int polygon = polygons_.polygon_of_triangle[hit->triangle];
    if (mirrors_[polygon]) return std::nullopt;
    Eigen::Vector3d normal = scene_.polygons[polygon].normal;
    if (normal.dot(direction) > 0) normal = -normal;
    const Eigen::Vector3d surface = center + hit->distance * direction + kOffSurface * normal;
    SharedPlace place = {{photo, pixel, hit->distance}};
    for (int other = 0; other < static_cast<int>(scene_.cameras.size()); ++other) {
      const auto seen = other == photo ? std::nullopt : SeenIn(other, surface, normal);
      if (!seen) continue;
      const Eigen::Vector3d eye = Center(scene_.cameras[other].cam_from_world) - scene_.origin;
      place.push_back({other, *seen, (eye - surface).norm()});
    }
    return place.size() > 1 ? std::optional(place) : std::nullopt;
  }

  std::optional<Eigen::Vector2d> SeenIn(int photo, const Eigen::Vector3d& surface,
                                        const Eigen::Vector3d& normal) const {
    const PosedCamera& posed = scene_.cameras[photo];
    const Eigen::Vector3d path = Center(posed.cam_from_world) - scene_.origin - surface;
    if (normal.dot(path) <= 0) return std::nullopt;
    const auto pixel = posed.camera.Project(posed.cam_from_world * (surface + scene_.origin));
    if (!pixel || !posed.camera.Sees(*pixel)) return std::nullopt;
    const double distance = path.norm();
    if (rays_.IsOccluded({surface, path / distance, 0, distance})) return std::nullopt;
    return pixel;
  }

  const SceneGeometry& scene_;
  const std::vector<bool>& mirrors_;
  PolygonMesh polygons_;
  RayScene rays_;
};

// One photograph after the other: they need not all be held at once.
void ReadValues(const PhotographSet& photos, std::vector<SharedPlace>* places) {
  std::vector<std::vector<ShownPlace*>> of_photo(photos.size());
  for (SharedPlace& place : *places) {
    for (ShownPlace& shown : place) of_photo[shown.photo].push_back(&shown);
  }
  for (size_t i = 0; i < photos.size(); ++i) {
    const auto photo = photos[i];
    for (ShownPlace* shown : of_photo[i]) shown->values = ValuesAt(*photo, shown->pixel);
  }
}

std::vector<SharedPoint> SharedPoints(const SceneGeometry& scene,
                                      const std::vector<SharedPlace>& places) {
  const auto radius = [&](const ShownPlace& shown) {
    return SquaredRadius(scene.cameras[shown.photo].camera, shown.pixel);
  };
  std::vector<SharedPoint> points;
  for (const SharedPlace& place : places) {
    const ShownPlace& own = place.front();
    for (size_t i = 1; i < place.size(); ++i) {
      const ShownPlace& other = place[i];
      if (!own.values || !other.values) continue;
      const double farther = other.distance - own.distance;
      points.push_back({own.photo, other.photo, radius(own) - radius(other),
                        std::hypot(kPointSigma, kHazePerMeter * farther),
                        (own.values->array() / other.values->array()).log()});
    }
  }
  return points;
}

// Unknowns: ln gain of each photograph, ln falloff at the corner, ln of the camera's own factor.
struct LogGains {
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;

  double SigmaOfDifference(int a, int b) const {
    return std::sqrt(std::max(0.0, covariance(a, a) + covariance(b, b) - 2 * covariance(a, b)));
  }
};

class ExposureEquations {
 public:
  ExposureEquations(const std::vector<SharedPoint>& points, const std::vector<ExifExposure>& exif,
                    int photos)
      : points_(points), exif_(exif), photos_(photos) {}

  // `series`: 0 of luminance, 1 to 3 of red, green, blue. Turns between weights and solution.
  LogGains Solve(int series) const {
    LogGains gains{Eigen::VectorXd::Zero(photos_ + 2), {}};
    std::vector<double> weights(points_.size(), 1.0);
    Eigen::MatrixXd normals;
    double scale = 1;
    for (int pass = 0; pass < kPasses; ++pass) {
      Eigen::VectorXd right;
      std::tie(normals, right) = Normals(series, weights, gains.value);
      gains.value = SolveSymmetric(normals, right);
      const std::vector<double> residuals = Residuals(series, gains.value);
      weights = HuberWeights(residuals);
      scale = std::max(0.1, kSigmaOverMedian * Median(residuals));
    }
    gains.covariance = scale * scale * kCorrelatedPoints * InverseOfSymmetric(normals);
    return gains;
  }

 private:
  double Residual(const SharedPoint& point, int series, const Eigen::VectorXd& x) const {
    return (point.log_ratio[series] - x[point.first] + x[point.second] -
            point.radius_difference * x[photos_]) /
           point.sigma;
  }

  std::vector<double> Residuals(int series, const Eigen::VectorXd& x) const {
    std::vector<double> residuals;
    for (const SharedPoint& point : points_) {
      residuals.push_back(std::abs(Residual(point, series, x)));
    }
    return residuals;
  }

  std::pair<Eigen::MatrixXd, Eigen::VectorXd> Normals(int series,
                                                      const std::vector<double>& weights,
                                                      const Eigen::VectorXd& x) const {
    // Nothing is known before: gains within e^3, falloff within 1.
    Eigen::MatrixXd N = Eigen::MatrixXd::Identity(photos_ + 2, photos_ + 2) / 9;
    N(photos_, photos_) = 1;
    Eigen::VectorXd b = Eigen::VectorXd::Zero(photos_ + 2);
    const auto add = [&](std::initializer_list<std::pair<int, double>> row, double y, double w) {
      for (const auto& [i, a] : row) {
        for (const auto& [j, c] : row) N(i, j) += w * a * c;
        b[i] += w * a * y;
      }
    };
    for (size_t i = 0; i < points_.size(); ++i) {
      const SharedPoint& point = points_[i];
      add({{point.first, 1}, {point.second, -1}, {photos_, point.radius_difference}},
          point.log_ratio[series], weights[i] / (point.sigma * point.sigma));
    }
    for (int photo = 0; photo < photos_ && !exif_.empty(); ++photo) {
      const auto relative = exif_[photo].Relative();
      if (!relative) continue;
      // As much as points that are correlated; what contradicts them counts less.
      const double y = std::log(*relative);
      const double off = std::abs(y - x[photo] - x[photos_ + 1]) / kExifSigma;
      const double huber = off > 2 ? 2 / off : 1;
      add({{photo, 1}, {photos_ + 1, 1}}, y, kCorrelatedPoints * huber / (kExifSigma * kExifSigma));
    }
    return {N, b};
  }

  const std::vector<SharedPoint>& points_;
  const std::vector<ExifExposure>& exif_;
  const int photos_;
};

// The photograph whose gain is in the middle, the lower one of two.
int MiddleOf(const Eigen::VectorXd& values, int count) {
  std::vector<std::pair<double, int>> sorted;
  for (int i = 0; i < count; ++i) sorted.emplace_back(values[i], i);
  std::sort(sorted.begin(), sorted.end());
  return sorted[(sorted.size() - 1) / 2].second;
}

void SetByExif(const std::vector<ExifExposure>& exif, double unit, double camera,
               std::vector<PhotoExposure>* photos) {
  for (size_t i = 0; i < photos->size() && !exif.empty(); ++i) {
    if (const auto relative = exif[i].Relative()) {
      (*photos)[i].by_exif = std::exp(std::log(*relative) - camera - unit);
    }
  }
}

// What differs by more than chance is applied, by channel where the colours differ too.
void SetGain(PhotoExposure* photo) {
  const double least = std::max(kLeastGain, kSureSigmas * photo->sigma);
  const double least_balance = std::max(kLeastBalance, kSureSigmas * photo->sigma);
  const bool is_balanced = photo->white_balance.array().log().abs().maxCoeff() < least_balance;
  if (is_balanced && std::abs(std::log(photo->measured)) < least) return;
  photo->gain.setConstant(photo->measured);
  if (!is_balanced) photo->gain = photo->measured * photo->white_balance;
}

}  // namespace

ExposureFit MeasureExposures(const SceneGeometry& scene, const PhotographSet& photos,
                             const std::vector<ExifExposure>& exif,
                             const std::vector<bool>& mirrors) {
  const int count = static_cast<int>(photos.size());
  INSITU_CHECK(photos.size() == scene.cameras.size() && mirrors.size() == scene.polygons.size());
  INSITU_CHECK(exif.empty() || exif.size() == photos.size());
  ExposureFit fit;
  fit.photos.resize(photos.size());
  if (count < 2) return fit;
  const SharedSurfaces surfaces(scene, mirrors);
  std::vector<SharedPlace> places;
  for (int i = 0; i < count; ++i) {
    surfaces.Gather(i, std::clamp(12000 / count, 400, 4000), &places);
  }
  ReadValues(photos, &places);
  const std::vector<SharedPoint> points = SharedPoints(scene, places);
  for (const SharedPoint& point : points) {
    ++fit.photos[point.first].points;
    ++fit.photos[point.second].points;
  }
  const ExposureEquations equations(points, exif, count);
  std::array<LogGains, 4> series;
  for (int i = 0; i < 4; ++i) series[i] = equations.Solve(i);
  const int middle = MiddleOf(series[0].value, count);
  for (int i = 0; i < count; ++i) {
    PhotoExposure& photo = fit.photos[i];
    photo.measured = std::exp(series[0].value[i] - series[0].value[middle]);
    photo.sigma = std::hypot(kFloorSigma, series[0].SigmaOfDifference(i, middle));
    if (photo.points < kFewestPoints) continue;
    for (int c = 0; c < 3; ++c) {
      photo.white_balance[c] =
          std::exp(series[c + 1].value[i] - series[c + 1].value[middle]) / photo.measured;
    }
  }
  SetByExif(exif, series[0].value[middle], series[0].value[count + 1], &fit.photos);
  for (PhotoExposure& photo : fit.photos) SetGain(&photo);
  if (points.size() >= kFewestPoints * kCorrelatedPoints) {
    fit.corner_falloff = series[0].value[count];
    fit.corner_falloff_sigma = std::sqrt(series[0].covariance(count, count));
  }
  return fit;
}

Eigen::Vector3f FactorOfGain(const Eigen::Vector3d& gain) {
  return gain.cwiseInverse().cast<float>();
}

void DivideByGain(const Eigen::Vector3d& gain, Raster* picture) {
  const Eigen::Vector3f factor = FactorOfGain(gain);
  for (size_t i = 0; i < picture->data.size(); ++i) picture->data[i] *= factor[i % 3];
}

}  // namespace insitu
