// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/photo/exif.h"

#include <cmath>
#include <exiv2/exiv2.hpp>

#include "calibration/files/error.h"
#include "calibration/files/raw_ending.h"
#include "calibration/photo/photograph.h"
#include "calibration/photo/raw_photograph.h"

namespace insitu {
namespace {

constexpr double kReceiverPlan = 5, kReceiverHeight = 10;  // [m], single-frequency, open sky

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

// Degrees, minutes, seconds and the letter of the side.
std::optional<double> Degrees(const Exiv2::ExifData& exif, const std::string& key,
                              const std::string& negative) {
  const auto entry = exif.findKey(Exiv2::ExifKey(key));
  if (entry == exif.end() || entry->count() < 3) return std::nullopt;
  const double degrees = entry->toFloat(0) + entry->toFloat(1) / 60.0 + entry->toFloat(2) / 3600.0;
  if (!std::isfinite(degrees) || std::abs(degrees) > 180) return std::nullopt;
  return Text(exif, (key + "Ref").c_str()) == negative ? -degrees : degrees;
}

std::optional<double> Altitude(const Exiv2::ExifData& exif) {
  const auto entry = exif.findKey(Exiv2::ExifKey("Exif.GPSInfo.GPSAltitude"));
  if (entry == exif.end() || !std::isfinite(entry->toFloat())) return std::nullopt;
  const bool is_below_sea = Text(exif, "Exif.GPSInfo.GPSAltitudeRef") == "1";
  return is_below_sea ? -entry->toFloat() : entry->toFloat();
}

// "2024:05:15 09:45:00" and "+02:00" as ISO 8601.
std::optional<std::string> LocalTime(const Exiv2::ExifData& exif) {
  std::string time = Text(exif, "Exif.Photo.DateTimeOriginal");
  if (time.size() != 19 || time[4] != ':' || time[7] != ':' || time[10] != ' ') return std::nullopt;
  time[4] = time[7] = '-';
  time[10] = 'T';
  return time + Text(exif, "Exif.Photo.OffsetTimeOriginal");
}

// Without metadata, what an empty file's would be.
Exiv2::ExifData ReadExif(const std::filesystem::path& photo) {
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);  // cameras' own oddities are not the user's
  try {
    const auto image = Exiv2::ImageFactory::open(photo.string());
    image->readMetadata();
    return image->exifData();
  } catch (const Exiv2::Error&) {  // a format without metadata
    return {};
  }
}

// By the last part of its key, whatever prefix the maker gives the namespace.
std::optional<double> PositiveXmp(const std::filesystem::path& photo, const std::string& tag) {
  try {
    const auto image = Exiv2::ImageFactory::open(photo.string());
    image->readMetadata();
    for (const Exiv2::Xmpdatum& entry : image->xmpData()) {
      const double value = entry.tagName() == tag ? entry.toFloat() : 0;
      if (std::isfinite(value) && value > 0) return value;
    }
  } catch (const Exiv2::Error&) {  // a format without metadata
  }
  return std::nullopt;
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
  const Exiv2::ExifData exif = ReadExif(photo);
  camera.model = Text(exif, "Exif.Image.Model");
  camera.focal_mm = Positive(exif, "Exif.Photo.FocalLength");
  camera.focal_35mm = Positive(exif, "Exif.Photo.FocalLengthIn35mmFilm");
  camera.pixel_mm = PixelMm(exif, camera.size.x());
  return camera;
}

ExifPlace ReadExifPlace(const std::filesystem::path& photo) {
  const Exiv2::ExifData exif = ReadExif(photo);
  return {Degrees(exif, "Exif.GPSInfo.GPSLatitude", "S"),
          Degrees(exif, "Exif.GPSInfo.GPSLongitude", "W"), Altitude(exif), LocalTime(exif)};
}

std::optional<ExifPosition> ReadExifPosition(const std::filesystem::path& photo) {
  const ExifPlace place = ReadExifPlace(photo);
  if (!place.latitude || !place.longitude || !place.altitude) return std::nullopt;
  ExifPosition position{*place.latitude, *place.longitude, *place.altitude,
                        Eigen::Vector3d(kReceiverPlan, kReceiverPlan, kReceiverHeight), false};
  if (const auto error =
          Positive(ReadExif(photo), "Exif.GPSInfo.GPSHPositioningError")) {  // of the radius
    const double plan = *error / std::sqrt(2.0);
    position.sigma_m = {plan, plan, 2 * plan};
    position.is_sigma_stated = true;
  }
  const auto east = PositiveXmp(photo, "RtkStdLon"), north = PositiveXmp(photo, "RtkStdLat"),
             up = PositiveXmp(photo, "RtkStdHgt");
  if (!east || !north || !up) return position;
  position.sigma_m = {*east, *north, *up};
  position.is_sigma_stated = true;
  return position;
}

std::optional<double> ExifExposure::Relative() const {
  if (!time_s || !f_number || !iso) return std::nullopt;
  return *time_s * *iso / (*f_number * *f_number);
}

ExifExposure ReadExifExposure(const std::filesystem::path& photo) {
  const Exiv2::ExifData exif = ReadExif(photo);
  return {Positive(exif, "Exif.Photo.ExposureTime"), Positive(exif, "Exif.Photo.FNumber"),
          Positive(exif, "Exif.Photo.ISOSpeedRatings")};
}

void RequireNoPanorama(const std::filesystem::path& photo) {
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);  // of what is cut short others say so
  std::string projection;
  try {
    const auto image = Exiv2::ImageFactory::open(photo.string());
    image->readMetadata();
    const auto entry = image->xmpData().findKey(Exiv2::XmpKey("Xmp.GPano.ProjectionType"));
    if (entry != image->xmpData().end()) projection = entry->toString();
  } catch (const Exiv2::Error&) {  // without metadata, or without GPano in it
    return;
  }
  if (projection.empty()) return;
  throw InputError(photo, "is a panorama (GPano: " + projection +
                              "), expected a photograph that a lens made; put the single "
                              "photographs that it was joined from into the folder");
}

int ReadOrientation(const std::filesystem::path& photo) {
  if (HasRawEnding(photo)) return ReadRawOrientation(photo);
  const auto stated = Positive(ReadExif(photo), "Exif.Image.Orientation");
  return stated && *stated <= 8 ? static_cast<int>(std::lround(*stated)) : 1;
}

}  // namespace insitu
