// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/model_format.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <string_view>

#include "calibration/files/error.h"
#include "renderer/formats/stl_syntax.h"

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

std::string NameOfUnread(std::string_view head) {
  if (head.starts_with("AC10")) return "a DWG drawing";
  if (head.starts_with("\xFF\xFE\xFF\x0ESketchUp") ||
      head.starts_with(std::string_view("\xFF\xFE\xFF\x0E"
                                        "S\0k\0",
                                        8))) {
    return "a SketchUp model";
  }
  if (head.starts_with("3D Geometry File Format")) return "a Rhino model";
  if (head.starts_with("Kaydara FBX")) return "an FBX model";
  if (head.starts_with("MM") || head.starts_with("M-")) return "a 3DS model";
  if (head.starts_with("\xD0\xCF\x11\xE0")) return "a Revit or other OLE file";
  if (head.starts_with("PK")) return "a zip archive";
  return "no model that is read";
}

}  // namespace

std::optional<ModelFormat> DetectModelFormat(const fs::path& path) {
  const std::string content = HeadOf(path);
  const std::string_view head = content;
  const std::string_view text =
      Trimmed(head.substr(std::min(head.find_first_not_of(" \t\r\n"), head.size())));
  if (head.starts_with("glTF")) return ModelFormat::kGltf;
  if (text.starts_with("ISO-10303-21")) return ModelFormat::kIfc;
  if (text.starts_with("{") && head.find("\"asset\"") != head.npos) return ModelFormat::kGltf;
  if (text.starts_with("<") && head.find("<COLLADA") != head.npos) return ModelFormat::kCollada;
  if (head.starts_with("ply\n") || head.starts_with("ply\r")) return ModelFormat::kPly;
  if (IsDxf(head)) return ModelFormat::kDxf;
  if (BinaryStlSize(path) == fs::file_size(path)) return ModelFormat::kStl;
  if (text.starts_with("solid") && head.find("facet") != head.npos) return ModelFormat::kStl;
  if (IsObj(head)) return ModelFormat::kObj;
  return std::nullopt;
}

bool IsNamedLikeAModel(const fs::path& path) {
  static const std::set<std::string> kEndings = {
      ".dxf", ".ifc", ".obj", ".gltf", ".glb", ".dae",    ".ply",    ".stl", ".dwg",  ".skp",
      ".3dm", ".3ds", ".rvt", ".rfa",  ".fbx", ".ifczip", ".ifcxml", ".dxb", ".blend"};
  return kEndings.contains(LowerEnding(path));
}

ModelFormat RequireModelFormat(const fs::path& path) {
  if (const auto format = DetectModelFormat(path)) return *format;
  // For their readers' messages.
  if (LowerEnding(path) == ".dxf") return ModelFormat::kDxf;
  if (LowerEnding(path) == ".stl") return ModelFormat::kStl;
  throw InputError(path, "is " + NameOfUnread(HeadOf(path)) +
                             ", expected DXF, IFC, OBJ, glTF, COLLADA, PLY or STL");
}

}  // namespace insitu
