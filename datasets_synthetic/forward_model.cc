// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/forward_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "datasets_synthetic/random.h"

namespace insitu::demo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kGrid = 2;        // samples along a pixel's side
constexpr int kBlock = 2;       // [px]
constexpr double kLift = 1e-6;  // [m], keeps a ray off the face it starts on

struct LightShares {
  BeforeAfter sun, sky;
};

// A point on a face, as one sight sees it.
struct Spot {
  const Face* face;
  Vector3d point;   // lifted towards the viewer
  Vector3d normal;  // towards the viewer
  double distance;  // [m]
  bool on_building;
};

Eigen::Matrix3d BasisAbout(const Vector3d& axis) {
  Eigen::Matrix3d basis;
  basis.col(0) = axis.unitOrthogonal();
  basis.col(1) = axis.cross(basis.col(0));
  basis.col(2) = axis;
  return basis;
}

Spot SpotAt(const Ray& ray, const Hit& hit, bool on_building) {
  const double side = hit.face->normal.dot(ray.direction) > 0 ? -1 : 1;
  const Vector3d normal = side * hit.face->normal;
  const Vector3d point = ray.origin + hit.distance * ray.direction + kLift * normal;
  return {hit.face, point, normal, hit.distance, on_building};
}

// What a ray meets without the building, and what with it.
struct Sighting {
  std::optional<Spot> before, after;  // nullopt: sky
};

Sighting Look(const Place& place, const Ray& ray) {
  constexpr double kReach = 1e9;  // [m]
  std::optional<Hit> natural = NearestHit(place.campus->natural, ray, kReach);
  const double limit = natural ? natural->distance : kReach;
  const std::optional<Hit> beyond = NearestHit(place.campus->scenery, ray, limit);
  if (beyond) natural = beyond;
  Sighting seen;
  if (natural) seen.before = seen.after = SpotAt(ray, *natural, false);
  const std::optional<Hit> building =
      NearestHit(place.building, ray, natural ? natural->distance : kReach);
  if (building) seen.after = SpotAt(ray, *building, true);
  return seen;
}

// Radiance that leaves a spot by diffuse reflection [Durisch92, Eq. (6)].
Spectrum Diffuse(const Place& place, const Spot& spot, double sun_share, double sky_share,
                 double footprint) {
  const double cosine = std::max(0.0, spot.normal.dot(place.campus->sun));
  const Spectrum albedo = FaceReflectance(*spot.face, spot.face->Local(spot.point), footprint);
  return albedo * (place.daylight.sun_irradiance * (cosine * sun_share / std::numbers::pi) +
                   place.daylight.sky_radiance * sky_share);
}

// Renders one photograph; holds what all its pixels share.
class Renderer {
 public:
  Renderer(const Place& place, const View& view, const RenderOptions& options)
      : place_(place), view_(view), options_(options), sights_(view.lens) {
    result_.before = result_.after = Raster(view.lens.width, view.lens.height);
    result_.mask = Raster(view.lens.width, view.lens.height, 1);
    result_.records.resize(static_cast<size_t>(view.lens.width) * view.lens.height);
  }

  RenderedView Run() {
    const int block_rows = (view_.lens.height + kBlock - 1) / kBlock;
    tbb::parallel_for(0, block_rows, [this](int row) {
      for (int x = 0; x < view_.lens.width; x += kBlock) RenderBlock(x, row * kBlock);
    });
    return std::move(result_);
  }

 private:
  // The sky's share is taken once for each face in a block of pixels: it varies slowly.
  struct SkyOfFace {
    const Face* face;
    BeforeAfter share;
  };
  struct BlockState {
    uint64_t seed;
    std::vector<SkyOfFace> skies;
  };

  Ray Sight(const Vector2d& pixel) const {
    const Vector3d in_cam = sights_.Tangents(pixel).homogeneous();
    return {view_.center, (view_.cam_from_site.transpose() * in_cam).normalized()};
  }

  LightShares Light(const Spot& spot, uint64_t sample_seed, BlockState& block) const {
    auto sky = std::find_if(block.skies.begin(), block.skies.end(),
                            [&](const SkyOfFace& known) { return known.face == spot.face; });
    if (sky == block.skies.end()) {
      const BeforeAfter share =
          VisibleSky(place_, spot.point, spot.normal, options_.sky_strata, block.seed);
      sky = block.skies.insert(sky, {spot.face, share});
    }
    return {VisibleSun(place_, spot.point, spot.normal, sample_seed), sky->share};
  }

  // What glass mirrors at `spot`, after its own way through the air.
  Spectrum Mirrored(const Spot& spot, const Vector3d& direction, uint64_t seed) const {
    const Vector3d out = direction - 2 * direction.dot(spot.normal) * spot.normal;
    const std::optional<Spot> seen = Look(place_, {spot.point, out}).after;
    if (!seen) return place_.daylight.sky_radiance;
    const double sky =
        VisibleSky(place_, seen->point, seen->normal, options_.sky_strata, seed).after;
    const double sun = VisibleSun(place_, seen->point, seen->normal, seed).after;
    const double footprint = (spot.distance + seen->distance) / view_.lens.focal_x;
    return ThroughAir(place_.daylight, Diffuse(place_, *seen, sun, sky, footprint), seen->distance);
  }

  Vector3d Color(const Spot& spot, const Vector3d& direction, double sun, double sky,
                 uint64_t seed) const {
    const double cosine = std::abs(spot.normal.dot(direction));
    const double pixel_size = spot.distance / view_.lens.focal_x;
    const double footprint = pixel_size / std::sqrt(std::max(cosine, 0.01));
    Spectrum radiance = Diffuse(place_, spot, sun, sky, footprint);
    if (const double index = MirrorIndex(spot.face->material); index > 0) {
      const double share = Fresnel(cosine, index);
      radiance = share * Mirrored(spot, direction, seed) + (1 - share) * radiance;
    }
    return RgbFromSpectrum(ThroughAir(place_.daylight, radiance, spot.distance));
  }

  struct SampleColors {
    Vector3d before, after;
    bool building = false;
  };

  SampleColors Sample(const Ray& sight, uint64_t seed, BlockState& block, PixelRecord& record) {
    SampleColors colors;
    const Sighting seen = Look(place_, sight);
    Note(seen.before, record);
    colors.before = colors.after = RgbFromSpectrum(place_.daylight.sky_radiance);
    if (seen.before) {
      const auto [sun, sky] = Light(*seen.before, seed, block);
      colors.before = Color(*seen.before, sight.direction, sun.before, sky.before, seed);
      const bool same = sun.before == sun.after && sky.before == sky.after;
      colors.after =
          same ? colors.before : Color(*seen.before, sight.direction, sun.after, sky.after, seed);
      record.sun += static_cast<float>(sun.before / (kGrid * kGrid));
      record.sky_share += static_cast<float>(sky.before / (kGrid * kGrid));
    }
    colors.building = seen.after && seen.after->on_building;
    if (colors.building) {
      const LightShares light = Light(*seen.after, seed, block);
      colors.after = Color(*seen.after, sight.direction, light.sun.after, light.sky.after, seed);
    }
    return colors;
  }

  // Keeps the face only as long as all samples of the pixel agree.
  void Note(const std::optional<Spot>& spot, PixelRecord& record) const {
    const bool first = record.distance == 0;
    const Face* face = spot ? spot->face : nullptr;
    record.sky = !spot && (first || record.sky);
    record.face = first || record.face == face ? face : nullptr;
    record.distance = spot ? static_cast<float>(spot->distance) : -1;
    if (!spot) return;
    const double margin = 3 * spot->distance / view_.lens.focal_x;
    record.plain = IsPlain(*spot->face, spot->face->Local(spot->point), margin);
  }

  void RenderBlock(int x0, int y0) {
    BlockState block{Random(x0, y0, 1).Bits(), {}};
    for (int y = y0; y < std::min(y0 + kBlock, view_.lens.height); ++y) {
      for (int x = x0; x < std::min(x0 + kBlock, view_.lens.width); ++x) RenderPixel(x, y, block);
    }
  }

  void RenderPixel(int x, int y, BlockState& block) {
    const size_t index = static_cast<size_t>(y) * view_.lens.width + x;
    PixelRecord& record = result_.records[index];
    Vector3d before = Vector3d::Zero(), after = Vector3d::Zero();
    bool building = false;
    for (int i = 0; i < kGrid * kGrid; ++i) {
      const int column = i % kGrid, row = i / kGrid;
      const Vector2d offset((column + 0.5) / kGrid - 0.5, (row + 0.5) / kGrid - 0.5);
      const uint64_t seed = Random(index, 2, i).Bits();
      const SampleColors colors = Sample(Sight(Vector2d(x, y) + offset), seed, block, record);
      before += colors.before / (kGrid * kGrid);
      after += colors.after / (kGrid * kGrid);
      building = building || colors.building;
    }
    result_.before.SetRgb(x, y, before);
    result_.after.SetRgb(x, y, after);
    const bool changed = (before - after).cwiseAbs().maxCoeff() > 0;
    *result_.mask.At(x, y) = building ? 1.0f : changed ? 170.0f / 255.0f : 0.0f;
  }

  const Place& place_;
  const View& view_;
  const RenderOptions& options_;
  SightTable sights_;
  RenderedView result_;
};

}  // namespace

BeforeAfter VisibleSky(const Place& place, const Vector3d& point, const Vector3d& normal,
                       int strata, uint64_t seed) {
  Random random(seed, 3, 0);
  const Eigen::Matrix3d site_from_normal = BasisAbout(normal);
  BeforeAfter seen;
  for (int i = 0; i < strata * strata; ++i) {
    const int column = i % strata, row = i / strata;
    const double square_sine = (row + random.Uniform()) / strata;
    const double turn = 2 * std::numbers::pi * (column + random.Uniform()) / strata;
    const double sine = std::sqrt(square_sine), cosine = std::sqrt(1 - square_sine);
    const Ray ray{
        point, site_from_normal * Vector3d(sine * std::cos(turn), sine * std::sin(turn), cosine)};
    if (ray.direction.dot(place.campus->zenith) <= 0) continue;
    if (IsBlocked(place.campus->blockers, ray)) continue;
    seen.before += 1;
    if (!IsBlocked(place.building, ray)) seen.after += 1;
  }
  return {seen.before / (strata * strata), seen.after / (strata * strata)};
}

BeforeAfter VisibleSun(const Place& place, const Vector3d& point, const Vector3d& normal,
                       uint64_t seed) {
  constexpr int kRays = 4;
  if (normal.dot(place.campus->sun) <= 0) return {};
  Random random(seed, 4, 0);
  const Eigen::Matrix3d site_from_sun = BasisAbout(place.campus->sun);
  const double reach = std::tan(kSunDiameter / 2), start = random.Uniform();
  BeforeAfter seen;
  for (int i = 0; i < kRays; ++i) {  // a golden-angle spiral over the disc
    const double r = reach * std::sqrt((i + random.Uniform()) / kRays);
    const double turn = 2 * std::numbers::pi * (start + 0.381966011 * i);
    const Vector3d toward(r * std::cos(turn), r * std::sin(turn), 1);
    const Ray ray{point, (site_from_sun * toward).normalized()};
    if (IsBlocked(place.campus->blockers, ray)) continue;
    seen.before += 1;
    if (!IsBlocked(place.building, ray)) seen.after += 1;
  }
  return {seen.before / kRays, seen.after / kRays};
}

RenderedView RenderView(const Place& place, const View& view, const RenderOptions& options) {
  return Renderer(place, view, options).Run();
}

}  // namespace insitu::demo
