// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_lenses.h"

#include <filesystem>
#include <string>

#include "calibration/calibration_report.h"
#include "calibration/files/json_file.h"
#include "calibration/photo/photograph.h"
#include "calibration/site_cameras.h"

namespace insitu {
namespace {

LivePhoto ReadLivePhoto(const SitePaths& site, const std::filesystem::path& path,
                        const std::string& camera) {
  LivePhoto photo{path.stem().string(), {}};
  if (!camera.empty()) photo.lens.camera = camera;
  if (!std::filesystem::exists(site.camera(camera))) {
    photo.no_lens_because = Sentence("noLens", "its lens is not known yet: run insitu-calibrate");
    return photo;
  }
  try {
    photo.camera = ReadCamera(site.camera(camera));
    RequirePhotographSize(path, photo.camera->width(), photo.camera->height());
    if (const auto covariance = ReadIntrinsicsCovariance(site, camera)) {
      photo.lens.covariance = *covariance;
    }
  } catch (const InputError& error) {
    photo.camera.reset();
    photo.no_lens_because = SentenceOf(error);
  }
  return photo;
}

}  // namespace

std::vector<LivePhoto> ReadLivePhotos(const SitePaths& site) {
  const std::vector<std::filesystem::path> paths = ListPhotographs(site);
  std::vector<LivePhoto> photos;
  try {
    const std::vector<std::string> cameras = CamerasOfPhotos(site, paths);
    for (size_t i = 0; i < paths.size(); ++i) {
      photos.push_back(ReadLivePhoto(site, paths[i], cameras[i]));
    }
  } catch (const InputError& error) {
    photos.clear();
    for (const auto& path : paths) {
      photos.push_back({path.stem().string(), {}, {}, SentenceOf(error)});
    }
  }
  return photos;
}

std::optional<LiveSite> ReadLiveSite(const SitePaths& site) {
  if (!std::filesystem::exists(site.description())) return std::nullopt;
  try {
    const JsonNode root = JsonNode::Load(site.description());
    const auto latitude = root.Find("latitude"), longitude = root.Find("longitude"),
               north = root.Find("true_north");
    if (!latitude || !longitude || !north || north->Vector3().norm() == 0) return std::nullopt;
    LiveSite read{{latitude->Number(), longitude->Number()}, north->Vector3().normalized(), {}};
    if (const auto altitude = root.Find("altitude_m")) read.place.altitude = altitude->Number();
    if (const auto time = root.Find("local_time")) read.julian_day = JulianDayOf(time->Text());
    return read;
  } catch (const InputError&) {
    return std::nullopt;  // the page shows the file's fault at its own table
  }
}

}  // namespace insitu
