// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/model_notes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr double kMuch = 1.5;

// Whether it is much longer along y than along x and z, as a tower that lies on its back is.
bool IsLongestAlongY(const ModelMesh& mesh) {
  const Eigen::Vector3d size = BoxOf(mesh).sizes();
  return size.y() > kMuch * std::max(size.x(), size.z());
}

// Whether most faces look along y, at several places along it, as floors and ceilings do.
bool HasFloorsAlongY(const ModelMesh& mesh) {
  constexpr double kAlong = 0.98, kStep = 0.1, kLevel = 0.1;  // cosine; [m]; share of the area
  constexpr int kFewestLevels = 4;
  Eigen::Vector3d areas = Eigen::Vector3d::Zero();
  std::map<int64_t, double> area_at;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    const Eigen::Vector3d area = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a) / 2;
    const double size = area.norm();
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(area[axis]) > kAlong * size) areas[axis] += size;
    }
    const bool is_floor = std::abs(area.y()) > kAlong * size && std::abs(a.y()) < 1e9;
    if (is_floor) area_at[std::llround(a.y() / kStep)] += size;
  }
  if (areas.y() <= kMuch * std::max(areas.x(), areas.z())) return false;
  const auto levels = std::ranges::count_if(
      area_at, [&](const auto& level) { return level.second > kLevel * areas.y(); });
  return levels >= kFewestLevels;
}

// Empty: both are known. OBJ, PLY and STL have no word for either.
std::string UnitAndAxis(const Model& model, const Placement& placement) {
  const bool no_unit = !model.metres_per_unit && !placement.metres_per_unit;
  const bool no_axis =
      !placement.y_up && (model.format == "OBJ" || model.format == "PLY" || model.format == "STL");
  std::string axis =
      "no vertical axis: z taken as up (\"up\": \"y\" in placement.json if it lies "
      "on its side";
  if (no_axis && IsLongestAlongY(model.mesh)) {
    axis += ", as it seems: it is longest along y";
  } else if (no_axis && HasFloorsAlongY(model.mesh)) {
    axis += ", as it seems: most of its faces look along y, as floors do";
  }
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
  const bool empty = model.mesh.IsEmpty();
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
