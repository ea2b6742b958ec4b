// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/outline_band.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/photo/exif.h"
#include "radiometry/natural_environment.h"
#include "reconstruction/geometry/lens_view.h"
#include "reconstruction/geometry/ray_scene.h"
#include "renderer/building/building_outline.h"
#include "renderer/building/building_uncertainty.h"
#include "renderer/view/picture.h"

namespace insitu {
namespace {

constexpr double kSigmas = 2;
constexpr double kPiece = 12;         // [px], about, of what is hidden or not as one
constexpr int kMostPieces = 400;      // of an edge
constexpr size_t kMostEdges = 20000;  // the longest
constexpr size_t kMostCorners = 2000;
constexpr double kClearance = 0.02;  // [m], of an edge before the faces beside it

double Rounded(double value) { return std::round(value * 100) / 100; }

Json::Value PointJson(const Eigen::Vector2d& point) {
  Json::Value json(Json::arrayValue);
  json.append(Rounded(point.x()));
  json.append(Rounded(point.y()));
  return json;
}

// For shadows alone: its spheres have no facets.
TriangleMesh LocalMesh(const ArtificialEnvironment& building, const Eigen::Vector3d& origin) {
  TriangleMesh mesh;
  for (const Eigen::Vector3d& vertex : building.vertices) {
    mesh.vertices.push_back((vertex - origin).cast<float>());
  }
  mesh.triangles = building.triangles;
  for (const EnvironmentSphere& sphere : building.spheres) {
    mesh.spheres.push_back(
        {sphere.center - origin, sphere.radius, static_cast<int>(building.triangles.size())});
  }
  return mesh;
}

size_t IndexOf(const SceneGeometry& scene, const std::string& photo) {
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    if (scene.cameras[i].photo == photo) return i;
  }
  throw InputError("work/environment.json", "has no camera for photograph " + photo);
}

// One photograph's image of the building.
struct BandView {
  PosedCamera camera;
  std::optional<Eigen::MatrixXd> covariance;
  int orientation;  // EXIF's

  Eigen::Vector2d Upright(const Eigen::Vector2d& pixel) const {
    return UprightPixel(pixel, camera.camera.width(), camera.camera.height(), orientation);
  }
};

}  // namespace

struct OutlineBands::Scene {
  NaturalEnvironment natural;
  ArtificialEnvironment building;
  BuildingEdges edges;
  RayScene building_rays, natural_rays;

  Scene(NaturalEnvironment n, ArtificialEnvironment b)
      : natural(std::move(n)),
        building(std::move(b)),
        edges(building),
        building_rays(LocalMesh(building, natural.scene.origin)),
        natural_rays(MeshOfPolygons(natural.scene).mesh) {}

  bool IsHidden(const Eigen::Vector3d& world, const Eigen::Vector3d& eye) const {
    const Eigen::Vector3d way = world - eye;
    const double distance = way.norm();
    if (distance <= kClearance) return false;
    const Ray ray = {eye - natural.scene.origin, way / distance, 0, distance - kClearance};
    return building_rays.IsOccluded(ray) || natural_rays.IsOccluded(ray);
  }

  std::vector<OutlineEdge> LongestEdges(const Eigen::Vector3d& eye) const {
    std::vector<OutlineEdge> outline = edges.OutlineFrom(eye);
    if (outline.size() <= kMostEdges) return outline;
    const auto length = [](const OutlineEdge& edge) {
      return (edge.first - edge.second).squaredNorm();
    };
    std::nth_element(
        outline.begin(), outline.begin() + kMostEdges, outline.end(),
        [&](const OutlineEdge& a, const OutlineEdge& b) { return length(a) > length(b); });
    outline.resize(kMostEdges);
    return outline;
  }
};

namespace {

// A piece of the outline as it grows.
struct Line {
  bool is_hidden = false;
  std::vector<Eigen::Vector2d> points, low, high;
};

void AppendLine(const Line& line, Json::Value* lines) {
  if (line.points.size() < 2) return;
  Json::Value json;
  json["hidden"] = line.is_hidden;
  for (const auto& [name, points] :
       {std::pair("points", &line.points), {"low", &line.low}, {"high", &line.high}}) {
    json[name] = Json::Value(Json::arrayValue);
    for (const Eigen::Vector2d& point : *points) json[name].append(PointJson(point));
  }
  lines->append(json);
}

// The pixel of a point with the two beside it across the image of the edge.
void AddPoint(const BandView& view, const Eigen::Vector3d& world, const Eigen::Vector2d& pixel,
              const Eigen::Vector2d& across, Line* line) {
  line->points.push_back(view.Upright(pixel));
  if (!view.covariance) return;
  const auto known = ProjectWithUncertainty(view.camera, *view.covariance, world);
  const double sigma = known ? std::sqrt(across.dot(known->covariance_px * across)) : 0;
  line->low.push_back(view.Upright(pixel - kSigmas * sigma * across));
  line->high.push_back(view.Upright(pixel + kSigmas * sigma * across));
}

// Calls `take` for the pieces of the straight edge from `a` to `b` [m] that the photograph shows:
// their ends and pixels.
template <typename Take>
void ForPieces(const BandView& view, const LensView& lens, const Eigen::Vector3d& a,
               const Eigen::Vector3d& b, Take take) {
  const auto pixel_of = [&](const Eigen::Vector3d& world) {
    return lens.PixelOf(view.camera.cam_from_world * world);
  };
  const auto first = pixel_of(a), last = pixel_of(b);
  const double length = first && last ? (*last - *first).norm() : kMostPieces * kPiece;
  const int pieces = std::clamp(static_cast<int>(std::ceil(length / kPiece)), 1, kMostPieces);
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector3d from = a + (b - a) * i / pieces, to = a + (b - a) * (i + 1) / pieces;
    const auto here = pixel_of(from), next = pixel_of(to);
    if (here && next && (*next - *here).norm() > 1e-9) take(from, to, *here, *next);
  }
}

// The lines of an edge: as long as they are hidden or not, and within the frame.
template <typename IsHidden>
void AppendEdge(const BandView& view, const LensView& lens, const Eigen::Vector3d& a,
                const Eigen::Vector3d& b, IsHidden is_hidden, Json::Value* lines) {
  Line line;
  Eigen::Vector3d end = a;
  ForPieces(view, lens, a, b,
            [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector2d& here,
                const Eigen::Vector2d& next) {
              const Eigen::Vector2d along = (next - here).normalized();
              const Eigen::Vector2d across(-along.y(), along.x());
              const bool hidden = is_hidden((from + to) / 2);
              if (!line.points.empty() && (line.is_hidden != hidden || end != from)) {
                AppendLine(std::exchange(line, {}), lines);
              }
              line.is_hidden = hidden;
              if (line.points.empty()) AddPoint(view, from, here, across, &line);
              AddPoint(view, to, next, across, &line);
              end = to;
            });
  AppendLine(line, lines);
}

void AppendCorner(const BandView& view, const Eigen::Vector3d& world, Json::Value* corners) {
  const auto known = ProjectWithUncertainty(view.camera, *view.covariance, world);
  if (!known) return;
  const Eigen::Matrix2d& c = known->covariance_px;
  const double angle = std::atan2(2 * c(0, 1), c(0, 0) - c(1, 1)) / 2;
  const Eigen::Vector2d pixel = view.Upright(known->pixel);
  const Eigen::Vector2d axis =
      view.Upright(known->pixel + Eigen::Vector2d(std::cos(angle), std::sin(angle))) - pixel;
  Json::Value corner;
  corner["x"] = Rounded(pixel.x());
  corner["y"] = Rounded(pixel.y());
  corner["major"] = kSigmas * known->major_px;
  corner["minor"] = kSigmas * known->minor_px;
  corner["angle"] = std::atan2(axis.y(), axis.x());
  corners->append(corner);
}

}  // namespace

OutlineBands::OutlineBands(const SitePaths& site) : site_(site) {}
OutlineBands::~OutlineBands() = default;

std::shared_ptr<const OutlineBands::Scene> OutlineBands::Newest() {
  const std::lock_guard lock(mutex_);
  const std::string version = FileVersion(site_.environment()) + FileVersion(site_.artificial());
  if (!scene_ || version != version_) {
    scene_ =
        std::make_shared<const Scene>(ReadEnvironment(site_), ReadArtificialEnvironment(site_));
    version_ = version;
  }
  return scene_;
}

Json::Value OutlineBands::Of(const std::string& photo, const std::string& frame) {
  const std::shared_ptr<const Scene> scene = Newest();
  const SceneGeometry& geometry = scene->natural.scene;
  const size_t index = IndexOf(geometry, photo);
  BandView view{geometry.cameras[index], {}, 1};
  if (index < geometry.camera_covariances.size()) {
    view.covariance = geometry.camera_covariances[index];
  }
  for (const auto& path : ListPhotographs(site_)) {
    if (path.stem() == photo) view.orientation = ReadOrientation(path);
  }
  if (frame == "pinhole") {
    view.camera.camera = scene->natural.input_images.at(index).camera;
    // Its intrinsics are not those that the covariance is of.
    if (view.covariance) view.covariance = view.covariance->topLeftCorner(6, 6).eval();
  }
  Json::Value message;
  message["known"] = view.covariance.has_value();
  message["lines"] = message["corners"] = Json::Value(Json::arrayValue);
  const Eigen::Vector3d eye = Center(view.camera.cam_from_world);
  const LensView lens(view.camera.camera);
  for (const auto& [a, b] : scene->LongestEdges(eye)) {
    AppendEdge(
        view, lens, a, b, [&](const Eigen::Vector3d& world) { return scene->IsHidden(world, eye); },
        &message["lines"]);
  }
  if (!view.covariance) return message;
  const std::vector<Eigen::Vector3d> corners = scene->edges.CornersSeenFrom(eye);
  const size_t step = 1 + corners.size() / kMostCorners;
  for (size_t i = 0; i < corners.size(); i += step) {
    AppendCorner(view, corners[i], &message["corners"]);
  }
  return message;
}

}  // namespace insitu
