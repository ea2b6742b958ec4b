// SPDX-License-Identifier: GPL-3.0-or-later
// Scanned film: the fiducial marks of a metric camera tie each scan's bitmap to the image plane,
// since the lens does not distort them. [Durisch92, §3.5]
//
// Image coordinates are millimetres on the plane, x right, y up, seen from the front of the
// picture; bitmap coordinates are pixels of the scan.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/lens/fit_camera.h"

namespace insitu {

struct Fiducial {
  std::string mark;
  Eigen::Vector2d image_mm = Eigen::Vector2d::Zero();
  Eigen::Vector2d bitmap_px = Eigen::Vector2d::Zero();
  double sigma_times = 1;  // of the other marks' sigma
};

// What `sigma_times` is of a mark whose column `state` says dubious: it counts a ninth.
inline constexpr double kDubiousFiducial = 3;

// fiducials.csv with the columns mark, x_mm, y_mm (as calibrated), photo (file name without its
// ending), x, y (of the bitmap, px), and if it likes state (dubious or nothing): the marks of each
// photo. Throws InputError, also where a mark has other millimetres in another photo or stands
// twice.
std::map<std::string, std::vector<Fiducial>> ReadFiducials(const std::filesystem::path& path);

enum class FilmTransformation { kAffine, kProjective };

// The linear map between homogeneous image and bitmap coordinates. [Durisch92, §3.5]
struct FilmMap {
  FilmTransformation transformation = FilmTransformation::kAffine;
  Eigen::Matrix3d bitmap_from_image = Eigen::Matrix3d::Identity();  // mm -> px, (2, 2) is 1
  std::vector<Eigen::Vector2d> residuals_px = {};  // of each mark, mapped - measured
  std::vector<Eigen::Vector2d> redundancies = {};  // of each coordinate, 0..1: shown of its error
  std::optional<double> sigma_px =
      {};  // of a coordinate that is not dubious; nullopt: no mark more than needed
};

// Least squares of the bitmap positions, each weighted by its sigma. nullopt: fewer than three
// marks (projective: four), or marks on one line.
std::optional<FilmMap> FitFilmMap(const std::vector<Fiducial>& marks,
                                  FilmTransformation transformation);

// film.json: {"focal_mm", "principal_point_mm": [x, y], "distortion": [[radius_mm, distortion_mm],
// ...], "transformation": "affine" | "projective", "fiducials": [{"mark", "x_mm", "y_mm"}, ...]};
// all but the first may be missing. A certificate's distortion is the measured radius less the
// undistorted one, positive outwards, at the measured radius about the principal point.
struct FilmCamera {
  double focal_mm = 0;  // calibrated focal length
  Eigen::Vector2d principal_point_mm = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> distortion;  // (radius, distortion) [mm], radii rising from > 0
  FilmTransformation transformation = FilmTransformation::kAffine;
  std::map<std::string, Eigen::Vector2d> fiducials;  // [mm], by mark
  std::filesystem::path path;
};
FilmCamera ReadFilmCamera(const std::filesystem::path& path);  // throws InputError

// Throws InputError: a mark that the certificate does not list, or lists with other millimetres.
// Certificates without fiducials say nothing.
void CheckCertified(const FilmCamera& film, const std::filesystem::path& fiducials,
                    const std::vector<Fiducial>& marks);

// The folders that hold film.json or fiducials.csv, sorted: calibration/ itself, those in it.
std::vector<std::filesystem::path> FilmFolders(const std::filesystem::path& calibration);

// The first of them; of new film calibration/ itself, or its folder film beside other cameras'.
std::filesystem::path FilmFolder(const std::filesystem::path& calibration);

// The distortion at a radius [mm]: smooth and odd through the table's values (monotone cubics),
// straight on beyond its last.
double DistortionAt(const FilmCamera& film, double radius_mm);

// Direction of sight of a place on the film, axes as the image's (x right, y down, z forward).
Eigen::Vector3d SightOfFilm(const FilmCamera& film, const Eigen::Vector2d& image_mm);

// One scan as a camera of mrcal: OPENCV8, or a splined model where that leaves more than
// 0.05 px (the scan's own shear). The camera's axes are the bitmap's: CameraFit::fit_from_lens
// tells how the scan lay. nullopt: a mirrored scan, or as FitCamera.
std::optional<CameraFit> FitFilmCamera(const FilmCamera& film, const FilmMap& map, int width,
                                       int height);

}  // namespace insitu
