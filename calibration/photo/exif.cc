// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/exif.h"

#include <cmath>
#include <exiv2/exiv2.hpp>

#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

std::optional<double> Positive(const Exiv2::ExifData& exif, const char* key) {
  const auto entry = exif.findKey(Exiv2::ExifKey(key));
  if (entry == exif.end() || entry->count() == 0) return std::nullopt;
  const double value = entry->toFloat();
  if (!std::isfinite(value) || value <= 0) return std::nullopt;
  return value;
}

std::string Text(const Exiv2::ExifData& exif, const char* key) {
  const auto entry = exif.findKey(Exiv2::ExifKey(key));
  if (entry == exif.end()) return "";
  std::string text = entry->toString();
  text.erase(text.find_last_not_of(std::string(" \0", 2)) + 1);
  return text;
}

// Only where the file still has the size that the resolution counts.
std::optional<double> PixelMm(const Exiv2::ExifData& exif, int width) {
  const auto per_unit = Positive(exif, "Exif.Photo.FocalPlaneXResolution");
  const auto counted = Positive(exif, "Exif.Photo.PixelXDimension");
  if (!per_unit || !counted || std::lround(*counted) != width) return std::nullopt;
  const auto unit = Positive(exif, "Exif.Photo.FocalPlaneResolutionUnit");
  const long kind = unit ? std::lround(*unit) : 2;
  const double unit_mm = kind == 3 ? 10 : kind == 4 ? 1 : 25.4;  // centimetre, millimetre, inch
  return unit_mm / *per_unit;
}

}  // namespace

std::optional<double> ExifCamera::FocalPx() const {
  if (focal_mm && pixel_mm) return *focal_mm / *pixel_mm;
  if (!focal_35mm) return std::nullopt;
  return *focal_35mm / std::hypot(36.0, 24.0) * size.cast<double>().norm();
}

ExifCamera ReadExifCamera(const std::filesystem::path& photo) {
  ExifCamera camera;
  camera.size = ReadPhotographSize(photo);
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);  // cameras' own oddities are not the user's
  try {
    const auto image = Exiv2::ImageFactory::open(photo.string());
    image->readMetadata();
    const Exiv2::ExifData& exif = image->exifData();
    camera.model = Text(exif, "Exif.Image.Model");
    camera.focal_mm = Positive(exif, "Exif.Photo.FocalLength");
    camera.focal_35mm = Positive(exif, "Exif.Photo.FocalLengthIn35mmFilm");
    camera.pixel_mm = PixelMm(exif, camera.size.x());
  } catch (const Exiv2::Error&) {  // a format without metadata
  }
  return camera;
}

}  // namespace insitu
