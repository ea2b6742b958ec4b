// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/building_writer.h"

#include <json/value.h>

#include <cstdio>
#include <numbers>
#include <string>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

constexpr const char* kBlockRecord = "1F";  // handle of the table every block record belongs to
constexpr const char* kModelSpace = "20";   // handle of the model space's record
constexpr const char* kWindowRecord = "21";

// The text of a DXF file: pairs of a group code and a value.
class Drawing {
 public:
  void Add(int code, const std::string& value) {
    text_ += std::to_string(code) + "\n" + value + "\n";
  }
  void Add(int code, int value) { Add(code, std::to_string(value)); }
  void Add(int code, double value) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.6f", value);
    Add(code, std::string(digits));
  }

  // Group codes 10 + corner, 20 + corner, 30 + corner.
  void AddPoint(const Vector3d& point, int corner = 0) {
    for (int axis = 0; axis < 3; ++axis) Add(10 * (axis + 1) + corner, point[axis]);
  }

  // The head of an entity or table entry with a handle of its own; returns the handle.
  std::string Begin(const std::string& kind, const std::string& owner) {
    char handle[32];
    std::snprintf(handle, sizeof handle, "%X", next_handle_++);
    BeginAs(kind, handle, owner);
    return handle;
  }
  void BeginAs(const std::string& kind, const std::string& handle, const std::string& owner) {
    Add(0, kind);
    Add(5, handle);
    Add(330, owner);
  }

  void BeginEntity(const std::string& kind, const std::string& owner, const std::string& layer) {
    Begin(kind, owner);
    Add(100, std::string("AcDbEntity"));
    Add(8, layer);
  }

  void BeginSection(const std::string& name) {
    Add(0, std::string("SECTION"));
    Add(2, name);
  }
  void End(const std::string& what) { Add(0, what); }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
  int next_handle_ = 0x100;
};

void WriteHeader(Drawing& drawing) {
  drawing.BeginSection("HEADER");
  drawing.Add(9, std::string("$ACADVER"));
  drawing.Add(1, std::string("AC1015"));
  drawing.Add(9, std::string("$HANDSEED"));
  drawing.Add(5, std::string("FFFF"));
  drawing.Add(9, std::string("$INSUNITS"));
  drawing.Add(70, 6);
  drawing.End("ENDSEC");
}

void BeginTable(Drawing& drawing, const std::string& name, const std::string& handle, int entries) {
  drawing.Add(0, std::string("TABLE"));
  drawing.Add(2, name);
  drawing.Add(5, handle);
  drawing.Add(330, std::string("0"));
  drawing.Add(100, std::string("AcDbSymbolTable"));
  drawing.Add(70, entries);
}

void WriteLayer(Drawing& drawing, const std::string& name, int color) {
  drawing.Begin("LAYER", "2");
  drawing.Add(100, std::string("AcDbSymbolTableRecord"));
  drawing.Add(100, std::string("AcDbLayerTableRecord"));
  drawing.Add(2, name);
  drawing.Add(70, 0);
  drawing.Add(62, color);
  drawing.Add(6, std::string("CONTINUOUS"));
}

void WriteTables(Drawing& drawing, const std::vector<Material>& layers) {
  drawing.BeginSection("TABLES");
  BeginTable(drawing, "LAYER", "2", static_cast<int>(layers.size()) + 1);
  WriteLayer(drawing, "0", 7);
  int color = 1;
  for (const Material layer : layers) WriteLayer(drawing, MaterialName(layer), color++);
  drawing.End("ENDTAB");
  BeginTable(drawing, "BLOCK_RECORD", kBlockRecord, 2);
  for (const auto& [handle, name] :
       {std::pair<const char*, const char*>{kModelSpace, "*Model_Space"},
        {kWindowRecord, "WINDOW"}}) {
    drawing.BeginAs("BLOCK_RECORD", handle, kBlockRecord);
    drawing.Add(100, std::string("AcDbSymbolTableRecord"));
    drawing.Add(100, std::string("AcDbBlockTableRecord"));
    drawing.Add(2, std::string(name));
  }
  drawing.End("ENDTAB");
  drawing.End("ENDSEC");
}

void WritePanel(Drawing& drawing, const Panel& panel, const std::string& owner,
                const Vector3d& origin) {
  drawing.BeginEntity("3DFACE", owner, MaterialName(panel.material));
  drawing.Add(100, std::string("AcDbFace"));
  const size_t last = panel.corners.size() - 1;
  for (size_t i = 0; i < 4; ++i) {
    drawing.AddPoint(panel.corners[std::min(i, last)] + origin, static_cast<int>(i));
  }
}

void WriteBlock(Drawing& drawing, const std::string& name, const std::string& owner,
                const std::vector<Panel>& panels) {
  drawing.BeginEntity("BLOCK", owner, "0");
  drawing.Add(100, std::string("AcDbBlockBegin"));
  drawing.Add(2, name);
  drawing.Add(70, 0);
  drawing.AddPoint(Vector3d::Zero());
  drawing.Add(3, name);
  drawing.Add(1, std::string());
  for (const Panel& panel : panels) WritePanel(drawing, panel, owner, Vector3d::Zero());
  drawing.BeginEntity("ENDBLK", owner, "0");
  drawing.Add(100, std::string("AcDbBlockEnd"));
}

void WriteInsert(Drawing& drawing, const Placement& placement, const Vector3d& origin) {
  drawing.BeginEntity("INSERT", kModelSpace, "0");
  drawing.Add(100, std::string("AcDbBlockReference"));
  drawing.Add(2, std::string("WINDOW"));
  drawing.AddPoint(placement.position + origin);
  drawing.Add(50, placement.turn * 180 / std::numbers::pi);
}

// A POLYLINE's own record; its vertices follow.
void BeginPolyline(Drawing& drawing, Material material, const std::string& subclass, int flags,
                   int count_m, int count_n) {
  drawing.BeginEntity("POLYLINE", kModelSpace, MaterialName(material));
  drawing.Add(100, subclass);
  drawing.Add(66, 1);
  drawing.AddPoint(Vector3d::Zero());
  drawing.Add(70, flags);
  drawing.Add(71, count_m);
  drawing.Add(72, count_n);
}

void WriteVertex(Drawing& drawing, Material material, const std::string& subclass, int flags,
                 const Vector3d& point) {
  drawing.BeginEntity("VERTEX", kModelSpace, MaterialName(material));
  drawing.Add(100, std::string("AcDbVertex"));
  drawing.Add(100, subclass);
  drawing.AddPoint(point);
  drawing.Add(70, flags);
}

void EndPolyline(Drawing& drawing, Material material) {
  drawing.BeginEntity("SEQEND", kModelSpace, MaterialName(material));
}

void WritePolyface(Drawing& drawing, const Polyhedron& body, const Vector3d& origin) {
  constexpr int kPolyface = 64, kVertex = 128 + 64, kFace = 128;
  BeginPolyline(drawing, body.material, "AcDbPolyFaceMesh", kPolyface,
                static_cast<int>(body.vertices.size()), static_cast<int>(body.triangles.size()));
  for (const Vector3d& vertex : body.vertices) {
    WriteVertex(drawing, body.material, "AcDbPolyFaceMeshVertex", kVertex, vertex + origin);
  }
  for (const Eigen::Vector3i& triangle : body.triangles) {
    drawing.BeginEntity("VERTEX", kModelSpace, MaterialName(body.material));
    drawing.Add(100, std::string("AcDbFaceRecord"));
    drawing.AddPoint(Vector3d::Zero());
    drawing.Add(70, kFace);
    for (int i = 0; i < 3; ++i) drawing.Add(71 + i, triangle[i] + 1);
  }
  EndPolyline(drawing, body.material);
}

void WritePolygonMesh(Drawing& drawing, const RoundMesh& mesh, const Vector3d& origin) {
  constexpr int kMesh = 16, kClosedInM = 1, kClosedInN = 32, kMeshVertex = 64;
  const int flags = kMesh + kClosedInN + (mesh.is_ring ? kClosedInM : 0);
  BeginPolyline(drawing, mesh.material, "AcDbPolygonMesh", flags, mesh.rows, mesh.columns);
  for (const Vector3d& vertex : mesh.vertices) {
    WriteVertex(drawing, mesh.material, "AcDbPolygonMeshVertex", kMeshVertex, vertex + origin);
  }
  EndPolyline(drawing, mesh.material);
}

void WriteEntities(Drawing& drawing, const Building& building, const Vector3d& origin) {
  drawing.BeginSection("ENTITIES");
  for (const Panel& panel : building.panels) WritePanel(drawing, panel, kModelSpace, origin);
  for (const Placement& window : building.windows) WriteInsert(drawing, window, origin);
  for (const Polyhedron& body : building.bodies) WritePolyface(drawing, body, origin);
  for (const RoundMesh& mesh : building.meshes) WritePolygonMesh(drawing, mesh, origin);
  drawing.End("ENDSEC");
}

// What R2000 readers insist on: a root dictionary.
void WriteObjects(Drawing& drawing) {
  drawing.BeginSection("OBJECTS");
  drawing.BeginAs("DICTIONARY", "C", "0");
  drawing.Add(100, std::string("AcDbDictionary"));
  drawing.End("ENDSEC");
}

Json::Value RgbJson(const Vector3d& rgb) {
  Json::Value array(Json::arrayValue);
  for (const double value : rgb) array.append(std::round(value * 1e5) / 1e5);
  return array;
}

}  // namespace

void WriteDxf(const std::filesystem::path& path, const Building& building, const Vector3d& origin) {
  Drawing drawing;
  WriteHeader(drawing);
  WriteTables(drawing, building.layers);
  drawing.BeginSection("BLOCKS");
  WriteBlock(drawing, "*Model_Space", kModelSpace, {});
  WriteBlock(drawing, "WINDOW", kWindowRecord, building.window);
  drawing.End("ENDSEC");
  WriteEntities(drawing, building, origin);
  WriteObjects(drawing);
  drawing.End("EOF");
  WriteWhole(path, drawing.text());
}

void WriteBuildingMaterials(const std::filesystem::path& path, const Building& building,
                            const Daylight& daylight) {
  Json::Value root;
  root["colour_space"] = "linear Rec.709 reflectance";
  root["model"] =
      "L = F Lmirror + (1 - F) diffuse; F = unpolarised dielectric Fresnel reflectance of the "
      "given index (air outside) times specular_weight; no shading across facets (flat)";
  for (const Material material : building.layers) {
    const double index = MirrorIndex(material);
    Json::Value& layer = root["layers"][MaterialName(material)];
    layer["diffuse_rgb"] = RgbJson(ReflectanceRgb(daylight, PlainReflectance(material)));
    layer["diffuse_weight"] = 1.0;
    layer["specular_weight"] = index > 0 ? 1.0 : 0.0;
    layer["specular"] = index > 0 ? "fresnel" : "none";
    layer["ior"] = index > 0 ? Json::Value(index) : Json::Value();
    layer["roughness"] = index > 0 ? Json::Value(0.0) : Json::Value();
  }
  WriteJson(path, root);
}

}  // namespace insitu::demo
