// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/render_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/foreground_matte.h"
#include "calibration/lens/undistort.h"
#include "radiometry/measure/photo_exposures.h"
#include "renderer/load_scene.h"
#include "renderer/trace/profile.h"
#include "renderer/trace/scene_hit.h"

namespace insitu {
namespace {

// Pixels of a pinhole for one of its photograph, at a pixel of the photograph.
double PinholeScale(const Camera& lens, const Camera& pinhole, const Eigen::Vector2d& pixel) {
  const auto at = [&](double dx, double dy) {
    return pinhole.Project(lens.Unproject(pixel + Eigen::Vector2d(dx, dy)));
  };
  const auto here = at(0, 0), right = at(1, 0), below = at(0, 1);
  if (!here || !right || !below) return 1;
  const Eigen::Vector2d u = *right - *here, v = *below - *here;
  return std::sqrt(std::abs(u.x() * v.y() - u.y() * v.x()));
}

// What a photograph's point spread is in its input image.
PointSpread InPinhole(PointSpread spread, const Camera& lens, const Camera& pinhole) {
  const Eigen::Vector2d center((lens.width() - 1) / 2.0, (lens.height() - 1) / 2.0);
  spread.center_sigma *= PinholeScale(lens, pinhole, center);
  spread.corner_sigma *= PinholeScale(lens, pinhole, Eigen::Vector2d::Zero());
  return spread;
}

// A matte in its photograph's frame as the pinhole sees it, resampled as the photograph is.
Raster InPinhole(const Raster& share, const Camera& lens, const Camera& pinhole) {
  constexpr float kRounding = 1e-4f;  // what resampling leaves of 0 and 1
  Raster three(share.width, share.height);
  for (size_t i = 0; i < three.data.size(); ++i) three.data[i] = share.data[i / 3];
  const Raster resampled = Reproject(three, lens, pinhole);
  Raster seen(resampled.width, resampled.height, 1);
  for (size_t i = 0; i < seen.data.size(); ++i) {
    const float m = resampled.data[3 * i];
    seen.data[i] = m < kRounding ? 0 : m > 1 - kRounding ? 1 : m;
  }
  return seen;
}

// What is shown, and grain, in the site's unit.
void SetGain(const Eigen::Vector3d& gain, RenderView* view) {
  const bool is_relit = !view->relit.data.empty();
  if (is_relit) view->in_unit = view->relit;
  if (gain == kUnitGain) return;
  view->gain = gain;
  if (!is_relit) view->in_unit = view->photo.linear;
  DivideByGain(gain, &view->in_unit);
  if (auto& grain = view->quality.grain) grain = GrainInUnit(*grain, gain);
}

Raster ReadRelitPhoto(const SitePaths& site, const std::filesystem::path& photograph,
                      const Raster& photo) {
  const std::filesystem::path file = site.relit_photo(photograph.stem().string());
  RequireResult(file, "insitu-relight");
  RequirePhotographSize(file, photo.width, photo.height);
  return ReadPhotograph(file).linear;
}

// Files in survey/ by polygon, of those that have a photograph in whose frame a mask lies.
std::map<int, std::string> MasksOf(const SitePaths& site, const SceneGeometry& scene) {
  std::map<int, std::string> of_polygon;
  const std::map<std::string, std::string> of_name = PolygonMasks(site);
  for (int p = 0; p < std::ssize(scene.polygons); ++p) {
    const auto mask = of_name.find(scene.polygons[p].name);
    if (mask != of_name.end() && scene.polygons[p].photo) of_polygon[p] = mask->second;
  }
  return of_polygon;
}

Raster MaskIn(const SitePaths& site, const std::string& file, const Camera& lens) {
  return ReadPolygonMask(site, file, lens.width(), lens.height());
}

// Adds to what stands in front in a photograph what stands before its polygons, where it shows
// those: what stands before the building the foreground's matte tells.
void AddMasked(const SitePaths& site, const MontageScene& scene, size_t camera,
               std::optional<Raster>* share) {
  const SceneGeometry& geometry = scene.natural.scene;
  const LocalImage view(geometry.cameras[camera], geometry.origin, LocalImage::ImageFunction());
  const Camera& lens = view.camera.camera;
  for (const auto& [p, file] : MasksOf(site, geometry)) {
    if (geometry.polygons[p].photo != static_cast<int>(camera)) continue;
    const Raster mask = MaskIn(site, file, lens);
    if (!*share) share->emplace(mask.width, mask.height, 1);
    const int polygon = p;
    tbb::parallel_for(0, mask.height, [&](int y) {
      for (int x = 0; x < mask.width; ++x) {
        const float before = 1 - *mask.At(x, y);
        if (before <= *(*share)->At(x, y)) continue;
        const Eigen::Vector3d direction =
            (view.camera.cam_from_world.rotation.inverse() * lens.Unproject(Eigen::Vector2d(x, y)))
                .normalized();
        const auto hit = FindHit(scene, {view.center, direction}, World::kWithBuilding);
        if (hit && !hit->is_building && hit->index == polygon) *(*share)->At(x, y) = before;
      }
    });
  }
}

}  // namespace

size_t CameraIndex(const SitePaths& site, const SceneGeometry& scene, const std::string& photo) {
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    if (scene.cameras[i].photo == photo) return i;
  }
  throw InputError(site.environment(), "has no camera for photograph " + photo +
                                           "; run insitu-reconstruct and insitu-light again");
}

const Raster& InUnit(const RenderView& view) {
  return view.in_unit.data.empty() ? view.photo.linear : view.in_unit;
}

void HeedMasks(const SitePaths& site, MontageScene* scene) {
  const NaturalEnvironment& natural = scene->natural;
  std::map<int, std::map<int, Raster>> masks;  // by photograph and polygon
  for (const auto& [p, file] : MasksOf(site, natural.scene)) {
    const int photo = *natural.scene.polygons[p].photo;
    const Camera& lens = natural.scene.cameras[photo].camera;
    masks[photo].emplace(
        p, InPinhole(MaskIn(site, file, lens), lens, natural.input_images[photo].camera));
  }
  for (auto& [photo, of_polygons] : masks) {
    const auto shared = std::make_shared<const std::map<int, Raster>>(std::move(of_polygons));
    scene->images[photo].shows = [shared](int polygon, const Eigen::Vector2d& pixel) {
      const auto mask = shared->find(polygon);
      if (mask == shared->end()) return true;
      const int x = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, mask->second.width - 1);
      const int y =
          std::clamp(static_cast<int>(std::lround(pixel.y())), 0, mask->second.height - 1);
      return *mask->second.At(x, y) > 0.5f;
    };
  }
}

RenderView LoadView(const SitePaths& site, const MontageScene& scene,
                    const std::vector<Eigen::Vector3d>& gains,
                    const std::filesystem::path& photograph, Frame frame) {
  const PhaseScope phase(Phase::kFiles);
  const NaturalEnvironment& natural = scene.natural;
  const size_t index = CameraIndex(site, natural.scene, photograph.stem().string());
  RenderView view = {natural.scene.cameras[index], natural.qualities[index], {}};
  RequirePhotographSize(photograph, view.camera.camera.width(), view.camera.camera.height());
  view.photo = ReadPhotograph(photograph);
  const Camera lens = view.camera.camera;
  auto share = ReadForegroundMatte(site, photograph.stem().string(), lens.width(), lens.height());
  view.drawn_shadows =
      ReadShadowPicture(site, photograph.stem().string(), lens.width(), lens.height());
  AddMasked(site, scene, index, &share);
  if (frame == Frame::kPinhole) {
    const Camera& pinhole = natural.input_images[index].camera;
    if (auto& spread = view.quality.point_spread) {
      spread = InPinhole(*spread, lens, pinhole);
    }
    view.camera.camera = pinhole;
    const bool is_there = gains[index] == kUnitGain && !scene.input_images.empty();
    view.photo.linear =
        is_there ? scene.input_images[index] : ReadInputImage(natural.input_images[index]);
    if (share) share = InPinhole(*share, lens, pinhole);
    if (view.drawn_shadows) view.drawn_shadows = InPinhole(*view.drawn_shadows, lens, pinhole);
  }
  if (!site.hour.empty()) {
    view.drawn_shadows.reset();  // they fall elsewhere
    if (frame == Frame::kPhoto) view.relit = ReadRelitPhoto(site, photograph, view.photo.linear);
  }
  SetGain(gains[index], &view);
  if (share) {
    view.foreground =
        std::make_shared<const Foreground>(SeparateForeground(InUnit(view), std::move(*share)));
  }
  return view;
}

}  // namespace insitu
