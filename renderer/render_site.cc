// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/render_site.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/sha256.h"
#include "calibration/files/wording.h"
#include "calibration/photo/exif.h"
#include "calibration/program/program.h"
#include "radiometry/light_report.h"
#include "radiometry/measure/photo_exposures.h"
#include "radiometry/transport/cosine_directions.h"
#include "renderer/building/building_outline.h"
#include "renderer/layers/layer_images.h"
#include "renderer/levels/simplified_building.h"
#include "renderer/light_cache.h"
#include "renderer/load_scene.h"
#include "renderer/photo_gain.h"
#include "renderer/shadows/existing_shadows.h"
#include "renderer/tiles/partial_render.h"
#include "renderer/tiles/render_inputs.h"
#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/mean_brdf.h"
#include "renderer/trace/profile.h"
#include "renderer/write_montage.h"

namespace insitu {
namespace {

// The photographs that are asked for, in the site's order.
std::vector<std::filesystem::path> ChoosePhotographs(const SitePaths& site,
                                                     const std::vector<std::string>& names) {
  const std::vector<std::filesystem::path> all = ListPhotographs(site);
  const auto is_named = [](const std::string& name) {
    return [&name](const std::filesystem::path& path) { return path.stem() == name; };
  };
  for (const std::string& name : names) {
    if (std::none_of(all.begin(), all.end(), is_named(name))) {
      throw InputError(site.photos(), "no photograph is named " + name);
    }
  }
  std::vector<std::filesystem::path> chosen;
  for (const std::filesystem::path& path : all) {
    const bool wanted =
        names.empty() || std::find(names.begin(), names.end(), path.stem().string()) != names.end();
    if (wanted) chosen.push_back(path);
  }
  return chosen;
}

// Which part of the sun the photograph shows to arrive; nullopt: nobody has drawn it, and it is not
// looked for.
std::optional<SunShares> SunSharesOf(const MontageScene& scene, const RenderView& view,
                                     const RenderSiteOptions& options) {
  if (view.drawn_shadows) {
    const Raster& drawn = *view.drawn_shadows;
    return SunShares{drawn, Raster(drawn.width, drawn.height, 1)};
  }
  const bool is_photographed = view.relit.data.empty();  // else shadows have moved
  if (!options.find_shadows || !options.with_building || !scene.interreflected ||
      !is_photographed) {
    return std::nullopt;
  }
  return FindExistingShadows(scene, view.camera, InUnit(view), view.foreground.get());
}

// In all directions but a few a solid's inside comes first.
bool IsWithinBuilding(const MontageScene& scene, const PosedCamera& camera) {
  constexpr int kDirections = 128;  // of each half
  constexpr double kNearlyAll = 0.95;
  const Eigen::Vector3d center = Center(camera.cam_from_world) - scene.natural.scene.origin;
  const CosineDirections directions(kDirections);
  int backs = 0;
  for (const double side : {1.0, -1.0}) {
    for (const Eigen::Vector3d& direction : directions.About(side * Eigen::Vector3d::UnitZ())) {
      const auto hit = scene.artificial_rays.Nearest({center, direction});
      backs += hit && scene.NormalOf(*hit).dot(direction) > 0;
    }
  }
  return backs > kNearlyAll * 2 * kDirections;
}

// No montage is better than one of another building, or than a black one.
RenderSiteReport Refused(const SitePaths& site, const std::string& photo) {
  RemoveMontage(site, photo);
  RenderSiteReport report;
  report.photo = photo;
  report.is_within_building = true;
  report.remarks.push_back(
      "taken from within the building, in a solid of it: no montage was made; move the building "
      "(building/placement.json), or turn faces that look the wrong way");
  return report;
}

// Where the photograph shows less than there was, what is drawn is a bound.
void RemarkClipped(const RenderResult& result, std::vector<std::string>* remarks) {
  const auto say = [&](long pixels, const char* what) {
    if (pixels == 0) return;
    remarks->push_back(std::to_string(pixels) + " pixels are clipped in the photograph and " +
                       what +
                       "; what they truly show is brighter: photograph shorter where that matters");
  };
  say(result.clipped_darkened, "darkened by the building, drawn as dark as they can be");
  say(result.clipped_lifted, "lit by it, drawn as the least that they can be");
}

// How well the building is known in a photograph, with its file in montages/.
std::optional<UncertaintySummary> WriteUncertaintyOf(const SitePaths& site,
                                                     const SceneGeometry& scene, size_t camera,
                                                     const BuildingEdges& edges) {
  const PhaseScope phase(Phase::kFiles);
  const Eigen::Vector3d eye = Center(scene.cameras[camera].cam_from_world);
  const auto corners = BuildingUncertainty(scene, camera, edges.CornersSeenFrom(eye));
  if (!corners || corners->empty()) return std::nullopt;
  const std::vector<CornerUncertainty> kept = ThinnedOut(*corners);
  WriteUncertainty(site.montage(scene.cameras[camera].photo) += ".uncertainty.csv", kept);
  return Summarize(kept);
}

const char* FrameName(Frame frame) { return frame == Frame::kPhoto ? "photo" : "pinhole"; }

// All that changes pixels; the number of threads does not.
std::string OptionsText(const RenderSiteOptions& options) {
  const RenderOptions& render = options.render;
  return Formatted("rays %d %d %d tolerance %.17g reach %.17g frame %d building %d sharpness %d ",
                   render.fewest_rays, render.most_rays, render.outline_rays, render.tolerance,
                   render.reach, static_cast<int>(options.frame),
                   static_cast<int>(options.with_building), static_cast<int>(options.sharpness)) +
         Formatted("block %d coarse %d avr %d occlusion %.17g ", render.block,
                   options.light_coarseness, static_cast<int>(options.avr),
                   options.occlusion_pixels) +
         Formatted("grain %d shadows %d ambient %d printed %d bounces %d",
                   static_cast<int>(options.with_grain), static_cast<int>(options.find_shadows),
                   static_cast<int>(options.uniform_ambient), static_cast<int>(options.as_printed),
                   options.bounces.value_or(-1));
}

// Of the light among surfaces, which all photographs share.
std::string LightOptionsText(const RenderSiteOptions& options) {
  return Formatted("light, building %d bounces %d coarse %d form %d occlusion %.17g",
                   static_cast<int>(options.with_building), options.bounces.value_or(-1),
                   options.light_coarseness, static_cast<int>(options.avr == AvrLevel::kForm),
                   options.occlusion_pixels);
}

// Each quality has its own, and the form without materials.
std::filesystem::path LightCacheOf(SitePaths site, const RenderSiteOptions& options) {
  site.beside = options.avr == AvrLevel::kForm ? "form" + options.quality : options.quality;
  return site.light_cache();
}

// What insitu-view must know of a montage that its files do not tell.
void WriteRenderRecord(const SitePaths& site, const std::string& photo,
                       const RenderSiteOptions& options) {
  Json::Value record;
  record["frame"] = FrameName(options.frame);
  record["with_building"] = options.with_building;
  record["most_rays"] = options.render.most_rays;
  if (options.avr != AvrLevel::kMaterials) record["avr"] = static_cast<int>(options.avr);
  if (!options.quality.empty()) record["quality"] = options.quality;
  if (!site.hour.empty()) record["hour"] = site.hour;
  WriteJson(site.render_record(photo), record);
}

ArtificialEnvironment BuildingShown(const SitePaths& site, const RenderSiteOptions& options) {
  if (!options.with_building) return {};
  ArtificialEnvironment building = ReadArtificialEnvironment(site);
  return options.avr == AvrLevel::kForm ? FormOf(std::move(building)) : building;
}

// All photographs of a run, each of which may go on where an earlier run was stopped.
class SiteRender {
 public:
  SiteRender(const SitePaths& site, const RenderSiteOptions& options)
      : SiteRender(site, options, ReadEnvironment(site)) {}

  RenderSiteReport Render(const std::filesystem::path& photograph) {
    ThrowIfStopped();
    const std::string photo = photograph.stem().string();
    const SceneGeometry& geometry = scene_.natural.scene;
    const size_t camera = CameraIndex(site_, geometry, photo);
    if (IsWithinBuilding(scene_, geometry.cameras[camera])) return Refused(site_, photo);
    RenderView view = LoadView(site_, scene_, gains_, photograph, options_.frame);
    RenderSiteReport report;
    report.photo = photo;
    std::optional<LayerImages> layers;
    if (!options_.layers.empty() && !IsDrawn(options_.avr)) {
      layers.emplace(InUnit(view), view.foreground.get(),
                     ThingsOf(scene_, building_, ReadLightErrors(site_, scene_.natural)),
                     options_.layers);
    }
    std::optional<SunShares> shares;
    if (!IsDrawn(options_.avr)) shares = SunSharesOf(scene_, view, options_);
    RenderOptions render = OptionsFor(view, shares);
    if (layers) {
      render.layers = [&](int x, int y, const LayeredPixel& pixel) { layers->Take(x, y, pixel); };
    }
    report.point_spread = render.point_spread;
    report.has_grain = render.grain.has_value();
    const auto start = std::chrono::steady_clock::now();
    report.result = IsDrawn(options_.avr)
                        ? Drawn(view)
                        : Tiles(photograph, view, render, layers ? &*layers : nullptr);
    if (!view.in_unit.data.empty()) {
      BackToPhotograph(view.relit.data.empty() ? view.photo.linear : view.relit, view.in_unit,
                       view.gain, &report.result.linear);
    }
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report.pixels = static_cast<double>(report.result.linear.width) * report.result.linear.height;
    WriteParts(photograph, layers, report.result.linear, view.gain);
    layers.reset();
    WriteSunShares(site_, photograph, shares);
    shares.reset();
    // Of a quick look beside the picture, otherwise before it, so that the memory is free.
    auto layered = std::async(options_.is_quick ? std::launch::async : std::launch::deferred, [&] {
      WriteLayers(site_, photograph, report.result);
      if (!options_.keeps_pictures) report.result.layers = report.result.unseen = {};
    });
    if (!options_.is_quick) layered.get();
    Raster linear =
        options_.keeps_pictures ? report.result.linear : std::exchange(report.result.linear, {});
    report.remarks =
        WriteMontage(site_, photograph, {options_.frame, options_.with_tiff, options_.is_quick},
                     std::move(view.photo), std::move(linear), report.result, statement_);
    if (layered.valid()) layered.get();
    RemarkClipped(report.result, &report.remarks);
    if (options_.with_building) {
      report.uncertainty = WriteUncertaintyOf(site_, geometry, camera, edges_.get());
    }
    WriteRenderRecord(site_, photo, options_);
    return report;
  }

  // For the next render, if anything was added to it; the result is there without it, too. nullopt,
  // or why it was not written.
  std::optional<std::string> KeepLight() const {
    if (!scene_.interreflected || GatheredPoints() == kept_points_) return std::nullopt;
    try {
      WriteLightCache(LightCacheOf(site_, options_), light_inputs_,
                      KeptLightOf(*scene_.interreflected));
    } catch (const std::exception& error) {
      return std::string(error.what()) + "; the next render gathers its light anew";
    }
    return std::nullopt;
  }

  // When all are written: until then none is rendered twice.
  void RemovePartials() {
    for (const auto& partial : partials_) partial->Remove();
  }

 private:
  SiteRender(const SitePaths& site, const RenderSiteOptions& options, NaturalEnvironment natural)
      : site_(site),
        options_(options),
        gains_(ReadPhotoGains(site)),
        images_(ReadSceneImages(natural.input_images, gains_, options.is_quick)),
        building_(BuildingShown(site, options)),
        edges_(std::async(options.is_quick ? std::launch::deferred : std::launch::async,
                          [this] { return BuildingEdges(building_); })
                   .share()),
        files_(SiteInputsSha256(site, natural, building_)),
        inputs_(Sha256OfText(OptionsText(options) + "\n" + files_)),
        light_inputs_(Sha256OfText(LightOptionsText(options) + "\n" + files_)),
        kept_light_(std::async(std::launch::async, [this] { return KeptLightIfAny(); })),
        scene_(SceneOf(std::move(natural))),
        statement_(StatementOf(
            site, {options.with_building, options.avr, options.quality, OptionsText(options)})) {
    ThrowIfStopped();
    HeedMasks(site, &scene_);
    scene_.as_printed = options.as_printed;
    const auto kept = kept_light_.get();
    if (options.uniform_ambient) scene_.mean_brdf_of_polygon = MeanBrdfOfPolygons(scene_);
    if (!IsLit()) return;
    AddInterreflection(&scene_, options.bounces, kept ? &*kept : nullptr, options.light_coarseness);
    if (kept) kept_points_ = GatheredPoints();
  }

  // The edges are the building's own in any case.
  MontageScene SceneOf(NaturalEnvironment natural) {
    if (options_.occlusion_pixels <= 0) {
      return LoadScene(site_, std::move(natural), std::move(images_), building_);
    }
    const ArtificialEnvironment simple =
        Simplified(building_, OcclusionSize(natural, building_, options_.occlusion_pixels));
    return LoadScene(site_, std::move(natural), std::move(images_), simple);
  }

  bool IsLit() const { return !options_.uniform_ambient && !IsDrawn(options_.avr); }

  std::optional<KeptLight> KeptLightIfAny() const {
    const PhaseScope phase(Phase::kFiles);
    if (!IsLit()) return std::nullopt;
    return ReadLightCache(LightCacheOf(site_, options_), light_inputs_);
  }

  long GatheredPoints() const {
    return scene_.interreflected->on_site.points() + scene_.interreflected->on_building.points();
  }

  void ThrowIfStopped() const {
    if (options_.stops && options_.stops()) {
      throw RenderStopped("stopped; the same command goes on where it was");
    }
  }

  RenderOptions OptionsFor(const RenderView& view, const std::optional<SunShares>& shares) const {
    RenderOptions render = options_.render;
    if (options_.sharpness == Sharpness::kMeasured) render.point_spread = view.quality.point_spread;
    if (options_.with_grain) render.grain = view.quality.grain;
    render.foreground = view.foreground;
    render.is_clipped = [&view](int x, int y) { return IsClipped(view.photo, x, y); };
    if (shares) render.sun_share = std::make_shared<const Raster>(shares->share);
    return render;
  }

  void WriteParts(const std::filesystem::path& photograph, const std::optional<LayerImages>& layers,
                  const Raster& montage, const Eigen::Vector3d& gain) const {
    const PhaseScope phase(Phase::kFiles);
    const std::filesystem::path file = site_.montage(photograph.stem().string()) += ".parts.exr";
    if (!layers) {
      std::filesystem::remove(file);  // of an earlier run
    } else {
      layers->Write(file, montage, gain, ReadOrientation(photograph));
    }
  }

  RenderResult Drawn(const RenderView& view) const {
    const DrawnView drawn = {scene_, view.camera, InUnit(view), view.foreground.get()};
    return options_.avr == AvrLevel::kSilhouette ? DrawSilhouette(drawn)
                                                 : DrawOutline(drawn, edges_.get());
  }

  // `layers`: null: none.
  RenderResult Tiles(const std::filesystem::path& photograph, const RenderView& view,
                     const RenderOptions& render, LayerImages* layers) {
    const Raster& photo = InUnit(view);
    const std::string name = photograph.stem().string();
    partials_.push_back(std::make_unique<PartialRender>(
        site_.partial_render(name),
        PartialHeader{photo.width, photo.height, FrameName(options_.frame),
                      PhotographInputsSha256(site_, inputs_, photograph)}));
    PartialRender& partial = *partials_.back();
    const int tiles = TileCount(photo.width, photo.height);
    Progress progress(name, tiles);
    RenderCourse course;
    course.earlier = partial.TakeEarlier();
    if (layers) {
      std::erase_if(course.earlier, [&](const FinishedTile& tile) {
        return !layers->TakeTile(tile.index, tile.layers);
      });
    }
    RenderWatcher* const watcher = options_.watcher;
    if (watcher) watcher->Begin(name, photo);
    for (const FinishedTile& tile : course.earlier) {
      progress.Step();
      if (watcher) watcher->Take(tile);
    }
    course.tile_done = [&](const FinishedTile& tile) {
      FinishedTile kept = tile;
      if (layers) kept.layers = layers->TileBytes(tile.index);
      partial.Keep(kept);
      progress.Step();
      if (watcher) watcher->Take(tile);
    };
    course.stops = [&] { return partial.has_failed() || (options_.stops && options_.stops()); };
    RenderResult result = RenderMontage(scene_, view.camera, photo, render, course);
    if (watcher) watcher->End(result.tiles_left == 0);
    const std::string kept = std::to_string(tiles - result.tiles_left) + " of " +
                             std::to_string(tiles) + " tiles of " + name + " are kept";
    if (partial.has_failed()) {
      throw std::runtime_error(partial.failure() + "; about " + kept +
                               ": make room, then the same command goes on there");
    }
    if (result.tiles_left > 0) {
      throw RenderStopped("stopped: " + kept + "; the same command goes on there");
    }
    return result;
  }

  const SitePaths& site_;
  const RenderSiteOptions& options_;
  const std::vector<Eigen::Vector3d> gains_;
  std::future<SceneImages> images_;  // read while the building is, until the scene takes them
  const ArtificialEnvironment building_;
  // While files are read; of a quick look, whose picture needs none, after it.
  const std::shared_future<BuildingEdges> edges_;
  const std::string files_, inputs_, light_inputs_;   // hashes
  std::future<std::optional<KeptLight>> kept_light_;  // read while the scene is made
  MontageScene scene_;
  long kept_points_ = -1;  // -1: none were kept
  const MontageStatement statement_;
  std::vector<std::unique_ptr<PartialRender>> partials_;
};

}  // namespace

void RenderSiteOptions::Check() const { render.Check(); }

std::vector<RenderSiteReport> RenderSite(const SitePaths& site, const RenderSiteOptions& options) {
  options.Check();
  const std::vector<std::filesystem::path> photographs = ChoosePhotographs(site, options.photos);
  SiteRender render(site, options);
  std::vector<RenderSiteReport> reports;
  try {
    for (const std::filesystem::path& photograph : photographs) {
      reports.push_back(render.Render(photograph));
    }
  } catch (const RenderStopped&) {
    render.KeepLight();
    throw;
  }
  if (const auto fault = render.KeepLight()) reports.back().remarks.push_back(*fault);
  render.RemovePartials();
  return reports;
}

}  // namespace insitu
