// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/preview/turntable.h"

#include <json/writer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <unordered_map>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "reconstruction/geometry/sphere_facets.h"
#include "renderer/building/shown_environment.h"
#include "renderer/mesh/open_edges.h"
#include "renderer/preview/turntable_script.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

template <typename T>
std::string Base64(const std::vector<T>& values) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  const size_t size = values.size() * sizeof(T);
  std::string text;
  text.reserve((size + 2) / 3 * 4);
  for (size_t i = 0; i < size; i += 3) {
    uint32_t bits = static_cast<uint32_t>(bytes[i]) << 16;
    if (i + 1 < size) bits |= static_cast<uint32_t>(bytes[i + 1]) << 8;
    if (i + 2 < size) bits |= bytes[i + 2];
    text += kDigits[bits >> 18];
    text += kDigits[bits >> 12 & 63];
    text += i + 1 < size ? kDigits[bits >> 6 & 63] : '=';
    text += i + 2 < size ? kDigits[bits & 63] : '=';
  }
  return text;
}

// Ends of edges that one triangle alone has, and no row of others along them.
std::vector<uint32_t> OpenEdges(const ArtificialEnvironment& building) {
  std::unordered_map<uint64_t, int> faces_of_edge;
  const auto key_of = [](int a, int b) {
    return static_cast<uint64_t>(std::min(a, b)) << 32 | static_cast<uint32_t>(std::max(a, b));
  };
  for (const Eigen::Vector3i& t : building.triangles) {
    for (int i = 0; i < 3; ++i) ++faces_of_edge[key_of(t[i], t[(i + 1) % 3])];
  }
  EdgeCounts alone;
  for (const Eigen::Vector3i& t : building.triangles) {
    for (int i = 0; i < 3; ++i) {
      const int from = t[i], to = t[(i + 1) % 3];
      if (faces_of_edge.at(key_of(from, to)) == 1) AddEdge(from, to, 1, &alone);
    }
  }
  std::vector<uint64_t> open;
  for (const auto& [key, passes] : CutAtCorners(alone, building.vertices)) open.push_back(key);
  std::ranges::sort(open);  // the same bytes on every machine
  std::vector<uint32_t> ends;
  for (const uint64_t key : open) {
    ends.push_back(static_cast<uint32_t>(key >> 32));
    ends.push_back(static_cast<uint32_t>(key));
  }
  return ends;
}

// One part a material: its triangles in the order of their layers, and how many each layer has, so
// that a page of 100 000 layers has few things to draw.
Json::Value Parts(const ArtificialEnvironment& building, const TurntableLayers& layers) {
  std::map<int, std::map<int, std::vector<uint32_t>>> corners_of;  // by material, layer
  for (size_t t = 0; t < building.triangles.size(); ++t) {
    auto& corners = corners_of[building.material_of_triangle[t]][layers.layer_of_triangle[t]];
    for (const int corner : building.triangles[t]) corners.push_back(static_cast<uint32_t>(corner));
  }
  Json::Value parts(Json::arrayValue);
  for (const auto& [index, of_layers] : corners_of) {
    std::vector<uint32_t> triangles, runs;
    for (const auto& [layer, corners] : of_layers) {
      triangles.insert(triangles.end(), corners.begin(), corners.end());
      runs.push_back(static_cast<uint32_t>(layer));
      runs.push_back(static_cast<uint32_t>(corners.size() / 3));
    }
    const SurfaceMaterial& material = building.materials[index];
    Json::Value part;
    part["rgb"] = ToJson(Eigen::VectorXd(material.diffuse_rgb));
    part["opacity"] = material.glass ? 1 - material.glass->weight : 1.0;
    part["triangles"] = Base64(triangles);
    part["runs"] = Base64(runs);
    parts.append(part);
  }
  return parts;
}

Json::Value BuildingJson(const ArtificialEnvironment& building, const TurntableLayers& layers) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : building.vertices) box.extend(vertex);
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(building.vertices.size());
  for (const Vector3d& vertex : building.vertices) {
    positions.push_back((vertex - box.center()).cast<float>());
  }
  Json::Value json;
  json["center"] = ToJson(Eigen::VectorXd(box.center()));
  json["size"] = std::max(box.diagonal().norm(), 1e-3);
  json["positions"] = Base64(positions);
  json["open_edges"] = Base64(OpenEdges(building));
  json["parts"] = Parts(building, layers);
  json["layers"] = Json::arrayValue;
  for (const std::string& name : layers.names) json["layers"].append(name);
  return json;
}

TurntableLayers LayersOfFacets(TurntableLayers layers) {
  constexpr size_t kFacets = SphereFacetCount(kDrawnSphereLevel);
  for (const int layer : layers.layer_of_sphere) {
    layers.layer_of_triangle.insert(layers.layer_of_triangle.end(), kFacets, layer);
  }
  layers.layer_of_sphere.clear();
  return layers;
}

// "</script>" in a name would end the script.
std::string Escaped(std::string json) {
  for (size_t at = json.find("</"); at != json.npos; at = json.find("</", at + 3)) {
    json.replace(at, 2, "<\\/");
  }
  return json;
}

constexpr char kTurntable[] = R"(<style>
 #turn { width: 100%; height: 34rem; border: 1px solid #ddd; touch-action: none; }
 #turn-layers { max-height: 12rem; overflow-y: auto; display: grid;
  grid-template-columns: repeat(auto-fill, minmax(16rem, 1fr)); column-gap: 1rem; }
 #turn-layers label { overflow-wrap: anywhere; }
</style>
<canvas id="turn" aria-label="the building, to be turned with the mouse"></canvas>
<p id="turn-told" role="status">Drag to turn, the right button moves, the wheel enlarges; click a point for its
 place, a second one for the distance.</p>
<p><label><input type="checkbox" id="turn-edges" checked> open edges in red</label>
 <label><input type="checkbox" id="turn-backs"> backs of faces in magenta</label>
 <label><input type="checkbox" id="turn-all" checked> <span id="turn-all-said">all layers</span></label>
 <label id="turn-find" hidden>named <input type="search" id="turn-name" size="20"></label></p>
<div id="turn-layers"></div>
<p id="turn-more" hidden></p>
)";

}  // namespace

TurntableLayers LayersOf(const ModelMesh& mesh) {
  TurntableLayers layers;
  std::map<std::string, int> index_of_name;
  const auto layer_of = [&](int surface) {
    const auto [found, is_new] = index_of_name.try_emplace(mesh.surfaces[surface].layer,
                                                           static_cast<int>(layers.names.size()));
    if (is_new) layers.names.push_back(found->first);
    return found->second;
  };
  for (const int surface : mesh.surface_of_triangle) {
    layers.layer_of_triangle.push_back(layer_of(surface));
  }
  for (const ModelSphere& sphere : mesh.spheres) {
    layers.layer_of_sphere.push_back(layer_of(sphere.surface));
  }
  return layers;
}

std::optional<fs::path> ThreeFolder() {
  std::error_code none;
  const char* chosen = std::getenv("INSITU_THREE");
  const fs::path bin = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const fs::path& folder :
       {fs::path(chosen ? chosen : ""), bin / "../share/insitu/three", bin / "../../three"}) {
    if (fs::is_regular_file(folder / "three.min.js", none)) {
      return fs::absolute(folder).lexically_normal();
    }
    if (chosen) return std::nullopt;
  }
  return std::nullopt;
}

std::string Turntable(const ArtificialEnvironment& building, const TurntableLayers& layers) {
  INSITU_CHECK(layers.layer_of_triangle.size() == building.triangles.size());
  INSITU_CHECK(layers.layer_of_sphere.size() == building.spheres.size());
  if (!building.spheres.empty()) {
    return Turntable(Faceted(building, kDrawnSphereLevel), LayersOfFacets(layers));
  }
  const std::optional<fs::path> three = ThreeFolder();
  if (!three || building.triangles.empty()) return "";
  Json::StreamWriterBuilder compact;
  compact["indentation"] = "";
  const std::string json = Json::writeString(compact, BuildingJson(building, layers));
  return kTurntable + ("<script>" + ReadWhole(*three / "three.min.js")) + "</script>\n<script>" +
         ReadWhole(*three / "OrbitControls.js") +
         "</script>\n<script>const BUILDING = " + Escaped(json) + ";</script>\n<script>" +
         kTurntableScript + "</script>\n";
}

}  // namespace insitu
