// SPDX-License-Identifier: GPL-3.0-or-later
// The columns are known from the files themselves, as those of the camera are.
#include "reconstruction/exchange/import_aicon.h"

#include <cmath>
#include <map>
#include <set>

#include "calibration/camera_files/aicon_camera.h"
#include "calibration/files/text_table.h"
#include "reconstruction/geometry/omega_phi_kappa.h"

namespace insitu {
namespace {

constexpr double kMetresPerAiconUnit = 1e-3;

using Indices = std::map<std::string, int>;

std::vector<TextRow> Rows(const std::filesystem::path& path) {
  const std::vector<TextRow> rows = ReadTextRows(path, WordSeparator::kBlanks);
  if (rows.empty()) throw InputError(path, "is empty");
  return rows;
}

// NAME without ending of the one set in a folder, or of a file.
std::filesystem::path SetStem(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return std::filesystem::path(path).replace_extension();
  std::set<std::filesystem::path> stems;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    if (entry.path().extension() == ".phc") {
      stems.insert(std::filesystem::path(entry.path()).replace_extension());
    }
  }
  if (stems.size() != 1) {
    throw InputError(path, std::to_string(stems.size()) +
                               " files *.phc in this folder, expected one; name the file");
  }
  return *stems.begin();
}

std::filesystem::path File(const std::filesystem::path& stem, const std::string& ending) {
  return std::filesystem::path(stem) += ending;
}

Eigen::Vector3d Vector(const TextRow& row, size_t first, const std::string& what) {
  return {row.Number(first, what + " x"), row.Number(first + 1, what + " y"),
          row.Number(first + 2, what + " z")};
}

int Insert(const TextRow& row, const std::string& name, const char* what, Indices* indices) {
  const auto [place, is_new] = indices->emplace(name, static_cast<int>(indices->size()));
  if (!is_new) throw row.Error(std::string(what) + " \"" + name + "\" stands twice");
  return place->second;
}

// A project's marks are millimetres with one sigma for both axes, a network's are pixels with one:
// its unit of length is a square pixel, or the axes would weigh differently.
MetricCamera InSquarePixels(MetricCamera lens) {
  lens.pixel_mm.setConstant(std::sqrt(lens.pixel_mm.prod()));
  return lens;
}

std::vector<NetworkCamera> Cameras(const std::filesystem::path& ior) {
  std::vector<NetworkCamera> cameras;
  for (const AiconCamera& camera : ReadAiconCameras(ior)) {
    cameras.push_back({camera.number,
                       InSquarePixels(camera.lens),
                       {true, true, true, true, true, false, true, true, false, false}});
  }
  return cameras;
}

Indices IndicesOf(const std::vector<NetworkCamera>& cameras) {
  Indices indices;
  for (const NetworkCamera& camera : cameras) {
    indices.emplace(camera.name, static_cast<int>(indices.size()));
  }
  return indices;
}

// photo camera x y z omega phi kappa ... [mm, rad]
Indices ReadOrientations(const std::filesystem::path& path, const Indices& cameras,
                         Network* network) {
  Indices indices;
  for (const TextRow& row : Rows(path)) {
    NetworkPhoto photo;
    photo.name = row.Text(0, "photo number");
    Insert(row, photo.name, "photo", &indices);
    const auto camera = cameras.find(row.Text(1, "camera number"));
    if (camera == cameras.end()) throw row.Error("camera \"" + row.words[1] + "\" is not known");
    photo.camera = camera->second;
    photo.center = kMetresPerAiconUnit * Vector(row, 2, "position");
    photo.cam_from_local = CamFromWorldOmegaPhiKappa(Vector(row, 5, "angle about"));
    network->photos.push_back(photo);
  }
  return indices;
}

// point x y z sx sy sz rays used ... [mm]
Indices ReadPoints(const std::filesystem::path& path, Network* network,
                   std::vector<std::string>* remarks) {
  Indices indices;
  int unused = 0;
  for (const TextRow& row : Rows(path)) {
    if (row.words.size() > 8 && row.Integer(8, "flag") == 0 && ++unused) continue;
    const std::string& name = row.Text(0, "point number");
    Insert(row, name, "point", &indices);
    network->points.push_back({name, kMetresPerAiconUnit * Vector(row, 1, "coordinate")});
  }
  if (unused) remarks->push_back(std::to_string(unused) + " points are flagged as not adjusted");
  return indices;
}

// photo point x y sx sy vx vy flag used flag [mm]
void ReadMarks(const std::filesystem::path& path, const Indices& photos, const Indices& points,
               const AiconOptions& options, ImportedProject* project) {
  Network& network = project->network;
  int flagged = 0, pointless = 0;
  for (const TextRow& row : Rows(path)) {
    const auto photo = photos.find(row.Text(0, "photo number"));
    if (photo == photos.end()) throw row.Error("photo \"" + row.words[0] + "\" has no orientation");
    const Eigen::Vector2d mm(row.Number(2, "x"), row.Number(3, "y"));
    if (row.words.size() > 9 && row.Integer(9, "flag") == 0 && ++flagged) continue;
    const auto point = points.find(row.words[1]);
    if (point == points.end() && ++pointless) continue;
    const auto& lens = std::get<MetricCamera>(
        network.cameras[static_cast<size_t>(network.photos[photo->second].camera)].lens);
    network.marks.push_back({photo->second, point->second, AiconPixel(lens, mm),
                             options.mark_sigma_mm / std::sqrt(lens.pixel_mm.prod())});
  }
  if (flagged) project->remarks.push_back(std::to_string(flagged) + " marks are flagged as unused");
  if (pointless) {
    project->remarks.push_back(std::to_string(pointless) +
                               " marks are of points without coordinates");
  }
}

// number "name" from to length sigma used [mm]
void ReadScales(const std::filesystem::path& path, const Indices& points, Network* network) {
  for (const TextRow& row : Rows(path)) {
    if (row.words.size() > 6 && row.Integer(6, "flag") == 0) continue;
    const auto from = points.find(row.Text(2, "first point"));
    const auto to = points.find(row.Text(3, "second point"));
    if (from == points.end() || to == points.end()) {
      throw row.Error("a scale bar between points of which one has no coordinates");
    }
    const double length = row.Number(4, "length"), sigma = row.Number(5, "sigma");
    if (!(length > 0) || !(sigma > 0)) throw row.Error("length and sigma must be positive");
    network->distances.push_back(
        {from->second, to->second, kMetresPerAiconUnit * length, kMetresPerAiconUnit * sigma});
  }
}

}  // namespace

void AiconOptions::Check() const {
  INSITU_CHECK(mark_sigma_mm > 0 && std::isfinite(mark_sigma_mm));
}

ImportedProject ReadAiconProject(const std::filesystem::path& path, const AiconOptions& options) {
  options.Check();
  const std::filesystem::path stem = SetStem(path);
  ImportedProject project;
  project.network.cameras = Cameras(File(stem, ".ior"));
  const Indices cameras = IndicesOf(project.network.cameras);
  const Indices photos = ReadOrientations(File(stem, ".eor"), cameras, &project.network);
  const Indices points = ReadPoints(File(stem, ".obc"), &project.network, &project.remarks);
  ReadMarks(File(stem, ".phc"), photos, points, options, &project);
  if (std::filesystem::exists(File(stem, ".scale"))) {
    ReadScales(File(stem, ".scale"), points, &project.network);
  }
  return project;
}

}  // namespace insitu
