// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/forward_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <utility>

#include "calibration/photo/photograph.h"
#include "datasets_synthetic/random.h"

namespace insitu::demo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kGrid = 2;               // samples along a pixel's side
constexpr int kBlock = 3;              // [px]
constexpr int kNear = 4;               // [px], about a changed pixel
constexpr double kChange = 0.1 / 255;  // of sRGB, that is none

// What lights a spot, before and after.
struct Lighting {
  BeforeAfter sun;
  const Incoming* rest;

  bool IsUnchanged() const {
    return sun.before == sun.after && rest->sky.before == rest->sky.after &&
           (rest->before == rest->after).all();
  }
};

enum class When { kBefore, kAfter };

// Radiance that leaves a spot by diffuse reflection [Durisch92, Eq. (6)].
Spectrum Diffuse(const Place& place, const Spot& spot, const Lighting& light, When when,
                 double footprint) {
  const bool after = when == When::kAfter;
  const double cosine = std::max(0.0, spot.normal.dot(place.site->sun)) / std::numbers::pi;
  const double sun = after ? light.sun.after : light.sun.before;
  const double sky = after ? light.rest->sky.after : light.rest->sky.before;
  const Spectrum& bounced = after ? light.rest->after : light.rest->before;
  return FaceReflectance(*spot.face, spot.face->Local(spot.point), footprint) *
         (cosine * sun * place.daylight.sun_irradiance + sky * place.daylight.sky_radiance +
          bounced);
}

bool IsVisibleChange(const Vector3d& before, const Vector3d& after) {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(SrgbFromLinear(before[i]) - SrgbFromLinear(after[i])) > kChange) return true;
  }
  return false;
}

// Renders one photograph; holds what all its pixels share.
class Renderer {
 public:
  Renderer(const BouncedLight& light, const View& view, const RenderOptions& options)
      : light_(light), place_(light.place()), view_(view), options_(options), sights_(view.lens) {
    result_.before = result_.after = Raster(view.lens.width, view.lens.height);
    result_.mask = Raster(view.lens.width, view.lens.height, 1);
    result_.records.resize(static_cast<size_t>(view.lens.width) * view.lens.height);
  }

  RenderedView Run() {
    const int block_rows = (view_.lens.height + kBlock - 1) / kBlock;
    tbb::parallel_for(0, block_rows, [this](int row) {
      for (int x = 0; x < view_.lens.width; x += kBlock) RenderBlock(x, row * kBlock);
    });
    MarkChanges();
    return std::move(result_);
  }

 private:
  // Gathered once for each face in a block of pixels: it varies slowly.
  struct LightOnFace {
    const Face* face;
    bool is_hidden;  // where the building will stand before it
    Incoming light;
  };
  struct BlockState {
    uint64_t seed;
    std::deque<LightOnFace> faces;  // keeps its addresses
  };

  Ray Sight(const Vector2d& pixel) const {
    const Vector3d in_cam = sights_.Tangents(pixel).homogeneous();
    return {view_.center, (view_.cam_from_site.transpose() * in_cam).normalized()};
  }

  Lighting LightAt(const Spot& spot, bool is_hidden, uint64_t sample_seed,
                   BlockState& block) const {
    auto known = std::find_if(block.faces.begin(), block.faces.end(), [&](const LightOnFace& face) {
      return face.face == spot.face && face.is_hidden == is_hidden;
    });
    if (known == block.faces.end()) {
      known = block.faces.insert(
          known, {spot.face, is_hidden,
                  light_.Gather(spot.point, spot.normal, options_.strata, block.seed)});
    }
    return {VisibleSun(place_, spot.point, spot.normal, sample_seed), &known->light};
  }

  // The normal that `spot` mirrors about: waves tilt water's.
  Vector3d MirrorNormal(const Spot& spot, const Vector3d& direction) const {
    if (spot.face->material != Material::kWater) return spot.normal;
    return WaveNormal(place_.site->waves, *spot.face, spot.point, -direction);
  }

  // What `spot` mirrors about `normal`, after its own way through the air.
  Spectrum Mirrored(const Spot& spot, const Vector3d& normal, const Vector3d& direction, When when,
                    uint64_t seed) const {
    Vector3d out = direction - 2 * direction.dot(normal) * normal;
    // What a wave throws downwards meets the next one.
    out -= 2 * std::min(0.0, out.dot(spot.normal)) * spot.normal;
    const Sighting sighting = Look(place_, {spot.point, out});
    const std::optional<Spot>& seen = when == When::kAfter ? sighting.after : sighting.before;
    if (!seen) return place_.daylight.sky_radiance;
    // Each sample of a pixel looks for itself.
    const int strata = std::max(1, options_.strata / kGrid);
    const Incoming rest = light_.Gather(seen->point, seen->normal, strata, seed);
    const Lighting light = {VisibleSun(place_, seen->point, seen->normal, seed), &rest};
    const double footprint = (spot.distance + seen->distance) / view_.lens.focal_x;
    return ThroughAir(place_.daylight, Diffuse(place_, *seen, light, when, footprint),
                      seen->distance);
  }

  Vector3d Color(const Spot& spot, const Vector3d& direction, const Lighting& light, When when,
                 uint64_t seed) const {
    const double cosine = std::abs(spot.normal.dot(direction));
    const double pixel_size = spot.distance / view_.lens.focal_x;
    const double footprint = pixel_size / std::sqrt(std::max(cosine, 0.01));
    Spectrum radiance = Diffuse(place_, spot, light, when, footprint);
    if (const double index = MirrorIndex(spot.face->material); index > 0) {
      const Vector3d normal = MirrorNormal(spot, direction);
      const double share = Fresnel(std::abs(normal.dot(direction)), index);
      radiance = share * Mirrored(spot, normal, direction, when, seed) + (1 - share) * radiance;
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
    colors.building = seen.after && seen.after->on_building;
    if (seen.before) {
      const Lighting light =
          LightAt(*seen.before, options_.gather_hidden_apart && colors.building, seed, block);
      const auto color = [&](When when) {
        return Color(*seen.before, sight.direction, light, when, seed);
      };
      colors.before = color(When::kBefore);
      const bool mirrors = MirrorIndex(seen.before->face->material) > 0;
      colors.after = light.IsUnchanged() && !mirrors ? colors.before : color(When::kAfter);
      record.sun += static_cast<float>(light.sun.before / (kGrid * kGrid));
      record.sky_share += static_cast<float>(light.rest->sky.before / (kGrid * kGrid));
    } else {
      colors.before = colors.after = RgbFromSpectrum(place_.daylight.sky_radiance);
    }
    if (colors.building) {
      const Lighting light = LightAt(*seen.after, false, seed, block);
      colors.after = Color(*seen.after, sight.direction, light, When::kAfter, seed);
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
    if (building) *result_.mask.At(x, y) = 1;
  }

  void MarkChanges() {
    const Raster changed = ChangedPixels();
    tbb::parallel_for(0, view_.lens.height, [&](int y) {
      for (int x = 0; x < view_.lens.width; ++x) {
        float& code = *result_.mask.At(x, y);
        if (code == 0 && IsNearChange(changed, x, y)) code = 170.0f / 255.0f;
      }
    });
  }

  Raster ChangedPixels() const {
    Raster changed(view_.lens.width, view_.lens.height, 1);
    tbb::parallel_for(0, view_.lens.height, [&](int y) {
      for (int x = 0; x < view_.lens.width; ++x) {
        *changed.At(x, y) = IsVisibleChange(result_.before.Rgb(x, y), result_.after.Rgb(x, y));
      }
    });
    return changed;
  }

  bool IsNearChange(const Raster& changed, int x, int y) const {
    for (int v = std::max(0, y - kNear); v <= std::min(changed.height - 1, y + kNear); ++v) {
      for (int u = std::max(0, x - kNear); u <= std::min(changed.width - 1, x + kNear); ++u) {
        if (*changed.At(u, v) > 0) return true;
      }
    }
    return false;
  }

  const BouncedLight& light_;
  const Place& place_;
  const View& view_;
  const RenderOptions& options_;
  SightTable sights_;
  RenderedView result_;
};

}  // namespace

RenderedView RenderView(const BouncedLight& light, const View& view, const RenderOptions& options) {
  return Renderer(light, view, options).Run();
}

}  // namespace insitu::demo
