// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/render_site.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/sha256.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/lens/undistort.h"
#include "calibration/photo/exif.h"
#include "calibration/photo/montage_files.h"
#include "calibration/program/program.h"
#include "renderer/building/building_outline.h"
#include "renderer/foreground_matte.h"
#include "renderer/render_inputs.h"
#include "renderer/tiles/partial_render.h"
#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/make_montage_scene.h"
#include "renderer/trace/profile.h"
#include "renderer/trace/surface_textures.h"

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

// Where the environment has a photograph.
size_t IndexOf(const SitePaths& site, const SceneGeometry& scene, const std::string& photo) {
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    if (scene.cameras[i].photo == photo) return i;
  }
  throw InputError(site.environment(), "has no camera for photograph " + photo +
                                           "; run insitu-reconstruct and insitu-light again");
}

Raster ReadInputImage(const InputImage& image) {
  RequireResult(image.file, "insitu-undistort");
  RequirePhotographSize(image.file, image.camera.width(), image.camera.height());
  return ReadPhotograph(image.file).linear;
}

// What a pixel in the middle of the sharpest input image spans [rad].
double PixelAngle(const NaturalEnvironment& natural) {
  double smallest = 1;
  for (const InputImage& image : natural.input_images) {
    const Eigen::Vector2d center(image.camera.width() / 2.0, image.camera.height() / 2.0);
    const Eigen::Vector3d here = image.camera.Unproject(center).normalized();
    const Eigen::Vector3d next =
        image.camera.Unproject(center + Eigen::Vector2d::UnitX()).normalized();
    smallest = std::min(smallest, (next - here).norm());
  }
  return smallest;
}

std::shared_ptr<const SurfaceTextures> LoadTextures(const SitePaths& site,
                                                    const NaturalEnvironment& natural,
                                                    const ArtificialEnvironment& building) {
  const auto has_texture = [](const SurfaceMaterial& material) {
    return !material.texture.empty();
  };
  if (std::ranges::none_of(building.materials, has_texture)) return nullptr;
  return std::make_shared<const SurfaceTextures>(building, site.building(),
                                                 site.root / "work/textures", PixelAngle(natural));
}

MontageScene LoadScene(const SitePaths& site, NaturalEnvironment natural,
                       const ArtificialEnvironment& building) {
  const PhaseScope phase(Phase::kFiles);
  std::vector<Raster> images;
  for (const InputImage& image : natural.input_images) images.push_back(ReadInputImage(image));
  auto textures = LoadTextures(site, natural, building);
  const PhaseScope shading(Phase::kShading);
  MontageScene scene = MakeMontageScene(std::move(natural), building, std::move(images));
  scene.textures = std::move(textures);
  return scene;
}

struct View {
  PosedCamera camera;
  ImageQuality quality;
  Photograph photo;
  std::shared_ptr<const Foreground> foreground = {};  // null: nothing stands in front
};

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

View LoadView(const SitePaths& site, const MontageScene& scene,
              const std::filesystem::path& photograph, Frame frame) {
  const PhaseScope phase(Phase::kFiles);
  const NaturalEnvironment& natural = scene.natural;
  const size_t index = IndexOf(site, natural.scene, photograph.stem().string());
  View view = {natural.scene.cameras[index], natural.qualities[index], {}, {}};
  RequirePhotographSize(photograph, view.camera.camera.width(), view.camera.camera.height());
  view.photo = ReadPhotograph(photograph);
  const Camera lens = view.camera.camera;
  auto share = ReadForegroundMatte(site, photograph.stem().string(), lens.width(), lens.height());
  if (frame == Frame::kPinhole) {
    const Camera& pinhole = natural.input_images[index].camera;
    if (auto& spread = view.quality.point_spread) {
      spread = InPinhole(*spread, lens, pinhole);
    }
    view.camera.camera = pinhole;
    view.photo.linear = scene.input_images[index];
    if (share) share = InPinhole(*share, lens, pinhole);
  }
  if (share) {
    view.foreground = std::make_shared<const Foreground>(
        SeparateForeground(view.photo.linear, std::move(*share)));
  }
  return view;
}

// Of all files of survey/, by their names and contents; "" if there are none.
std::string SurveySha256(const SitePaths& site) {
  if (!std::filesystem::is_directory(site.survey())) return "";
  std::map<std::string, std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(site.survey())) {
    if (!entry.is_regular_file()) continue;
    files[entry.path().lexically_relative(site.survey()).generic_string()] = entry.path();
  }
  std::string text;
  for (const auto& [name, file] : files) text += Sha256(file) + "  " + name + "\n";
  return Sha256OfText(text);
}

// What the pictures of this run state.
MontageStatement StatementOf(const SitePaths& site, bool with_building) {
  MontageStatement statement;
  statement.program = std::string("insitu ") + INSITU_VERSION;
  statement.survey_sha256 = SurveySha256(site);
  if (with_building) statement.model_sha256 = Sha256(site.artificial());
  return statement;
}

MontageStatement StatementOf(MontageStatement statement, const std::filesystem::path& photograph,
                             const RenderResult& result) {
  statement.photograph_sha256 = Sha256(photograph);
  statement.is_composite = result.building_pixels + result.changed_pixels > 0;
  statement.computed = statement.is_composite ? std::to_string(result.building_pixels) +
                                                    " pixels of the planned building, " +
                                                    std::to_string(result.changed_pixels) +
                                                    " pixels of its surroundings whose light it "
                                                    "changes; all others are the photograph's"
                                              : "nothing: all pixels are the photograph's";
  return statement;
}

std::vector<std::string> WriteMontage(const SitePaths& site,
                                      const std::filesystem::path& photograph, Frame frame,
                                      Photograph photo, const RenderResult& result,
                                      const MontageStatement& statement) {
  const PhaseScope phase(Phase::kFiles);
  // As the EXR beside it is turned.
  const CodedPhotograph layers =
      Upright(CodesOf(result.layers, Encoding::kLinear, {}), ReadOrientation(photograph));
  WriteWhole(site.montages() / (photograph.stem().string() + ".layers.exr"),
             [&](const std::filesystem::path& temporary) { WriteCodes(temporary, layers); });
  return WriteMontageFiles(site.montages() / photograph.stem(),
                           {result.linear, std::move(photo), photograph, frame == Frame::kPhoto,
                            StatementOf(statement, photograph, result)});
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
  WriteUncertainty(site.montages() / (scene.cameras[camera].photo + ".uncertainty.csv"), kept);
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
         Formatted("grain %d ambient %d bounces %d", static_cast<int>(options.with_grain),
                   static_cast<int>(options.uniform_ambient), options.bounces.value_or(-1));
}

// What insitu-view must know of a montage that its files do not tell.
void WriteRenderRecord(const SitePaths& site, const std::string& photo,
                       const RenderSiteOptions& options) {
  Json::Value record;
  record["frame"] = FrameName(options.frame);
  record["with_building"] = options.with_building;
  record["most_rays"] = options.render.most_rays;
  WriteJson(site.root / "work/render" / (photo + ".json"), record);
}

// All photographs of a run, each of which may go on where an earlier run was stopped.
class SiteRender {
 public:
  SiteRender(const SitePaths& site, const RenderSiteOptions& options)
      : site_(site),
        options_(options),
        building_(options.with_building ? ReadArtificialEnvironment(site)
                                        : ArtificialEnvironment()),
        edges_(building_),
        scene_(LoadScene(site, ReadEnvironment(site), building_)),
        inputs_(SiteInputsSha256(site, scene_.natural, building_, OptionsText(options))),
        statement_(StatementOf(site, options.with_building)) {
    ThrowIfStopped();
    if (!options.uniform_ambient) AddInterreflection(&scene_, options.bounces);
  }

  RenderSiteReport Render(const std::filesystem::path& photograph) {
    ThrowIfStopped();
    View view = LoadView(site_, scene_, photograph, options_.frame);
    RenderSiteReport report;
    report.photo = photograph.stem().string();
    const size_t camera = IndexOf(site_, scene_.natural.scene, report.photo);
    if (options_.with_building) {
      report.uncertainty = WriteUncertaintyOf(site_, scene_.natural.scene, camera, edges_);
    }
    RenderOptions render = options_.render;
    if (options_.sharpness == Sharpness::kMeasured) render.point_spread = view.quality.point_spread;
    if (options_.with_grain) render.grain = view.quality.grain;
    render.foreground = view.foreground;
    report.point_spread = render.point_spread;
    report.has_grain = render.grain.has_value();
    const auto start = std::chrono::steady_clock::now();
    report.result = Tiles(photograph, view, render);
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report.remarks = WriteMontage(site_, photograph, options_.frame, std::move(view.photo),
                                  report.result, statement_);
    WriteRenderRecord(site_, report.photo, options_);
    return report;
  }

  // When all are written: until then none is rendered twice.
  void RemovePartials() {
    for (const auto& partial : partials_) partial->Remove();
  }

 private:
  void ThrowIfStopped() const {
    if (options_.stops && options_.stops()) {
      throw RenderStopped("stopped; the same command goes on where it was");
    }
  }

  RenderResult Tiles(const std::filesystem::path& photograph, const View& view,
                     const RenderOptions& render) {
    const Raster& photo = view.photo.linear;
    const std::string name = photograph.stem().string();
    partials_.push_back(std::make_unique<PartialRender>(
        site_.root / "work/render" / (name + ".partial"),
        PartialHeader{photo.width, photo.height, FrameName(options_.frame),
                      PhotographInputsSha256(site_, inputs_, photograph)}));
    PartialRender& partial = *partials_.back();
    const int tiles = TileCount(photo.width, photo.height);
    Progress progress(name, tiles);
    RenderCourse course;
    course.earlier = partial.TakeEarlier();
    RenderWatcher* const watcher = options_.watcher;
    if (watcher) watcher->Begin(name, photo);
    for (const FinishedTile& tile : course.earlier) {
      progress.Step();
      if (watcher) watcher->Take(tile);
    }
    course.tile_done = [&](const FinishedTile& tile) {
      partial.Keep(tile);
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
  const ArtificialEnvironment building_;
  const BuildingEdges edges_;
  MontageScene scene_;
  const std::string inputs_;
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
  for (const std::filesystem::path& photograph : photographs) {
    reports.push_back(render.Render(photograph));
  }
  render.RemovePartials();
  return reports;
}

}  // namespace insitu
