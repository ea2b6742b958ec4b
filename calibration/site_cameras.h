// SPDX-License-Identifier: GPL-3.0-or-later
// The cameras of a site: where each comes from, and which photograph is whose.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

enum class CameraSource {
  kBoards,  // board_* photos and board.txt
  kFile,    // a file that ReadCameraFile takes
  kFilm,    // film.json and fiducials.csv: a camera for each scan, named after the photo
};

// calibration/ itself, or one folder in it for each camera and zoom setting.
struct CameraFolder {
  std::string name;  // "": calibration/ itself; there, of several lenses of COLMAP: their ids
  std::filesystem::path folder;
  CameraSource source = CameraSource::kBoards;
  std::vector<std::filesystem::path> board_photos;  // sorted; beside a camera file they go unused
  std::filesystem::path file;                       // the camera file, or film.json
};

// Sorted by name; empty: nothing of a camera is there. A finished camera goes before board photos,
// camera.cameramodel before other files; beside boards or film a file counts if it speaks of a
// camera. COLMAP's cameras.txt in calibration/ itself, with images.txt beside it, is a camera for
// each id in it that photographs have, named by it. Throws InputError: two camera files side by
// side, a camera in calibration/ itself and others in folders, film.json without fiducials.csv, an
// images.txt of none of the photographs.
std::vector<CameraFolder> ListCameraFolders(const SitePaths& site);

// The cameras that insitu-calibrate makes of these folders, as SitePaths::camera() takes them: one
// a folder, of scanned film one a photo; "" alone where there are no folders.
std::vector<std::string> CamerasOf(const std::vector<CameraFolder>& folders);

// The camera of each photograph, as SitePaths::camera() and pinhole_camera() take it; "" where the
// site has one camera in calibration/ itself, or none. A photo with fiducials has its own. Else
// site.json tells ("cameras": {photo: camera}), or COLMAP's images.txt, or there is only one, or
// EXIF model, focal length and size fit only one. Throws InputError: a photo that fits no camera or
// several, site.json naming what is not there, scanned photos without fiducials.
std::vector<std::string> CamerasOfPhotos(const SitePaths& site,
                                         const std::vector<std::filesystem::path>& photos);

}  // namespace insitu
