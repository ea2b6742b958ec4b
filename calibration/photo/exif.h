// SPDX-License-Identifier: GPL-3.0-or-later
// What a photograph's metadata tell of its camera.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

namespace insitu {

struct ExifCamera {
  std::string model;                 // maker's name of the camera; may be empty
  std::optional<double> focal_mm;    // as set
  std::optional<double> focal_35mm;  // that would show the same on 35 mm film
  std::optional<double> pixel_mm;    // of the focal plane, as the maker states it
  Eigen::Vector2i size = {0, 0};     // of the file itself [px]
  bool IsEmpty() const { return model.empty() && !focal_mm && !focal_35mm; }

  // The focal length in pixels, from focal_mm and pixel_mm if both are there, else from focal_35mm
  // by the diagonal; nullopt: neither.
  std::optional<double> FocalPx() const;
};

// Where and when a photograph was taken, as far as it states it.
struct ExifPlace {
  std::optional<double> latitude, longitude;  // [deg], north and east positive
  std::optional<double> altitude;             // [m]
  std::optional<std::string> local_time;      // "2024-05-15T09:45:00+02:00"; without the offset
                                              // where that is not stated
};

// Where the satellite receiver's antenna was, with standard deviations east, north, up.
struct ExifPosition {
  double latitude = 0, longitude = 0;  // [deg], WGS 84
  double altitude = 0;                 // [m]
  Eigen::Vector3d sigma_m;
  bool is_sigma_stated = false;  // by XMP of drones (RtkStdLon, ...) or EXIF's GPSHPositioningError
};

// nullopt: latitude, longitude or altitude is not stated. Without a word on it a position is taken
// to be good to 5 m in plan and 10 m in height, what single-frequency receivers in cameras and
// telephones reach under an open sky [GPS SPS Performance Standard, 2020].
std::optional<ExifPosition> ReadExifPosition(const std::filesystem::path& photo);

// Empty when the file holds no metadata.
ExifPlace ReadExifPlace(const std::filesystem::path& photo);

// All but the size is empty when the file holds no metadata. Throws InputError: not an image.
ExifCamera ReadExifCamera(const std::filesystem::path& photo);

// How long and how wide the shutter was open, as far as it is stated.
struct ExifExposure {
  std::optional<double> time_s, f_number, iso;  // > 0

  // What a given radiance makes in the file, up to a factor of the camera: t ISO / N^2. nullopt:
  // not all of it is stated.
  std::optional<double> Relative() const;
};

// Nominal values: makers round them to thirds of a stop, some lenses are off by as much again.
ExifExposure ReadExifExposure(const std::filesystem::path& photo);

// Throws InputError if a photograph says that it is a panorama (GPano): no lens shows it.
void RequireNoPanorama(const std::filesystem::path& photo);

// How a photograph is to be turned to stand upright, 1 to 8 as EXIF counts; 1: not stated.
int ReadOrientation(const std::filesystem::path& photo);

}  // namespace insitu
