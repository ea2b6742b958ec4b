// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/model_notes.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "calibration/files/error.h"

namespace insitu {
namespace {

// Whether it is much longer along y than along x and z, as a tower that lies on its back is.
bool SeemsToLie(const ModelMesh& mesh) {
  constexpr double kMuch = 1.5;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
  const Eigen::Vector3d size = box.sizes();
  return size.y() > kMuch * std::max(size.x(), size.z());
}

// Empty: both are known. OBJ, PLY and STL have no word for either.
std::string UnitAndAxis(const Model& model, const Placement& placement) {
  const bool no_unit = !model.metres_per_unit && !placement.metres_per_unit;
  const bool no_axis =
      !placement.y_up && (model.format == "OBJ" || model.format == "PLY" || model.format == "STL");
  std::string axis =
      "no vertical axis: z taken as up (\"up\": \"y\" in placement.json if it lies "
      "on its side";
  if (no_axis && SeemsToLie(model.mesh)) axis += ", as it seems: it is longest along y";
  axis += ")";
  if (no_unit) return "names no unit: taken as metres" + (no_axis ? "; and " + axis : "");
  return no_axis ? "names " + axis : "";
}

// "12 LINE, 3 TEXT"
std::string CountsOf(const std::map<std::string, int>& counts) {
  std::string list;
  for (const auto& [kind, count] : counts) {
    list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  }
  return list;
}

}  // namespace

std::vector<std::string> NotesOnModel(const std::filesystem::path& file, const Model& model,
                                      const Placement& placement) {
  std::vector<std::string> notes;
  const auto note = [&](const std::string& text) {
    notes.emplace_back(InputError(file, text).what());
  };
  const bool empty = model.mesh.triangles.empty();
  const std::string assumed = empty ? "" : UnitAndAxis(model, placement);
  if (!assumed.empty()) note(assumed);
  std::map<std::string, std::map<std::string, int>> kinds_of_reason;
  for (const auto& [what, count] : model.skipped) kinds_of_reason[what.second][what.first] += count;
  for (const auto& [reason, kinds] : kinds_of_reason) {
    note("left out: " + CountsOf(kinds) + " (" + reason + ")");
  }
  if (model.degenerate_faces > 0) {
    note("left out: " + std::to_string(model.degenerate_faces) +
         " faces of no area, or whose outline crosses itself");
  }
  if (empty) note("has no surface to show");
  notes.insert(notes.end(), model.warnings.begin(), model.warnings.end());
  return notes;
}

}  // namespace insitu
