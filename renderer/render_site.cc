// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/render_site.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>

#include "calibration/files/error.h"
#include "calibration/files/sha256.h"
#include "calibration/files/whole_file.h"
#include "calibration/foreground_matte.h"
#include "calibration/lens/undistort.h"
#include "calibration/photo/exif.h"
#include "calibration/photo/montage_files.h"
#include "calibration/program/program.h"
#include "radiometry/light_report.h"
#include "radiometry/measure/photo_exposures.h"
#include "radiometry/transport/cosine_directions.h"
#include "renderer/photo_gain.h"
#include "renderer/shadows/existing_shadows.h"
#include "renderer/trace/interreflected_light.h"
#include "renderer/trace/make_montage_scene.h"
#include "renderer/trace/profile.h"
#include "renderer/trace/surface_textures.h"

namespace insitu {
namespace {

const Eigen::Vector3d kUnitGain = Eigen::Vector3d::Ones();

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

// With its photographs in one unit.
MontageScene LoadScene(const SitePaths& site, NaturalEnvironment natural,
                       const std::vector<Eigen::Vector3d>& gains,
                       const ArtificialEnvironment& building) {
  const PhaseScope phase(Phase::kFiles);
  std::vector<Raster> images;
  for (size_t i = 0; i < gains.size(); ++i) {
    images.push_back(ReadInputImage(natural.input_images[i]));
    if (gains[i] != kUnitGain) DivideByGain(gains[i], &images.back());
  }
  auto textures = LoadTextures(site, natural, building);
  const PhaseScope shading(Phase::kShading);
  MontageScene scene = MakeMontageScene(std::move(natural), building, std::move(images));
  scene.textures = std::move(textures);
  return scene;
}

struct View {
  PosedCamera camera;
  ImageQuality quality;  // in the site's unit
  Photograph photo;
  Eigen::Vector3d gain = kUnitGain;
  Raster in_unit = {};  // the photograph over its gain; empty where that is 1
  std::shared_ptr<const Foreground> foreground = {};  // null: nothing stands in front
  std::optional<Raster> drawn_shadows = {};           // one channel, as SunShares::share
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

// Photograph and grain in the site's unit.
void SetGain(const Eigen::Vector3d& gain, View* view) {
  if (gain == kUnitGain) return;
  view->gain = gain;
  view->in_unit = view->photo.linear;
  DivideByGain(gain, &view->in_unit);
  if (auto& grain = view->quality.grain) grain = GrainInUnit(*grain, gain);
}

const Raster& InUnit(const View& view) {
  return view.in_unit.data.empty() ? view.photo.linear : view.in_unit;
}

View LoadView(const SitePaths& site, const MontageScene& scene,
              const std::vector<Eigen::Vector3d>& gains, const std::filesystem::path& photograph,
              Frame frame) {
  const PhaseScope phase(Phase::kFiles);
  const NaturalEnvironment& natural = scene.natural;
  const size_t index = IndexOf(site, natural.scene, photograph.stem().string());
  View view = {natural.scene.cameras[index], natural.qualities[index], {}};
  RequirePhotographSize(photograph, view.camera.camera.width(), view.camera.camera.height());
  view.photo = ReadPhotograph(photograph);
  const Camera lens = view.camera.camera;
  auto share = ReadForegroundMatte(site, photograph.stem().string(), lens.width(), lens.height());
  view.drawn_shadows =
      ReadShadowPicture(site, photograph.stem().string(), lens.width(), lens.height());
  if (frame == Frame::kPinhole) {
    const Camera& pinhole = natural.input_images[index].camera;
    if (auto& spread = view.quality.point_spread) {
      spread = InPinhole(*spread, lens, pinhole);
    }
    view.camera.camera = pinhole;
    view.photo.linear = gains[index] == kUnitGain ? scene.input_images[index]
                                                  : ReadInputImage(natural.input_images[index]);
    if (share) share = InPinhole(*share, lens, pinhole);
    if (view.drawn_shadows) view.drawn_shadows = InPinhole(*view.drawn_shadows, lens, pinhole);
  }
  SetGain(gains[index], &view);
  if (share) {
    view.foreground =
        std::make_shared<const Foreground>(SeparateForeground(InUnit(view), std::move(*share)));
  }
  return view;
}

// Which part of the sun the photograph shows to arrive; nullopt: nobody has drawn it, and it is not
// looked for.
std::optional<SunShares> SunSharesOf(const MontageScene& scene, const View& view,
                                     const RenderSiteOptions& options) {
  if (view.drawn_shadows) {
    const Raster& drawn = *view.drawn_shadows;
    return SunShares{drawn, Raster(drawn.width, drawn.height, 1)};
  }
  if (!options.find_shadows || !options.with_building || !scene.interreflected) {
    return std::nullopt;
  }
  return FindExistingShadows(scene, view.camera, InUnit(view), view.foreground.get());
}

// Upright, as the montage's EXR is; what an earlier run has left goes.
void WriteSunShares(const SitePaths& site, const std::filesystem::path& photograph,
                    const std::optional<SunShares>& shares) {
  const std::filesystem::path file =
      site.montages() / (photograph.stem().string() + ".shadows.exr");
  if (!shares) {
    std::filesystem::remove(file);
    return;
  }
  Raster picture(shares->share.width, shares->share.height);
  for (size_t i = 0; i < shares->share.data.size(); ++i) {
    picture.data[3 * i] = shares->share.data[i];
    picture.data[3 * i + 1] = shares->sigma.data[i];
  }
  const CodedPhotograph upright =
      Upright(CodesOf(picture, Encoding::kLinear, {}), ReadOrientation(photograph));
  WriteWhole(file, [&](const std::filesystem::path& temporary) { WriteCodes(temporary, upright); });
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
      backs += hit && scene.artificial_normals[hit->triangle].dot(direction) > 0;
    }
  }
  return backs > kNearlyAll * 2 * kDirections;
}

// No montage is better than one of another building, or than a black one.
void RefuseMontage(const SitePaths& site, RenderSiteReport* report) {
  for (const char* ending : {".exr", ".png", ".jpg", ".tif", ".layers.exr"}) {
    std::filesystem::remove(site.montages() / (report->photo + ending));
  }
  report->is_within_building = true;
  report->remarks.push_back(
      "taken from within the building, in a solid of it: no montage was made; move the building "
      "(building/placement.json), or turn faces that look the wrong way");
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

// Of the building in every photograph, by name, with its file in montages/.
std::map<std::string, UncertaintySummary> WriteUncertainties(
    const SitePaths& site, const SceneGeometry& scene, const ArtificialEnvironment& building) {
  const PhaseScope phase(Phase::kFiles);
  std::map<std::string, UncertaintySummary> summaries;
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const auto corners = BuildingUncertainty(scene, i, building);
    if (!corners || corners->empty()) continue;
    const std::string& photo = scene.cameras[i].photo;
    WriteUncertainty(site.montages() / (photo + ".uncertainty.csv"), *corners);
    summaries[photo] = Summarize(*corners);
  }
  return summaries;
}

}  // namespace

void RenderSiteOptions::Check() const { render.Check(); }

std::vector<RenderSiteReport> RenderSite(const SitePaths& site, const RenderSiteOptions& options) {
  options.Check();
  const std::vector<std::filesystem::path> photographs = ChoosePhotographs(site, options.photos);
  const ArtificialEnvironment building =
      options.with_building ? ReadArtificialEnvironment(site) : ArtificialEnvironment();
  NaturalEnvironment natural = ReadEnvironment(site);
  const std::vector<Eigen::Vector3d> gains = ReadPhotoGains(site);
  MontageScene scene = LoadScene(site, std::move(natural), gains, building);
  if (!options.uniform_ambient) AddInterreflection(&scene, options.bounces);
  std::map<std::string, UncertaintySummary> uncertainties;
  if (options.with_building) {
    uncertainties = WriteUncertainties(site, scene.natural.scene, building);
  }
  const MontageStatement statement = StatementOf(site, options.with_building);
  std::vector<RenderSiteReport> reports;
  for (const std::filesystem::path& photograph : photographs) {
    RenderSiteReport report;
    report.photo = photograph.stem().string();
    const SceneGeometry& geometry = scene.natural.scene;
    if (IsWithinBuilding(scene, geometry.cameras[IndexOf(site, geometry, report.photo)])) {
      RefuseMontage(site, &report);
      reports.push_back(std::move(report));
      continue;
    }
    View view = LoadView(site, scene, gains, photograph, options.frame);
    Progress progress(report.photo, TileCount(view.photo.linear));
    const auto start = std::chrono::steady_clock::now();
    const auto uncertainty = uncertainties.find(report.photo);
    if (uncertainty != uncertainties.end()) report.uncertainty = uncertainty->second;
    RenderOptions render = options.render;
    if (options.sharpness == Sharpness::kMeasured) render.point_spread = view.quality.point_spread;
    if (options.with_grain) render.grain = view.quality.grain;
    render.foreground = view.foreground;
    render.is_clipped = [&view](int x, int y) { return IsClipped(view.photo, x, y); };
    const std::optional<SunShares> shares = SunSharesOf(scene, view, options);
    if (shares) render.sun_share = std::make_shared<const Raster>(shares->share);
    WriteSunShares(site, photograph, shares);
    report.point_spread = render.point_spread;
    report.has_grain = render.grain.has_value();
    report.result =
        RenderMontage(scene, view.camera, InUnit(view), render, [&progress] { progress.Step(); });
    if (!view.in_unit.data.empty()) {
      BackToPhotograph(view.photo.linear, view.in_unit, view.gain, &report.result.linear);
    }
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report.remarks = WriteMontage(site, photograph, options.frame, std::move(view.photo),
                                  report.result, statement);
    RemarkClipped(report.result, &report.remarks);
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace insitu
