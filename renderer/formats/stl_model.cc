// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/stl_model.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/plain_text.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "renderer/dxf/dxf_name.h"
#include "renderer/foreign/cut_short.h"
#include "renderer/foreign/single_precision.h"
#include "renderer/foreign/text_lines.h"
#include "renderer/foreign/unit_comment.h"
#include "renderer/mesh/face_triangles.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr size_t kStlHead = 80, kStlFacet = 50;
constexpr double kLargestOfStl = 1e12;

void AddStlFacet(const Vector3d corners[3], int surface, Model* model) {
  ++model->entities["facet"];
  for (int i = 0; i < 3; ++i) {
    if (corners[i].allFinite()) continue;
    ++model->skipped[{"facet", "at a corner that is no point"}];
    return;
  }
  if (IsDegenerate(corners[0], corners[1], corners[2])) {
    ++model->degenerate_faces;
    return;
  }
  const int first = static_cast<int>(model->mesh.vertices.size());
  for (int i = 0; i < 3; ++i) model->mesh.vertices.push_back(corners[i]);
  model->mesh.triangles.emplace_back(first, first + 1, first + 2);
  model->mesh.surface_of_triangle.push_back(surface);
}

// STL has no unit, but some programs put one where a name stands.
void TakeStlUnit(const fs::path& path, std::string_view text, Model* model) {
  const auto comment = ReadUnitComment(text);
  if (!comment || !comment->metres || model->metres_per_unit) return;
  model->metres_per_unit = comment->metres;
  model->warnings.emplace_back(InputError(path, UnitNote(*comment)).what());
}

// Facets until the file ends; a head that counts none, or all there can be, was never filled in.
void ReadBinaryStl(const fs::path& path, Model* model) {
  const std::string bytes = ReadWhole(path);
  uint32_t stated = 0;
  std::memcpy(&stated, bytes.data() + kStlHead, sizeof(stated));
  const size_t start = kStlHead + sizeof(stated);
  const size_t held = (bytes.size() - start) / kStlFacet;
  const bool is_stated = stated > 0 && stated != std::numeric_limits<uint32_t>::max();
  if (is_stated) RequireLength(path, start + kStlFacet * uint64_t{stated});
  const size_t facets = is_stated ? stated : held;
  if (bytes.size() > start + facets * kStlFacet) {
    ++model->skipped[{"rest of the file behind the last facet", "not looked at"}];
  }
  TakeStlUnit(path, std::string_view(bytes.data(), std::min(kStlHead, bytes.find('\0'))), model);
  bool colored = bytes.find("COLOR=") < kStlHead;
  double largest = 0;
  for (size_t f = 0; f < facets; ++f) {
    const char* facet = bytes.data() + start + f * kStlFacet;
    float numbers[12];  // normal, three corners
    std::memcpy(numbers, facet, sizeof(numbers));
    uint16_t attribute = 0;
    std::memcpy(&attribute, facet + sizeof(numbers), sizeof(attribute));
    colored |= attribute != 0;
    Vector3d corners[3];
    for (int i = 0; i < 9; ++i) corners[i / 3][i % 3] = numbers[3 + i];
    for (const Vector3d& corner : corners) {
      if (!corner.allFinite() || (corner.array().abs() <= kLargestOfStl).all()) continue;
      throw InputError(path, "facet " + std::to_string(f + 1) + " has a corner beyond 1e12");
    }
    AddStlFacet(corners, 0, model);
    for (const Vector3d& corner : corners) {
      if (corner.allFinite()) largest = std::max(largest, corner.cwiseAbs().maxCoeff());
    }
  }
  const std::string note = SinglePrecisionNote(path, largest);
  if (!note.empty()) model->warnings.push_back(note);
  if (colored) ++model->skipped[{"colours of facets", "STL defines none: not shown"}];
}

class StlTextReader {
 public:
  StlTextReader(const fs::path& path, Model* model) : path_(path), lines_(path), model_(model) {}

  void Read() {
    std::string line;
    while (lines_.Next(&line)) {
      ++number_;
      std::istringstream words(line);
      std::string word;
      while (words >> word) ReadStatement(NameKey(word), &words);
    }
    NameSolids();
    if (in_facet_) throw InputError(path_, number_, "the file ends in a facet: it is cut short");
    if (!ended_) {
      model_->warnings.push_back(
          InputError(path_, number_, "the file ends without endsolid: is it whole?").what());
    }
  }

 private:
  // Statements may share a line.
  void ReadStatement(std::string word, std::istringstream* words) {
    if (word == "END") word += NextKey(words);  // "end facet"
    if (word == "FACET") {
      in_facet_ = true;
      corners_ = 0;
      if (NextKey(words) == "NORMAL") {
        for (int i = 0; i < 3; ++i) NextKey(words);
      }
    } else if (word == "OUTER") {
      NextKey(words);
    } else if (word == "VERTEX") {
      ReadCorner(words);
    } else if (word == "ENDFACET") {
      if (corners_ == 3) {
        AddStlFacet(facet_, solid_, model_);
      } else {
        ++model_->skipped[{"facet", "of other than 3 corners"}];
      }
      in_facet_ = false;
    } else if (word == "ENDSOLID" || word == "END") {
      ended_ = true;
      TakeName(words);
    } else if (word == "SOLID") {
      ended_ = false;
      BeginSolid(words);
    } else if (word != "ENDLOOP") {
      throw Error(Quoted(word) + ", expected a statement of STL");
    }
  }
  static std::string NextKey(std::istringstream* words) {
    std::string word;
    *words >> word;
    return NameKey(word);
  }
  // Up to the line's end, or the facet or solid that shares it.
  static std::string TakeName(std::istringstream* words) {
    std::string name, rest;
    for (std::string word; *words >> word;) {
      const std::string key = NameKey(word);
      if (key == "FACET" || key == "SOLID") {
        std::getline(*words, rest);
        words->clear();
        words->str(word + rest);
        break;
      }
      name += (name.empty() ? "" : " ") + word;
    }
    return name;
  }
  void BeginSolid(std::istringstream* words) {
    const std::string name = TakeName(words);
    TakeStlUnit(path_, name, model_);
    const auto found = std::ranges::find(solids_, name);
    solid_ = static_cast<int>(found - solids_.begin());
    if (found == solids_.end()) solids_.push_back(name);
  }
  // Several solids are layers of their own names; one has the file's.
  void NameSolids() {
    for (size_t i = 1; i < solids_.size(); ++i) {
      model_->mesh.surfaces.push_back(model_->mesh.surfaces.front());
    }
    for (size_t i = 0; i < solids_.size() && solids_.size() > 1; ++i) {
      if (!solids_[i].empty()) model_->mesh.surfaces[i].layer = Composed(Utf8FromDxf(solids_[i]));
    }
  }
  void ReadCorner(std::istringstream* words) {
    for (double& coordinate : facet_[std::min(corners_, 2)]) {
      std::string text;
      *words >> text;
      const char* first = text.data() + text.starts_with('+');
      const char* last = text.data() + text.size();
      const auto [end, status] = std::from_chars(first, last, coordinate);
      if (IsNoNumber(text)) {
        coordinate = std::numeric_limits<double>::quiet_NaN();
        continue;
      }
      if (status != std::errc() || end != last || !(std::abs(coordinate) <= kLargestOfStl)) {
        throw Error(Quoted(text) + ", expected a coordinate of at most 1e12");
      }
    }
    ++corners_;
  }
  InputError Error(const std::string& message) const { return {path_, number_, message}; }

  fs::path path_;
  TextLines lines_;
  Model* model_;
  int number_ = 0, corners_ = 0;
  bool in_facet_ = false, ended_ = false;
  Vector3d facet_[3];
  std::vector<std::string> solids_;
  int solid_ = 0;
};

// Binary files may begin with "solid" too, but hold zeros and no "facet" near their head.
bool IsStlText(const fs::path& path) {
  TextLines lines(path);
  std::string line;
  for (int i = 0; i < 10 && lines.Next(&line); ++i) {
    if (line.find('\0') != line.npos) return false;
    if (NameKey(line).find("FACET") != line.npos) return true;
  }
  return BinaryStlSize(path) == std::nullopt || NameKey(line).find("SOLID") != line.npos;
}

}  // namespace

std::optional<uint64_t> BinaryStlSize(const fs::path& path) {
  uint32_t facets = 0;
  std::ifstream file(path, std::ios::binary);
  file.seekg(kStlHead);
  if (!file.read(reinterpret_cast<char*>(&facets), sizeof(facets))) return std::nullopt;
  return kStlHead + sizeof(facets) + kStlFacet * uint64_t{facets};
}

Model ReadStl(const fs::path& path) {
  Model model;
  model.format = "STL";
  SurfaceNames names;
  names.layer = path.stem().string();
  model.mesh.surfaces = {names};
  if (BinaryStlSize(path) != fs::file_size(path) && IsStlText(path)) {
    StlTextReader(path, &model).Read();
  } else {
    ReadBinaryStl(path, &model);
  }
  for (Vector3d& vertex : model.mesh.vertices) vertex *= model.metres_per_unit.value_or(1);
  DropUnused(&model.mesh);
  return model;
}

}  // namespace insitu
