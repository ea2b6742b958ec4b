// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure_sky.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <system_error>
#include <utility>

#include "calibration/files/wording.h"
#include "calibration/foreground_matte.h"

namespace insitu {

namespace {

void Average(const SpectralBins& bins, Spectrum* power) {
  const double mean = power->head(bins.count).mean();
  power->head(bins.count).setConstant(mean);
}

double TimesAsBright(const Spectrum& sky, const Spectrum& other, const SpectralBins& bins) {
  return Tristimulus(sky, bins).y() / std::max(1e-12, Tristimulus(other, bins).y());
}

// What tells one state of lens and matte from another.
std::string StateOf(const SitePaths& site, const PosedCamera& posed) {
  std::string state = posed.camera.lens_model();
  for (const double value : posed.camera.intrinsics()) state += Number(" %.17g", value);
  const std::filesystem::path matte = ForegroundMatteFile(site, posed.photo);
  std::error_code none;
  const auto written = std::filesystem::last_write_time(matte, none);
  if (none) return state;
  const auto size = std::filesystem::file_size(matte, none);
  return state + " " + std::to_string(written.time_since_epoch().count()) + " " +
         std::to_string(size);
}

}  // namespace

const SkyBlocks& KeptSkyBlocks::Of(const SitePaths& site, const SceneGeometry& scene,
                                   const PhotographSet& photos, size_t index) {
  const PosedCamera& posed = scene.cameras[index];
  Kept& kept = of_photo_[posed.photo];
  std::string state = StateOf(site, posed);
  if (kept.made_of == state) return kept.blocks;
  const Camera& camera = posed.camera;
  const auto matte = ReadForegroundMatte(site, posed.photo, camera.width(), camera.height());
  kept.blocks = SkyBlocksOf(*photos[index], camera, matte ? &*matte : nullptr);
  kept.made_of = std::move(state);
  return kept.blocks;
}

SeenSky MeasureSky(const SitePaths& site, const PhotographSet& photos,
                   const std::vector<PixelSample>& horizon, bool is_average, KeptSkyBlocks* kept,
                   NaturalEnvironment* environment) {
  const SceneGeometry& scene = environment->scene;
  const RayScene rays(MeshOfPolygons(scene).mesh);
  std::vector<const SkyBlocks*> blocks;
  for (size_t i = 0; i < photos.size(); ++i) blocks.push_back(&kept->Of(site, scene, photos, i));
  std::vector<std::vector<SkyRegion>> in_photo(photos.size());
  tbb::parallel_for(size_t{0}, photos.size(), [&](size_t i) {
    in_photo[i] = SkyRegionsIn(*blocks[i], static_cast<int>(i), scene, rays, horizon);
  });
  std::vector<SkyRegion> regions;
  for (std::vector<SkyRegion>& some : in_photo) {
    std::ranges::move(some, std::back_inserter(regions));
  }
  std::vector<SkyPlace> places;
  std::set<int> photos_with_sky;
  for (const SkyRegion& region : SkyAmong(std::move(regions))) {
    photos_with_sky.insert(region.photo);
    std::ranges::copy(region.places, std::back_inserter(places));
  }
  std::optional<Eigen::Vector3d> sun;
  if (scene.sun) sun = scene.sun->unit;
  SeenSky sky{FitSky(places, scene.zenith.unit, sun, environment->spectra),
              static_cast<int>(photos_with_sky.size())};
  if (sky.fit.shape.IsUniform()) return sky;
  if (is_average) {
    Average(environment->spectra.bins(), &sky.fit.shape.gradation);
    Average(environment->spectra.bins(), &sky.fit.shape.glow);
  }
  environment->light.sky_shape = sky.fit.shape;
  environment->light.photographed_sky = sky.fit.level;
  return sky;
}

bool IsAnotherSky(const Spectrum& photographed, const Spectrum& lighting,
                  const SpectralBins& bins) {
  constexpr double kOtherSky = 1.5;  // times as bright
  const double times = TimesAsBright(photographed, lighting, bins);
  return times >= kOtherSky || times <= 1 / kOtherSky;
}

void WarnOfAnotherSky(const NaturalEnvironment& environment, const SeenSky& sky,
                      std::vector<Sentence>* warnings) {
  if (!sky.fit.level) return;
  const SpectralBins& bins = environment.spectra.bins();
  const Spectrum lighting = environment.light.sky_radiance + environment.light.ambient_radiance;
  if (!IsAnotherSky(*sky.fit.level, lighting, bins)) return;
  const double times = TimesAsBright(*sky.fit.level, lighting, bins);
  warnings->push_back(
      Sentence("lightOtherSky",
               "the photographs show a sky {times} times as bright as that which lights the "
               "daylight samples: is their albedo right, and are all photographs of one exposure?",
               {{"times", Number("%.2g", times)}}));
}

}  // namespace insitu
