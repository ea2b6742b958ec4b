// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/site_from_exif.h"

#include <cmath>
#include <optional>

#include "calibration/files/error_at.h"
#include "calibration/lens/camera.h"
#include "calibration/photo/exif.h"

namespace insitu {
namespace {

constexpr double kSameFocal = 1e-3;  // relative

}  // namespace

void WriteCameraFromExif(const SitePaths& site, const std::vector<std::filesystem::path>& photos) {
  if (std::filesystem::exists(site.brought_camera())) {
    throw ErrorAt({site.brought_camera()},
                  Sentence("exifCameraThere", "there is a camera already: run insitu-calibrate"));
  }
  std::optional<double> focal;
  Eigen::Vector2i size(0, 0);
  for (const std::filesystem::path& photo : photos) {
    const ExifCamera exif = ReadExifCamera(photo);
    const std::optional<double> stated = exif.FocalPx();
    if (!stated) {
      throw ErrorAt({photo},
                    Sentence("exifNoFocal", "its EXIF states no focal length that can be used"));
    }
    if (focal && (size != exif.size || std::abs(*stated / *focal - 1) > kSameFocal)) {
      throw ErrorAt({photo}, Sentence("exifOther",
                                      "another size or focal length than the photographs before: "
                                      "their cameras belong into folders of calibration/"));
    }
    focal = stated;
    size = exif.size;
  }
  if (!focal) throw ErrorAt({site.photos()}, Sentence("exifNoPhotos", "no photographs"));
  std::filesystem::create_directories(site.boards());
  WritePosedCamera(site.brought_camera(),
                   {"camera",
                    Camera::Pinhole(*focal, *focal, (size.x() - 1) / 2.0, (size.y() - 1) / 2.0,
                                    size.x(), size.y()),
                    Rigid3()},
                   "focal length from EXIF, no distortion: for a first look, not for a montage");
}

Json::Value SiteFromExif(const std::vector<std::filesystem::path>& photos) {
  Json::Value site;
  for (const std::filesystem::path& photo : photos) {
    const ExifPlace place = ReadExifPlace(photo);
    const auto offer = [&](const char* name, const auto& value) {
      if (value && !site.isMember(name)) site[name] = *value;
    };
    offer("latitude", place.latitude);
    offer("longitude", place.longitude);
    offer("altitude_m", place.altitude);
    offer("local_time", place.local_time);
  }
  if (!site.isNull()) return site;
  throw ErrorAt(
      {photos.empty() ? std::filesystem::path("photos") : photos[0].parent_path()},
      Sentence(
          "exifNoPlace",
          "no photograph's EXIF states place or time: type them where the site's name stands"));
}

}  // namespace insitu
