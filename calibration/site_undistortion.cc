// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/site_undistortion.h"

#include <map>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "calibration/lens/undistort.h"
#include "calibration/lens/undistort_file.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/program.h"
#include "calibration/site_cameras.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

struct Lens {
  Camera camera, pinhole;
};

// Each camera that photographs need.
std::map<std::string, Lens> ReadLenses(const SitePaths& site,
                                       const std::vector<std::string>& cameras) {
  std::map<std::string, Lens> lenses;
  for (const std::string& name : cameras) {
    if (lenses.contains(name)) continue;
    const fs::path adjusted = site.adjusted_camera(name);
    const fs::path model = fs::exists(adjusted) ? adjusted : site.camera(name);
    if (!fs::exists(model)) {
      throw InputError(model, "no such file, expected insitu-calibrate to have made it");
    }
    const Camera camera = ReadCamera(model);
    lenses.emplace(name, Lens{camera, PinholeCovering(camera)});
  }
  return lenses;
}

// Before any image, so that where all images are there, their pinholes are too.
std::vector<Camera> WritePinholes(const SitePaths& site,
                                  const std::map<std::string, Lens>& lenses) {
  std::vector<Camera> pinholes;
  for (const auto& [name, lens] : lenses) {
    WritePosedCamera(site.pinhole_camera(name), {"pinhole", lens.pinhole, Rigid3()},
                     "camera of the undistorted input images");
    pinholes.push_back(lens.pinhole);
  }
  return pinholes;
}

}  // namespace

SiteUndistortion UndistortSite(const SitePaths& site) {
  const std::vector<fs::path> photos = ListPhotographs(site);
  const std::vector<std::string> cameras = CamerasOfPhotos(site, photos);
  const std::map<std::string, Lens> lenses = ReadLenses(site, cameras);
  for (size_t i = 0; i < photos.size(); ++i) {
    const Camera& camera = lenses.at(cameras[i]).camera;
    RequirePhotographSize(photos[i], camera.width(), camera.height());
  }
  SiteUndistortion result{WritePinholes(site, lenses), static_cast<int>(photos.size()), {}};
  Progress progress("undistorting", result.photos);
  for (size_t i = 0; i < photos.size(); ++i) {
    const Lens& lens = lenses.at(cameras[i]);
    const CodedPhotograph original = ReadCodedPhotograph(photos[i]);
    if (const std::string& assumption = original.color.assumption; !assumption.empty()) {
      result.warnings.push_back(photos[i].string() + ": " + assumption);
    }
    WriteReprojected(site.input_image(photos[i].stem()), original, lens.camera, lens.pinhole);
    progress.Step();
  }
  return result;
}

std::string SiteUndistortion::BriefReport() const {
  std::string text = std::to_string(photos) + " photographs undistorted to ";
  text += pinholes.size() == 1 ? "a pinhole" : std::to_string(pinholes.size()) + " pinholes";
  for (size_t i = 0; i < pinholes.size(); ++i) {
    text += (i == 0 ? " of " : ", ") + Formatted("%.2f", pinholes[i].focal_px());
  }
  return text + " px focal length";
}

}  // namespace insitu
