// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/ply_syntax.h"

#include <fstream>
#include <sstream>
#include <string>

#include "calibration/files/error.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

struct PlyHead {
  bool ascii = false;
  int64_t elements = 0, faces = 0;
};

// Leaves `file` after the head.
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

}  // namespace

void CheckPly(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const PlyHead head = ReadPlyHead(path, &file);
  if (!head.ascii) return;  // in text an element is a line
  int64_t lines = 0;
  for (std::string line; std::getline(file, line);) {
    lines += line.find_first_not_of(" \t\r") != std::string::npos;
  }
  if (lines >= head.elements) return;
  throw InputError(path,
                   "holds " + std::to_string(lines) + " vertices, faces and so on, expected " +
                       std::to_string(head.elements) + " as its head states: it is cut short");
}

void RequirePlyFaces(const fs::path& path, int64_t faces) {
  std::ifstream file(path, std::ios::binary);
  const int64_t stated = ReadPlyHead(path, &file).faces;
  if (faces >= stated) return;
  throw InputError(path, "holds " + std::to_string(faces) + " faces, expected " +
                             std::to_string(stated) + " as its head states: it is cut short");
}

}  // namespace insitu
