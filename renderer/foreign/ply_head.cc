// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/ply_head.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

class PlyHeadReader {
 public:
  PlyHeadReader(const fs::path& path, std::string_view bytes)
      : path_(path), bytes_(bytes), carriage_(bytes.substr(0, 5).find('\n') == bytes.npos) {}

  PlyHead Read() {
    constexpr int kMostLines = 10000;
    for (std::string line; head_.lines < kMostLines && Next(&line);) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "end_header") return std::move(head_);
      ReadLine(word, words);
    }
    throw Error("its head ends here, expected end_header");
  }

 private:
  // The first line decides how lines end: a binary body may begin with either byte.
  bool Next(std::string* line) {
    if (head_.size == bytes_.size()) return false;
    const size_t end = std::min(bytes_.find(carriage_ ? '\r' : '\n', head_.size), bytes_.size());
    *line = bytes_.substr(head_.size, end - head_.size);
    head_.size = std::min(end + 1, bytes_.size());
    ++head_.lines;
    return true;
  }

  void ReadLine(const std::string& word, std::istringstream& words) {
    if (word.empty() || word == "ply" || word == "obj_info") return;
    if (word == "comment") {
      ReadComment(words);
    } else if (word == "format") {
      ReadFormat(words);
    } else if (word == "element") {
      PlyElement element;
      words >> element.name >> element.count;
      element.line = head_.lines;
      if (!words || element.count < 0) throw Error("expected element NAME COUNT");
      head_.elements.push_back(element);
    } else if (word == "property" && !head_.elements.empty()) {
      ReadProperty(words);
    } else {
      throw Error(Quoted(word) + ", expected a statement of PLY's head");
    }
  }

  void ReadComment(std::istringstream& words) {
    std::string comment;
    std::getline(words >> std::ws, comment);
    if (!head_.unit) head_.unit = ReadUnitComment(comment);
    std::istringstream rest(comment);
    std::string what;
    rest >> what;
    if (what != "TextureFile") return;
    std::getline(rest >> std::ws, head_.texture);
    while (!head_.texture.empty() && head_.texture.back() == '\r') head_.texture.pop_back();
  }

  void ReadFormat(std::istringstream& words) {
    std::string name;
    words >> name;
    if (name == "ascii") {
      head_.encoding = PlyEncoding::kText;
    } else if (name == "binary_little_endian") {
      head_.encoding = PlyEncoding::kLittleEndian;
    } else if (name == "binary_big_endian") {
      head_.encoding = PlyEncoding::kBigEndian;
    } else {
      throw Error(Quoted(name) + ", expected ascii, binary_little_endian or binary_big_endian");
    }
  }

  void ReadProperty(std::istringstream& words) {
    PlyProperty property;
    std::string word;
    words >> word;
    if (word == "list") {
      words >> word;
      property.count_type = TypeNamed(word);
      words >> word;
    }
    property.type = TypeNamed(word);
    words >> property.name;
    head_.elements.back().properties.push_back(property);
  }

  PlyType TypeNamed(const std::string& name) const {
    static const std::map<std::string, PlyType> kTypes = {
        {"char", PlyType::kInt8},     {"int8", PlyType::kInt8},     {"uchar", PlyType::kUint8},
        {"uint8", PlyType::kUint8},   {"short", PlyType::kInt16},   {"int16", PlyType::kInt16},
        {"ushort", PlyType::kUint16}, {"uint16", PlyType::kUint16}, {"int", PlyType::kInt32},
        {"int32", PlyType::kInt32},   {"uint", PlyType::kUint32},   {"uint32", PlyType::kUint32},
        {"float", PlyType::kFloat},   {"float32", PlyType::kFloat}, {"double", PlyType::kDouble},
        {"float64", PlyType::kDouble}};
    const auto found = kTypes.find(name);
    if (found == kTypes.end()) throw Error(Quoted(name) + ", expected a type of PLY");
    return found->second;
  }

  InputError Error(const std::string& message) const { return {path_, head_.lines, message}; }

  fs::path path_;
  std::string_view bytes_;
  bool carriage_;  // lines end in CR alone
  PlyHead head_;
};

}  // namespace

PlyHead ReadPlyHead(const fs::path& path, std::string_view bytes) {
  return PlyHeadReader(path, bytes).Read();
}

}  // namespace insitu
