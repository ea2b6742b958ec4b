// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/model_format.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <string_view>

#include "calibration/files/error.h"
#include "renderer/formats/objects_model.h"
#include "renderer/formats/stl_model.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr size_t kHeadSize = 1 << 16;

std::string HeadOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || !fs::is_regular_file(path)) throw InputError(path, "cannot be read");
  std::string head(kHeadSize, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(file.gcount()));
  if (head.starts_with("\xEF\xBB\xBF")) head.erase(0, 3);
  return head;
}

std::string_view Trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string_view TakeLine(std::string_view* text) {
  const size_t end = std::min(text->find('\n'), text->size());
  const std::string_view line = Trimmed(text->substr(0, end));
  text->remove_prefix(std::min(end + 1, text->size()));
  return line;
}

bool IsDxf(std::string_view head) {
  if (head.starts_with("AutoCAD Binary DXF")) return true;
  std::string_view code = TakeLine(&head);
  while (code == "999" && !head.empty()) {
    TakeLine(&head);
    code = TakeLine(&head);
  }
  return code == "0" && (TakeLine(&head) == "SECTION" || head.empty());
}

bool IsObj(std::string_view head) {
  static const std::set<std::string_view> kWords = {"v", "vt", "vn", "f",      "o",     "g",
                                                    "s", "l",  "p",  "mtllib", "usemtl"};
  while (!head.empty()) {
    const std::string_view line = TakeLine(&head);
    if (line.empty() || line.front() == '#') continue;
    return kWords.contains(line.substr(0, line.find_first_of(" \t")));
  }
  return false;
}

std::string LowerEnding(const fs::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

// What a file of a format that is not read is, and what to do about it.
std::string NameOfUnread(std::string_view head, const std::string& ending) {
  struct Unread {
    std::string_view ending, magic, advice;
  };
  static constexpr Unread kUnread[] = {
      {".dwg", "AC10", "a DWG drawing: save it as DXF (AutoCAD: Save As; or the ODA converter)"},
      {".skp", "\xFF\xFE\xFF\x0E", "a SketchUp model: File > Export > 3D Model > DAE or glTF"},
      {".3dm", "3D Geometry File Format",
       "a Rhino model: File > Export Selected > OBJ, DXF or glTF"},
      {".rvt", "\xD0\xCF\x11\xE0", "a Revit or other OLE file: in Revit File > Export > IFC"},
      {".fbx", "Kaydara FBX", "an FBX model: export glTF or OBJ (Blender: File > Export)"},
      {".3ds", "MM", "a 3DS model: open it in Blender, File > Export > glTF or OBJ"},
      {".kmz", "", "a KMZ archive: unpack it as zip, and take the .dae within"},
      {".zae", "", "a zipped COLLADA: unpack it as zip, and take the .dae and images within"},
      {".ifczip", "", "a zipped IFC: unpack it, and take the .ifc within"},
      {".usdz", "", "a USD model: open it in Blender, File > Export > glTF"},
      {".usda", "#usda", "a USD model: open it in Blender, File > Export > glTF"},
      {".usdc", "PXR-USDC", "a USD model: open it in Blender, File > Export > glTF"},
      {".usd", "", "a USD model: open it in Blender, File > Export > glTF"},
      {".wrl", "#VRML", "a VRML model: open it in Blender or MeshLab, export OBJ or glTF"},
      {".x3d", "", "an X3D model: open it in Blender or MeshLab, export OBJ or glTF"},
      {".pln", "", "an ArchiCAD project: File > Save As > IFC"},
      {".pla", "", "an ArchiCAD archive: File > Save As > IFC"},
      {".rfa", "", "a Revit family: load it into a project, File > Export > IFC"},
      {".las", "LASF", "a point cloud without surfaces: ask for the model itself"},
      {".laz", "", "a point cloud without surfaces: ask for the model itself"},
      {".blend", "BLENDER", "a Blender file: File > Export > glTF or OBJ"},
      {".max", "", "a 3ds Max scene: File > Export > OBJ or glTF"},
      {".c4d", "", "a Cinema 4D scene: File > Export > OBJ or glTF"},
      {".vwx", "", "a Vectorworks file: File > Export > IFC or DXF"},
      {".ifcxml", "", "IFC as XML: export it as .ifc (STEP)"},
      {".gml", "", "a CityGML model: convert it to OBJ or glTF"},
      {".step", "", "a STEP model: open it in FreeCAD, File > Export > OBJ or glTF"},
      {".stp", "", "a STEP model: open it in FreeCAD, File > Export > OBJ or glTF"},
      {".dwf", "", "a DWF plot without surfaces: ask for DXF or IFC"},
      {".pdf", "%PDF", "a PDF document: ask the architect for IFC, DXF or glTF"},
      {".zip", "PK\x03\x04", "a zip archive: unpack it into building/"},
      {".7z", "7z\xBC\xAF", "an archive: unpack it into building/"},
      {".rar", "Rar!", "an archive: unpack it into building/"}};
  for (const Unread& unread : kUnread) {
    if (ending == unread.ending) return std::string(unread.advice);
  }
  for (const Unread& unread : kUnread) {
    if (!unread.magic.empty() && head.starts_with(unread.magic)) return std::string(unread.advice);
  }
  if (head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF")) {
    return "text in UTF-16: save it as UTF-8";
  }
  return "";
}

}  // namespace

std::optional<ModelFormat> DetectModelFormat(const fs::path& path) {
  const std::string content = HeadOf(path);
  const std::string_view head = content;
  const std::string_view text =
      Trimmed(head.substr(std::min(head.find_first_not_of(" \t\r\n"), head.size())));
  if (head.starts_with("glTF")) return ModelFormat::kGltf;
  if (text.starts_with("ISO-10303-21")) return ModelFormat::kIfc;
  if (text.starts_with("{") && IsObjectsFile(path, head)) return ModelFormat::kObjects;
  if (text.starts_with("{") && head.find("\"asset\"") != head.npos) return ModelFormat::kGltf;
  if (text.starts_with("<") && head.find("<COLLADA") != head.npos) return ModelFormat::kCollada;
  if (head.starts_with("ply\n") || head.starts_with("ply\r")) return ModelFormat::kPly;
  if (IsDxf(head)) return ModelFormat::kDxf;
  if (BinaryStlSize(path) == fs::file_size(path)) return ModelFormat::kStl;
  const std::string keys = NameKey(std::string(text.substr(0, 2000)));
  if (keys.starts_with("SOLID") && keys.find("FACET") != keys.npos) return ModelFormat::kStl;
  if (IsObj(head)) return ModelFormat::kObj;
  return std::nullopt;
}

bool IsNamedLikeAModel(const fs::path& path) {
  static const std::set<std::string> kEndings = {".dxf", ".ifc", ".obj", ".gltf",
                                                 ".glb", ".dae", ".ply", ".stl"};
  return kEndings.contains(LowerEnding(path));
}

std::string AdviceOnUnread(const fs::path& path) {
  return NameOfUnread(HeadOf(path), LowerEnding(path));
}

ModelFormat RequireModelFormat(const fs::path& path) {
  if (const auto format = DetectModelFormat(path)) return *format;
  // For their readers' messages.
  if (LowerEnding(path) == ".dxf") return ModelFormat::kDxf;
  if (LowerEnding(path) == ".stl") return ModelFormat::kStl;
  if (IsObjectsFile(path, "")) return ModelFormat::kObjects;
  std::string advice = NameOfUnread(HeadOf(path), "");
  if (advice.empty()) advice = NameOfUnread("", LowerEnding(path));
  if (advice.empty()) advice = "no model that is read";
  throw InputError(
      path, "is " + advice + "; read are DXF, IFC, OBJ, glTF, COLLADA, PLY, STL and objects.json");
}

}  // namespace insitu
