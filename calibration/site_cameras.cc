// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/site_cameras.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "calibration/camera_files/colmap_cameras.h"
#include "calibration/camera_files/film.h"
#include "calibration/camera_files/read_camera_file.h"
#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/photo/exif.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

constexpr double kSameFocal = 0.02;  // zoom lenses state their focal length roughly

// ---- folders -------------------------------------------------------------------------------

std::vector<fs::path> SortedFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The camera file among a folder's files: by its name where nothing else in the folder could be
// meant, else by its content.
std::optional<fs::path> FindCameraFile(const std::vector<fs::path>& files, bool is_alone) {
  std::vector<fs::path> named, speaking;
  for (const fs::path& file : files) {
    if (file.filename() == "camera.cameramodel") return file;
    if (!IsCameraFile(file)) continue;
    named.push_back(file);
    if (SpeaksOfCamera(file)) speaking.push_back(file);
  }
  const std::vector<fs::path>& found = speaking.empty() && is_alone ? named : speaking;
  if (found.size() > 1) {
    throw InputError(found[1], "is a second camera file beside " + found[0].filename().string() +
                                   ", expected one a folder");
  }
  return found.empty() ? std::nullopt : std::optional(found.front());
}

void RequireBothOfFilm(const fs::path& folder) {
  for (const char* needed : {"film.json", "fiducials.csv"}) {
    if (fs::exists(folder / needed)) continue;
    throw InputError(folder / needed,
                     "no such file, expected film.json and fiducials.csv together for scanned "
                     "film");
  }
}

std::optional<CameraFolder> ReadCameraFolder(const std::string& name, const fs::path& folder) {
  CameraFolder camera{name, folder, CameraSource::kBoards, {}, {}};
  const std::vector<fs::path> files = SortedFiles(folder);
  for (const fs::path& file : files) {
    if (file.filename().string().starts_with("board_") && IsPhotograph(file)) {
      camera.board_photos.push_back(file);
    }
  }
  const bool is_film = fs::exists(folder / "film.json") || fs::exists(folder / "fiducials.csv");
  if (const auto file = FindCameraFile(files, camera.board_photos.empty() && !is_film)) {
    camera.source = CameraSource::kFile;
    camera.file = *file;
  } else if (is_film) {
    RequireBothOfFilm(folder);
    camera.source = CameraSource::kFilm;
    camera.file = folder / "film.json";
  } else if (camera.board_photos.empty()) {
    return std::nullopt;
  }
  return camera;
}

// ---- a COLMAP model's lenses, often one a photograph ---------------------------------------

fs::path ColmapImages(const SitePaths& site) { return site.boards() / "images.txt"; }

// By photograph: the camera's id in cameras.txt. A model may be of more photographs than the site.
std::map<std::string, std::string> ColmapCameraOfPhotos(const SitePaths& site,
                                                        const std::vector<fs::path>& photos) {
  const std::map<std::string, uint32_t> camera_of_image =
      ReadColmapCameraOfImages(ColmapImages(site));
  std::map<std::string, std::string> camera_of_photo;
  for (const fs::path& photo : photos) {
    const auto image = camera_of_image.find(photo.stem());
    if (image != camera_of_image.end()) {
      camera_of_photo.emplace(photo.stem(), std::to_string(image->second));
    }
  }
  if (!camera_of_photo.empty() || photos.empty()) return camera_of_photo;
  throw InputError(ColmapImages(site),
                   "names none of the photographs in photos/, expected a model of these: " +
                       photos.front().filename().string() + " and so on");
}

bool HoldsColmapLenses(const SitePaths& site, const CameraFolder& folder) {
  return folder.source == CameraSource::kFile && folder.folder == site.boards() &&
         folder.file.filename() == "cameras.txt" && fs::exists(ColmapImages(site)) &&
         ReadColmapCameras(folder.file).size() > 1;
}

// One folder for each lens that photographs have, all with the same file.
std::vector<CameraFolder> ColmapLenses(const SitePaths& site, const CameraFolder& model) {
  std::set<std::string> ids;
  for (const auto& [photo, id] : ColmapCameraOfPhotos(site, ListPhotographs(site))) ids.insert(id);
  std::vector<CameraFolder> lenses;
  for (const std::string& id : ids) {
    lenses.push_back(model);
    lenses.back().name = id;
  }
  return lenses;
}

// No other camera of calibration/ itself has a name.
bool AreColmapLenses(const SitePaths& site, const std::vector<CameraFolder>& folders) {
  return folders.front().folder == site.boards() && !folders.front().name.empty();
}

// ---- which photo is whose ------------------------------------------------------------------

std::string Stem(const fs::path& photo) { return photo.stem().string(); }

std::string Names(const std::vector<CameraFolder>& folders) {
  std::string names;
  for (const CameraFolder& folder : folders) names += (names.empty() ? "" : ", ") + folder.name;
  return names;
}

// "cameras" of site.json.
std::map<std::string, std::string> ReadAssignment(const SitePaths& site,
                                                  const std::vector<CameraFolder>& folders,
                                                  const std::vector<fs::path>& photos) {
  std::map<std::string, std::string> camera_of_photo;
  if (!fs::exists(site.description())) return camera_of_photo;
  const auto node = JsonNode::Load(site.description()).Find("cameras");
  if (!node) return camera_of_photo;
  for (const auto& [photo, camera] : node->Members()) {
    const std::string name = camera.Text();
    const bool is_known = std::any_of(folders.begin(), folders.end(),
                                      [&](const CameraFolder& each) { return each.name == name; });
    if (!is_known) {
      throw camera.Error("is \"" + name +
                         "\", expected a folder of calibration/: " + Names(folders));
    }
    const bool is_photo =
        std::any_of(photos.begin(), photos.end(),
                    [&wanted = photo](const fs::path& each) { return Stem(each) == wanted; });
    if (!is_photo) throw camera.Error("is of a photo that is not in the folder photos");
    camera_of_photo[photo] = name;
  }
  return camera_of_photo;
}

// What is known of the photographs that a camera takes; no size: a file that does not tell it.
struct Profile {
  ExifCamera exif;
  bool has_size = true;
};

Profile ProfileOf(const CameraFolder& folder) {
  if (folder.source == CameraSource::kBoards) return {ReadExifCamera(folder.board_photos.front())};
  Profile profile;
  try {
    const CameraFile file = ReadCameraFile(folder.file, {std::nullopt, folder.name});
    profile.exif.size = {file.camera.width(), file.camera.height()};
  } catch (const InputError&) {  // said when it is calibrated
    profile.has_size = false;
  }
  return profile;
}

bool MayBe(const ExifCamera& photo, const Profile& camera) {
  if (camera.has_size && photo.size != camera.exif.size) return false;
  if (!photo.model.empty() && !camera.exif.model.empty() && photo.model != camera.exif.model) {
    return false;
  }
  if (!photo.focal_mm || !camera.exif.focal_mm) return true;
  return std::abs(*photo.focal_mm / *camera.exif.focal_mm - 1) < kSameFocal;
}

std::string MatchByExif(const SitePaths& site, const fs::path& photo,
                        const std::vector<CameraFolder>& folders,
                        const std::vector<Profile>& profiles) {
  const ExifCamera exif = ReadExifCamera(photo);
  std::vector<CameraFolder> fitting;
  for (size_t i = 0; i < folders.size(); ++i) {
    if (MayBe(exif, profiles[i])) fitting.push_back(folders[i]);
  }
  if (fitting.size() == 1) return fitting.front().name;
  const std::string what =
      fitting.empty() ? "its size, model and focal length fit none of the cameras " + Names(folders)
                      : "its size, model and focal length fit the cameras " + Names(fitting);
  throw InputError(photo, what + "; expected \"cameras\": {\"" + Stem(photo) + "\": \"...\"} in " +
                              site.description().string());
}

// The folder of scanned film that lists a photo.
std::map<std::string, fs::path> FilmOfPhotos(const std::vector<CameraFolder>& folders,
                                             const std::vector<fs::path>& photos) {
  std::set<std::string> names;
  for (const fs::path& photo : photos) names.insert(Stem(photo));
  std::map<std::string, fs::path> film_of_photo;
  for (const CameraFolder& folder : folders) {
    if (folder.source != CameraSource::kFilm) continue;
    const fs::path fiducials = folder.folder / "fiducials.csv";
    for (const auto& [photo, marks] : ReadFiducials(fiducials)) {
      if (!names.contains(photo)) {
        throw InputError(fiducials, "photo " + photo + " is not in the folder photos");
      }
      if (std::any_of(folders.begin(), folders.end(), [&wanted = photo](const CameraFolder& each) {
            return each.name == wanted;
          })) {
        throw InputError(fiducials, "photo " + photo +
                                        " is named as a camera folder, expected "
                                        "another name for one of them");
      }
      const auto [other, is_new] = film_of_photo.emplace(photo, folder.folder);
      if (is_new) continue;
      throw InputError(fiducials, "photo " + photo + " has marks in " + other->second.string() +
                                      " too, expected one camera for it");
    }
  }
  return film_of_photo;
}

}  // namespace

std::vector<CameraFolder> ListCameraFolders(const SitePaths& site) {
  std::vector<CameraFolder> folders;
  if (!fs::is_directory(site.boards())) return folders;
  if (const auto only = ReadCameraFolder("", site.boards())) folders.push_back(*only);
  for (const fs::directory_entry& entry : fs::directory_iterator(site.boards())) {
    if (!entry.is_directory() || entry.path().filename().string().starts_with('.')) continue;
    const auto folder = ReadCameraFolder(entry.path().filename().string(), entry.path());
    if (folder) folders.push_back(*folder);
  }
  std::sort(folders.begin(), folders.end(),
            [](const CameraFolder& a, const CameraFolder& b) { return a.name < b.name; });
  if (folders.size() > 1 && folders.front().name.empty()) {
    throw InputError(site.boards(), "holds a camera of its own beside that in " +
                                        folders[1].folder.filename().string() +
                                        ", expected each camera in a folder");
  }
  if (folders.size() == 1 && HoldsColmapLenses(site, folders.front())) {
    return ColmapLenses(site, folders.front());
  }
  return folders;
}

std::vector<std::string> CamerasOf(const std::vector<CameraFolder>& folders) {
  if (folders.empty()) return {""};
  std::vector<std::string> cameras;
  for (const CameraFolder& folder : folders) {
    if (folder.source != CameraSource::kFilm) {
      cameras.push_back(folder.name);
      continue;
    }
    for (const auto& [photo, marks] : ReadFiducials(folder.folder / "fiducials.csv")) {
      cameras.push_back(photo);
    }
  }
  return cameras;
}

std::vector<std::string> CamerasOfPhotos(const SitePaths& site,
                                         const std::vector<fs::path>& photos) {
  for (const fs::path& photo : photos) RequireNoPanorama(photo);
  const std::vector<CameraFolder> folders = ListCameraFolders(site);
  if (folders.empty()) return std::vector<std::string>(photos.size());
  const auto film_of_photo = FilmOfPhotos(folders, photos);
  auto assigned = ReadAssignment(site, folders, photos);
  if (AreColmapLenses(site, folders)) {
    assigned.merge(ColmapCameraOfPhotos(site, photos));
  }
  std::vector<CameraFolder> lenses;  // those that are no scanned film's
  std::copy_if(folders.begin(), folders.end(), std::back_inserter(lenses),
               [](const CameraFolder& each) { return each.source != CameraSource::kFilm; });
  std::vector<Profile> profiles;
  if (lenses.size() > 1) {
    std::transform(lenses.begin(), lenses.end(), std::back_inserter(profiles), ProfileOf);
  }
  std::vector<std::string> cameras;
  for (const fs::path& photo : photos) {
    const auto named = assigned.find(Stem(photo));
    if (film_of_photo.contains(Stem(photo))) {
      cameras.push_back(Stem(photo));
    } else if (lenses.empty()) {
      throw InputError(folders.front().folder / "fiducials.csv",
                       "has no marks of photo " + Stem(photo) +
                           ", expected three or more of every scanned photo");
    } else if (named != assigned.end()) {
      cameras.push_back(named->second);
    } else if (lenses.size() == 1) {
      cameras.push_back(lenses.front().name);
    } else {
      cameras.push_back(MatchByExif(site, photo, lenses, profiles));
    }
  }
  return cameras;
}

}  // namespace insitu
