// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/model_format.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <string_view>

#include "calibration/files/error.h"
#include "renderer/foreign/text_lines.h"
#include "renderer/foreign/unread_format.h"
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
  static const std::set<std::string_view> kWords = {
      "v",   "vt",     "vn",     "vp",     "f",        "fo",       "o",          "g",
      "s",   "l",      "p",      "mtllib", "usemtl",   "mg",       "lod",        "bevel",
      "deg", "cstype", "usemap", "maplib", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
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

// Behind statements that nobody knows.
bool HasVertices(std::string_view head) {
  while (!head.empty()) {
    std::string_view line = TakeLine(&head);
    if (!line.starts_with("v ") && !line.starts_with("v\t")) continue;
    line = Trimmed(line.substr(1));
    return line.find_first_not_of("0123456789+-.eEnaif \t#") == line.npos;
  }
  return false;
}

// A large buffer may stand before all else.
bool IsGltf(const fs::path& path, std::string_view head) {
  return head.find("\"asset\"") != head.npos ||
         (head.size() + 3 > kHeadSize && LowerEnding(path) == ".gltf");
}

bool IsStep(std::string_view text) {
  if (text.starts_with("ISO-10303-21")) return true;
  return text.starts_with("/*") && text.find("ISO-10303-21;") != text.npos;
}

// Of a STEP file's head: products of mechanical CAD.
bool IsOfOtherSchema(std::string_view text) {
  const size_t at = text.find("FILE_SCHEMA");
  if (at == text.npos) return false;
  const std::string_view schema = text.substr(at, text.find(';', at) - at);
  return schema.find("IFC") == schema.npos && schema.find("ifc") == schema.npos &&
         schema.find('\'') != schema.npos;
}

bool IsCityJson(std::string_view head) {
  const size_t at = head.find("\"CityJSON\"");
  return head.starts_with('{') && at != head.npos && head.rfind("\"type\"", at) != head.npos;
}

// By what stands in it, where its ending does not tell.
std::string AdviceOnHead(std::string_view head, const std::string& ending) {
  if (IsCityJson(head)) return AdviceOnFormat("", ".cityjson");
  if (IsStep(head)) return AdviceOnFormat("", ".step");
  return AdviceOnFormat(head, ending);
}

}  // namespace

std::optional<ModelFormat> DetectModelFormat(const fs::path& path) {
  const std::string content = DecodedText(HeadOf(path));
  const std::string_view head = content;
  const std::string_view text =
      Trimmed(head.substr(std::min(head.find_first_not_of(" \t\r\n"), head.size())));
  if (head.starts_with("glTF")) return ModelFormat::kGltf;
  if (IsStep(text)) return IsOfOtherSchema(text) ? std::nullopt : std::optional(ModelFormat::kIfc);
  if (text.starts_with("{") && IsObjectsFile(path, head)) return ModelFormat::kObjects;
  if (text.starts_with("{") && IsGltf(path, head)) return ModelFormat::kGltf;
  if (text.starts_with("<") && head.find("<COLLADA") != head.npos) return ModelFormat::kCollada;
  if (head.starts_with("ply\n") || head.starts_with("ply\r")) return ModelFormat::kPly;
  if (IsDxf(head)) return ModelFormat::kDxf;
  if (BinaryStlSize(path) == fs::file_size(path)) return ModelFormat::kStl;
  const std::string keys = NameKey(std::string(text.substr(0, 2000)));
  if (keys.starts_with("SOLID") && keys.find("FACET") != keys.npos) return ModelFormat::kStl;
  if (IsObj(head) || (LowerEnding(path) == ".obj" && HasVertices(head))) return ModelFormat::kObj;
  return std::nullopt;
}

bool IsNamedLikeAModel(const fs::path& path) {
  static const std::set<std::string> kEndings = {".dxf", ".ifc", ".obj", ".gltf",
                                                 ".glb", ".dae", ".ply", ".stl"};
  return kEndings.contains(LowerEnding(path));
}

std::string AdviceOnUnread(const fs::path& path) {
  return AdviceOnHead(HeadOf(path), LowerEnding(path));
}

ModelFormat RequireModelFormat(const fs::path& path) {
  if (const auto format = DetectModelFormat(path)) return *format;
  const std::string head = HeadOf(path);
  if (head.empty()) throw InputError(path, "is empty");
  const std::string advice = AdviceOnHead(head, LowerEnding(path));
  if (advice.empty()) {  // for their readers' messages
    if (LowerEnding(path) == ".dxf") return ModelFormat::kDxf;
    if (LowerEnding(path) == ".stl") return ModelFormat::kStl;
  }
  if (IsObjectsFile(path, "")) return ModelFormat::kObjects;
  throw InputError(path, "is " + (advice.empty() ? "no model that is read" : advice) +
                             "; read are DXF, IFC, OBJ, glTF, COLLADA, PLY, STL and objects.json");
}

}  // namespace insitu
