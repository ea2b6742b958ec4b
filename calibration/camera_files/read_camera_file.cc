// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/read_camera_file.h"

#include <algorithm>

#include "calibration/camera_files/camera_file_formats.h"
#include "calibration/files/whole_file.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

CameraFile ReadByEnding(const fs::path& path, const CameraFileOptions& options) {
  const std::string ending = path.extension().string();
  if (ending == ".cameramodel") return {ReadCamera(path), "mrcal", 0, std::nullopt};
  if (ending == ".yml" || ending == ".yaml") return ReadYamlCamera(path, options);
  if (ending == ".xml") return ReadDbatCamera(path, options);
  if (ending == ".ior") return ReadAiconCamera(path, options);
  if (ending == ".json") return ReadJsonCamera(path, options);
  if (path.filename() == "cameras.txt") return ReadColmapCamera(path, options);
  throw InputError(path,
                   "no camera file that is read, expected .cameramodel, .yml, .yaml, .xml, "
                   ".ior, .json or cameras.txt");
}

}  // namespace

bool IsCameraFile(const fs::path& path) {
  const std::string ending = path.extension().string(), name = path.filename().string();
  if (name.starts_with('.') || name == "film.json") return false;
  return ending == ".cameramodel" || ending == ".yml" || ending == ".yaml" || ending == ".xml" ||
         ending == ".ior" || ending == ".json" || name == "cameras.txt";
}

bool SpeaksOfCamera(const fs::path& path) {
  const std::string ending = path.extension().string();
  std::vector<const char*> words;  // that a camera of this format cannot do without
  if (ending == ".json") {
    words = {"\"metric\"", "\"projection_type\""};
  } else if (ending == ".xml") {
    words = {"<camera"};
  } else if (ending == ".yml" || ending == ".yaml") {
    words = {"camera_matrix", "Camera_Matrix", "cameraMatrix", "\nK:", "M1:", "pinhole"};
  } else {
    return true;
  }
  const std::string text = "\n" + ReadWhole(path);
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return text.find(word) != std::string::npos; });
}

CameraFile ReadCameraFile(const fs::path& path, const CameraFileOptions& options) {
  options.Check();
  return ReadByEnding(path, options);
}

}  // namespace insitu
