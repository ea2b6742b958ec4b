// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/obj_material.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "renderer/formats/obj_words.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

// The image comes last, after options; its name may hold blanks. Options that move it on its faces
// are counted.
std::string TextureName(ObjWords words, SkippedEntities* skipped) {
  for (auto option = ObjWords(words).Next(); option && option->starts_with('-');) {
    words.Next();
    const bool up_to_three = *option == "-o" || *option == "-s" || *option == "-t";
    const int most = up_to_three ? 3 : *option == "-mm" ? 2 : 1;
    const double usual = *option == "-s" ? 1 : 0;
    double number = 0;
    bool moves = false;
    for (int i = 0; i < most; ++i) {
      const auto value = ObjWords(words).Next();
      if (!value || (up_to_three && !ObjWords::ParseAll(*value, &number))) break;
      words.Next();
      moves = moves || (up_to_three && number != usual);
    }
    if (moves) ++(*skipped)[{std::string(*option), "moves an image on its faces: not read"}];
    option = ObjWords(words).Next();
  }
  return words.Name();
}

// "Kd r" means r r r; nullopt: "spectral" or "xyz", or no number.
std::optional<Vector3d> ColorOf(ObjWords words, SkippedEntities* skipped) {
  const std::optional<double> r = words.FindNumber();
  if (!r) return std::nullopt;
  const std::optional<double> g = words.FindNumber(), b = words.FindNumber();
  const Vector3d color(*r, g.value_or(*r), b.value_or(g.value_or(*r)));
  if (color.maxCoeff() > 1) ++(*skipped)[{"Kd", "over 1: taken as 1"}];
  return color.cwiseMax(0).cwiseMin(1);
}

class MaterialsReader {
 public:
  MaterialsReader(const fs::path& path, SkippedEntities* skipped)
      : path_(path), skipped_(skipped) {}

  std::map<std::string, ObjMaterial> Read() {
    ForEachObjLine(
        path_,
        [this](std::string_view keyword, ObjWords& words, int line) {
          if (keyword == "newmtl") {
            const auto [found, is_new] = materials_.try_emplace(words.Name());
            if (!is_new) Skip("newmtl", "of a name that is there already: the last one counts");
            current_ = &found->second;
            *current_ = {};
            has_dissolve_ = false;
          } else if (current_) {
            ReadLine(keyword, words, line);
          }
        },
        [](const std::string&) {});
    return std::move(materials_);
  }

 private:
  void ReadLine(std::string_view keyword, ObjWords& words, int line) {
    if (keyword == "Kd") {
      current_->rgb = ColorOf(words, skipped_);
      if (!current_->rgb) Skip("Kd", "a colour that is no number: shown in mid grey");
    } else if (keyword == "d" || keyword == "Tr") {
      ReadOpacity(keyword == "d", words);
    } else if (keyword == "map_Kd") {
      current_->texture = TextureName(words, skipped_);
      current_->texture_place = path_.string() + ":" + std::to_string(line);
    } else if (const auto map = MapOf(keyword, words)) {
      current_->maps.push_back(*map);
      if (current_->texture_place.empty()) {
        current_->texture_place = path_.string() + ":" + std::to_string(line);
      }
    } else {
      CountNotShown(keyword, words);
    }
  }
  // Of programs that write physically based materials into MTL; roughness is its root, as in glTF.
  std::optional<SurfaceMap> MapOf(std::string_view keyword, const ObjWords& words) const {
    using Kind = SurfaceMap::Kind;
    static const std::map<std::string_view, Kind> kKinds = {
        {"norm", Kind::kNormal}, {"map_Pr", Kind::kRoughness}, {"map_Pm", Kind::kMetallic}};
    const auto kind = kKinds.find(keyword);
    if (kind == kKinds.end()) return std::nullopt;
    return SurfaceMap{.kind = kind->second,
                      .file = TextureName(words, skipped_),
                      .is_squared = kind->second == Kind::kRoughness};
  }
  // What says something that is not shown; Ns and the like only qualify others.
  void CountNotShown(std::string_view keyword, ObjWords words) {
    static const std::set<std::string_view> kQualify = {
        "Ka", "Ns", "Ni", "illum", "sharpness", "map_Ka", "Pr", "aniso", "anisor"};
    if (kQualify.contains(keyword)) return;
    if (keyword.size() == 2 && (keyword[0] == 'K' || keyword[0] == 'P' || keyword == "Tf")) {
      const double first = words.FindNumber().value_or(1), usual = keyword == "Tf" ? 1 : 0;
      const double second = words.FindNumber().value_or(first);
      const double third = words.FindNumber().value_or(second);
      if (first == usual && second == usual && third == usual) return;
    }
    const bool is_known = keyword.starts_with("map_") || keyword.starts_with("K") ||
                          keyword.starts_with("P") || keyword.starts_with("Tf");
    ++(*skipped_)[{std::string(keyword.substr(0, 20)),
                   is_known || keyword == "bump" || keyword == "norm" || keyword == "disp"
                       ? IsHeights(keyword) ? "of materials: heights of no stated size, see "
                                              "height_map of materials.json"
                                            : "of materials: not shown, see materials.json"
                       : "of materials: not read"}];
  }
  static bool IsHeights(std::string_view keyword) {
    return keyword == "bump" || keyword == "map_Bump" || keyword == "map_bump";
  }
  void ReadOpacity(bool is_dissolve, ObjWords words) {
    const auto first = ObjWords(words).Next();
    if (first && *first == "-halo") words.Next();
    const std::optional<double> value = words.FindNumber();
    if (!value) return Skip(is_dissolve ? "d" : "Tr", "no number: taken as opaque");
    if (!is_dissolve && has_dissolve_) return;
    has_dissolve_ |= is_dissolve;
    current_->opacity = std::clamp(is_dissolve ? *value : 1 - *value, 0.0, 1.0);
  }
  void Skip(const char* kind, const char* reason) { ++(*skipped_)[{kind, reason}]; }

  fs::path path_;
  SkippedEntities* skipped_;
  std::map<std::string, ObjMaterial> materials_;
  ObjMaterial* current_ = nullptr;
  bool has_dissolve_ = false;
};

}  // namespace

std::map<std::string, ObjMaterial> ReadObjMaterials(const fs::path& path,
                                                    SkippedEntities* skipped) {
  return MaterialsReader(path, skipped).Read();
}

}  // namespace insitu
