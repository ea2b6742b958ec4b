// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/ifc_model.h"

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numbers>
#include <sstream>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/external_program.h"
#include "renderer/foreign/cut_short.h"
#include "renderer/formats/ifc_script.h"
#include "renderer/formats/ifc_syntax.h"
#include "renderer/formats/temporary_folder.h"
#include "renderer/mesh/face_triangles.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

SurfaceNames NamesOf(const JsonNode& node) {
  SurfaceNames names;
  names.layer = node.At("layer").Text();
  names.block = node.At("block").Text();
  names.material = node.At("material").Text();
  names.opacity = node.At("opacity").Number();
  if (const auto srgb = node.Find("srgb")) {
    names.rgb = srgb->Vector3().cwiseMax(0).cwiseMin(1);
    for (double& channel : *names.rgb) channel = LinearFromSrgb(channel);
  }
  return names;
}

class Arrays {
 public:
  explicit Arrays(const fs::path& file) : path_(file), bytes_(ReadWhole(file)) {}

  template <typename T>
  T Take() {
    T value{};
    if (bytes_.size() - next_ < sizeof(T)) throw InputError(path_, "is cut short");
    std::memcpy(&value, bytes_.data() + next_, sizeof(T));
    next_ += sizeof(T);
    return value;
  }
  // Below `count`.
  int Index(int count) {
    const auto index = Take<uint32_t>();
    if (index >= static_cast<uint32_t>(count)) throw InputError(path_, "an index out of range");
    return static_cast<int>(index);
  }

 private:
  fs::path path_;
  std::string bytes_;
  size_t next_ = 0;
};

void ReadMesh(const fs::path& path, const fs::path& file, const JsonNode& root, Model* model) {
  constexpr double kLargest = 1e12;  // [m]
  ModelMesh& mesh = model->mesh;
  Arrays arrays(file);
  const int vertices = root.At("vertices").Integer(), triangles = root.At("triangles").Integer();
  for (int i = 0; i < vertices; ++i) {
    const auto x = arrays.Take<double>(), y = arrays.Take<double>();
    mesh.vertices.emplace_back(x, y, arrays.Take<double>());
    if (!(mesh.vertices.back().array().abs() <= kLargest).all()) {
      throw InputError(path, "a vertex is not finite or beyond 1e12 m");
    }
  }
  for (int i = 0; i < triangles; ++i) {
    const int a = arrays.Index(vertices), b = arrays.Index(vertices), c = arrays.Index(vertices);
    const int surface = arrays.Index(static_cast<int>(mesh.surfaces.size()));
    if (IsDegenerate(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c])) {
      ++model->degenerate_faces;
      continue;
    }
    mesh.triangles.emplace_back(a, b, c);
    mesh.surface_of_triangle.push_back(surface);
  }
}

Model ModelIn(const fs::path& path, const fs::path& stem) {
  const JsonNode root = JsonNode::Load(stem.string() + ".json");
  Model model;
  model.format = root.At("schema").Text();
  if (root.At("has_unit").Boolean()) model.metres_per_unit = 1;  // web-ifc has made metres of it
  for (const JsonNode& node : root.At("surfaces").Items()) {
    model.mesh.surfaces.push_back(NamesOf(node));
  }
  ReadMesh(path, stem.string() + ".bin", root, &model);
  for (const JsonNode& node : root.At("spheres").Items()) {
    const std::vector<double> s = node.Numbers();  // place, radius, surface
    model.mesh.spheres.push_back(
        {Vector3d(s.at(0), s.at(1), s.at(2)), s.at(3), static_cast<int>(s.at(4))});
  }
  for (const auto& [kind, count] : root.At("entities").Members()) {
    model.entities[kind] = count.Integer();
  }
  for (const JsonNode& node : root.At("skipped").Items()) {
    const std::vector<JsonNode> what = node.Items();
    model.skipped[{what.at(0).Text(), what.at(1).Text()}] = what.at(2).Integer();
  }
  for (const std::string& warning : root.At("warnings").Texts()) {
    model.warnings.push_back(InputError(path, warning).what());
  }
  if (const auto map = root.Find("map")) {
    model.map_from_model = Similarity3();
    const double angle = map->At("rotation_deg").Number() * std::numbers::pi / 180;
    model.map_from_model->rotation = Eigen::AngleAxisd(angle, Vector3d::UnitZ());
    model.map_from_model->translation = map->At("shift").Vector3();
    model.map_from_model->scale = map->At("scale").Number();
  }
  DropUnused(&model.mesh);
  return model;
}

void RunWebIfc(const fs::path& path, const fs::path& web_ifc, int seconds, const fs::path& folder) {
  const fs::path script = folder / "ifc_model.js", log = folder / "log";
  WriteWhole(script, kIfcScript);
  // Limits of data, not of addresses: WebAssembly reserves far more addresses than it uses.
  ExternalProgram program;
  program.command = {"prlimit",
                     "--cpu=" + std::to_string(seconds),
                     "--data=4294967296",
                     "--core=0",
                     "node",
                     script.string(),
                     web_ifc.string(),
                     fs::absolute(path).string(),
                     (folder / "model").string()};
  program.package = "util-linux";
  program.folder = folder;
  program.output = log;
  program.log = log;
  try {
    RunExternal(program);
  } catch (const InputError&) {
    std::error_code none;
    std::istringstream words(fs::is_regular_file(log, none) ? ReadWhole(log) : "");
    std::string line,
        last = "it ends without a word, or needs more than its limits: " + std::to_string(seconds) +
               " s, 4 GB";
    while (std::getline(words, line)) {
      if (!line.empty()) last = line;
    }
    if (last.find("node: No such file") != last.npos || last.find("execute node") != last.npos) {
      last = "Node.js is missing: install the Debian package nodejs, or export glTF or DXF";
    }
    throw InputError(path, "is not read by web-ifc: " + last.substr(0, 300));
  }
}

}  // namespace

std::optional<fs::path> WebIfcFolder() {
  std::error_code none;
  const char* chosen = std::getenv("INSITU_WEB_IFC");
  const fs::path bin = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const fs::path& folder :
       {fs::path(chosen ? chosen : ""), bin / "../share/insitu/web-ifc", bin / "../../web-ifc"}) {
    if (fs::is_regular_file(folder / "web-ifc-api-node.js", none)) {
      return fs::absolute(folder).lexically_normal();
    }
    if (chosen) return std::nullopt;
  }
  return std::nullopt;
}

Model ReadIfc(const fs::path& path, int seconds) {
  CheckIfcSchema(path);
  RequireEnding(path, "END-ISO-10303-21");
  CheckIfcStatements(path);
  const std::optional<fs::path> web_ifc = WebIfcFolder();
  if (!web_ifc) {
    throw InputError(path,
                     "is IFC, and its reader web-ifc is missing: run scripts/setup with a network, "
                     "or export glTF or DXF");
  }
  const TemporaryFolder folder;
  RunWebIfc(path, *web_ifc, seconds, folder.path());
  return ModelIn(path, folder.path() / "model");
}

}  // namespace insitu
