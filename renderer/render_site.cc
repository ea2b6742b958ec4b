// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/render_site.h"

#include <algorithm>
#include <chrono>
#include <map>

#include "calibration/files/error.h"
#include "calibration/program/program.h"
#include "calibration/site_cameras.h"
#include "renderer/trace/make_montage_scene.h"
#include "renderer/trace/profile.h"

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

const PosedCamera& CameraOf(const NaturalEnvironment& natural, const SitePaths& site,
                            const std::string& photo) {
  for (const PosedCamera& camera : natural.scene.cameras) {
    if (camera.photo == photo) return camera;
  }
  throw InputError(site.environment(), "has no camera for photograph " + photo +
                                           "; run insitu-reconstruct and insitu-light again");
}

// The camera of each photograph's input image.
std::map<std::string, Camera> ReadPinholes(const SitePaths& site) {
  const std::vector<std::filesystem::path> photos = ListPhotographs(site);
  const std::vector<std::string> cameras = CamerasOfPhotos(site, photos);
  std::map<std::string, Camera> pinhole_of_photo;
  for (size_t i = 0; i < photos.size(); ++i) {
    const std::filesystem::path pinhole = site.pinhole_camera(cameras[i]);
    RequireResult(pinhole, "insitu-undistort");
    pinhole_of_photo.emplace(photos[i].stem().string(), ReadCamera(pinhole));
  }
  return pinhole_of_photo;
}

MontageScene LoadScene(const SitePaths& site, bool with_building) {
  const PhaseScope phase(Phase::kFiles);
  NaturalEnvironment natural = ReadEnvironment(site);
  const ArtificialEnvironment building =
      with_building ? ReadArtificialEnvironment(site) : ArtificialEnvironment();
  const std::map<std::string, Camera> pinhole_of_photo = ReadPinholes(site);
  std::vector<Camera> pinholes;
  std::vector<Raster> images;
  for (const PosedCamera& camera : natural.scene.cameras) {
    const auto pinhole = pinhole_of_photo.find(camera.photo);
    if (pinhole == pinhole_of_photo.end()) {
      throw InputError(site.photos(), "no photograph is named " + camera.photo +
                                          " as in the environment; run insitu-reconstruct again");
    }
    pinholes.push_back(pinhole->second);
    images.push_back(ReadPhotograph(site.input_image(camera.photo)).linear);
  }
  const PhaseScope shading(Phase::kShading);
  return MakeMontageScene(std::move(natural), building, pinholes, std::move(images));
}

struct View {
  PosedCamera camera;
  Photograph photo;
};

View LoadView(const SitePaths& site, const MontageScene& scene,
              const std::filesystem::path& photograph, Frame frame) {
  const PhaseScope phase(Phase::kFiles);
  const std::string name = photograph.stem().string();
  View view = {CameraOf(scene.natural, site, name), ReadPhotograph(photograph)};
  if (frame == Frame::kPinhole) {
    view.camera.camera = ReadPinholes(site).at(name);
    view.photo.linear = ReadPhotograph(site.input_image(name)).linear;
  }
  const Raster& image = view.photo.linear;
  if (image.width != view.camera.camera.width() || image.height != view.camera.camera.height()) {
    throw InputError(photograph, "is " + std::to_string(image.width) + " x " +
                                     std::to_string(image.height) + " pixels, its camera " +
                                     std::to_string(view.camera.camera.width()) + " x " +
                                     std::to_string(view.camera.camera.height()));
  }
  return view;
}

void WriteMontage(const SitePaths& site, const std::filesystem::path& photograph,
                  const Raster& picture, Encoding encoding) {
  const PhaseScope phase(Phase::kFiles);
  const std::string name = photograph.stem().string();
  WriteExr(site.montages() / (name + ".exr"), picture);
  WritePng(site.montages() / (name + ".png"), picture, encoding);
  WriteJpeg(site.montages() / (name + ".jpg"), picture, photograph);
}

// Of the building in every photograph, by name, with its file in montages/.
std::map<std::string, UncertaintySummary> WriteUncertainties(const SitePaths& site) {
  const PhaseScope phase(Phase::kFiles);
  std::map<std::string, UncertaintySummary> summaries;
  const SceneGeometry scene = ReadSceneGeometry(site);
  const ArtificialEnvironment building = ReadArtificialEnvironment(site);
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

std::vector<RenderSiteReport> RenderSite(const SitePaths& site, const RenderSiteOptions& options) {
  const std::vector<std::filesystem::path> photographs = ChoosePhotographs(site, options.photos);
  const MontageScene scene = LoadScene(site, options.with_building);
  std::map<std::string, UncertaintySummary> uncertainties;
  if (options.with_building) uncertainties = WriteUncertainties(site);
  std::vector<RenderSiteReport> reports;
  for (const std::filesystem::path& photograph : photographs) {
    const View view = LoadView(site, scene, photograph, options.frame);
    Progress progress(photograph.stem().string(), TileCount(view.photo.linear));
    const auto start = std::chrono::steady_clock::now();
    RenderSiteReport report;
    report.photo = photograph.stem().string();
    const auto uncertainty = uncertainties.find(report.photo);
    if (uncertainty != uncertainties.end()) report.uncertainty = uncertainty->second;
    report.result = RenderMontage(scene, view.camera, view.photo.linear, options.render,
                                  [&progress] { progress.Step(); });
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    WriteMontage(site, photograph, report.result.linear, view.photo.encoding);
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace insitu
