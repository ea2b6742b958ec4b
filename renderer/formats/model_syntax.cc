// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/model_syntax.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/xml_file.h"
#include "renderer/formats/ifc_syntax.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// A file that was cut is refused: what is missing may be a roof.
void CheckEnding(const fs::path& path, const std::string& ending) {
  constexpr int64_t kTail = 4096;
  std::ifstream file(path, std::ios::binary);
  const auto size = static_cast<int64_t>(fs::file_size(path));
  std::string tail(static_cast<size_t>(std::min(size, kTail)), '\0');
  file.seekg(size - std::ssize(tail));
  file.read(tail.data(), std::ssize(tail));
  if (tail.find(ending) != std::string::npos) return;
  int lines = 0;
  file.clear();
  file.seekg(0);
  for (std::string line; std::getline(file, line);) ++lines;
  throw InputError(path, lines, "the file ends here, expected " + ending + ": it is cut short");
}

std::string LengthFault(uint64_t size, uint64_t expected) {
  return "is " + std::to_string(size) + " bytes long, expected " + std::to_string(expected) +
         " as its head states: it is cut short";
}

void CheckStl(const fs::path& path) {
  const std::optional<uint64_t> expected = BinaryStlSize(path);
  const uint64_t size = fs::file_size(path);
  if (size == expected) return;
  char head[5] = {};
  std::ifstream(path, std::ios::binary).read(head, sizeof(head));
  if (std::string_view(head, sizeof(head)) == "solid" || !expected) {
    CheckEnding(path, "endsolid");
  } else {
    throw InputError(path, LengthFault(size, *expected));
  }
}

bool IsGlb(const fs::path& path) {
  char magic[4] = {};
  std::ifstream(path, std::ios::binary).read(magic, sizeof(magic));
  return std::string_view(magic, sizeof(magic)) == "glTF";
}

void CheckGlb(const fs::path& path) {
  uint32_t head[3] = {};  // "glTF", version, length
  std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(head), sizeof(head));
  if (head[1] != 2) {
    throw InputError(path, "is binary glTF of version " + std::to_string(head[1]) + ", expected 2");
  }
  const auto size = fs::file_size(path);
  if (size >= head[2]) return;
  throw InputError(path, LengthFault(size, head[2]));
}

struct PlyHead {
  bool ascii = false;
  int64_t elements = 0, faces = 0;
};

// Leaves `file` after the head. Assimp searches for ever for the end of a head that has none.
PlyHead ReadPlyHead(const fs::path& path, std::ifstream* file) {
  constexpr int kMostLines = 10000;
  PlyHead head;
  std::string line, word, name;
  int lines = 0;
  while (lines < kMostLines && std::getline(*file, line)) {
    ++lines;
    std::istringstream words(line);
    words >> word >> name;
    if (word == "end_header") return head;
    if (word == "format") head.ascii = name == "ascii";
    int64_t count = 0;
    if (word != "element" || !(words >> count)) continue;
    head.elements += count;
    if (name == "face") head.faces = count;
  }
  throw InputError(path, lines, "its head ends here, expected end_header");
}

// In text an element is a line. Assimp makes up what is missing.
void CheckPly(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const PlyHead head = ReadPlyHead(path, &file);
  if (!head.ascii) return;
  int64_t lines = 0;
  for (std::string line; std::getline(file, line);) {
    lines += line.find_first_not_of(" \t\r") != std::string::npos;
  }
  if (lines >= head.elements) return;
  throw InputError(path,
                   "holds " + std::to_string(lines) + " vertices, faces and so on, expected " +
                       std::to_string(head.elements) + " as its head states: it is cut short");
}

}  // namespace

std::optional<uint64_t> BinaryStlSize(const fs::path& path) {
  constexpr size_t kHead = 80, kFacet = 50;
  uint32_t facets = 0;
  std::ifstream file(path, std::ios::binary);
  file.seekg(kHead);
  if (!file.read(reinterpret_cast<char*>(&facets), sizeof(facets))) return std::nullopt;
  return kHead + sizeof(facets) + kFacet * uint64_t{facets};
}

void CheckModelSyntax(const fs::path& path, ModelFormat format) {
  if (format == ModelFormat::kIfc) {
    CheckIfcSchema(path);
    CheckEnding(path, "END-ISO-10303-21");
    CheckIfcStatements(path);
  }
  if (format == ModelFormat::kStl) CheckStl(path);
  if (format == ModelFormat::kPly) CheckPly(path);
  if (format == ModelFormat::kGltf && IsGlb(path)) CheckGlb(path);
}

void CheckModelWhole(const fs::path& path, ModelFormat format, const Model& model) {
  if (format != ModelFormat::kPly) return;
  const auto found = model.entities.find("face");
  const int64_t faces = found == model.entities.end() ? 0 : found->second;
  std::ifstream file(path, std::ios::binary);
  const int64_t stated = ReadPlyHead(path, &file).faces;
  if (faces >= stated) return;
  throw InputError(path, "holds " + std::to_string(faces) + " faces, expected " +
                             std::to_string(stated) + " as its head states: it is cut short");
}

void ExplainFailure(const fs::path& path, ModelFormat format) {
  if (format == ModelFormat::kGltf && !IsGlb(path)) ReadJson(path);
  if (format == ModelFormat::kCollada) XmlNode::Load(path);
}

}  // namespace insitu
