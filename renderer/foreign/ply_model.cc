// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/ply_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/photograph.h"
#include "renderer/foreign/mesh_builder.h"
#include "renderer/foreign/ply_values.h"
#include "renderer/foreign/single_precision.h"
#include "renderer/foreign/text_lines.h"
#include "renderer/mesh/face_triangles.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

// What a property means to us, whatever it is called.
enum PlyMeaning { kX, kY, kZ, kNx, kNy, kNz, kU, kV, kRed, kGreen, kBlue, kCorners, kCornerUvs };
constexpr int kMeanings = kCornerUvs + 1;

std::optional<PlyMeaning> MeaningOf(const PlyProperty& property) {
  static const std::map<std::string, PlyMeaning> kMeaningOf = {{"x", kX},
                                                               {"y", kY},
                                                               {"z", kZ},
                                                               {"nx", kNx},
                                                               {"ny", kNy},
                                                               {"nz", kNz},
                                                               {"u", kU},
                                                               {"v", kV},
                                                               {"s", kU},
                                                               {"t", kV},
                                                               {"texture_u", kU},
                                                               {"texture_v", kV},
                                                               {"red", kRed},
                                                               {"green", kGreen},
                                                               {"blue", kBlue},
                                                               {"diffuse_red", kRed},
                                                               {"r", kRed},
                                                               {"g", kGreen},
                                                               {"b", kBlue},
                                                               {"diffuse_green", kGreen},
                                                               {"texcoord", kCornerUvs},
                                                               {"diffuse_blue", kBlue},
                                                               {"vertex_index", kCorners},
                                                               {"vertex_indices", kCorners}};
  const auto found = kMeaningOf.find(property.name);
  if (found == kMeaningOf.end()) return std::nullopt;
  if (property.count_type.has_value() != (found->second >= kCorners)) return std::nullopt;
  return found->second;
}

// Codes of whole numbers are sRGB's, floating-point ones too.
double LinearFromCode(double code, PlyType type) {
  double most = 1;
  if (type == PlyType::kUint8) most = std::numeric_limits<uint8_t>::max();
  if (type == PlyType::kUint16) most = std::numeric_limits<uint16_t>::max();
  return LinearFromSrgb(std::clamp(code / most, 0.0, 1.0));
}

class PlyReader {
 public:
  explicit PlyReader(const std::filesystem::path& path)
      : path_(path),
        bytes_(DecodedText(ReadWhole(path))),
        head_(ReadPlyHead(path, bytes_)),
        values_(path_, head_, bytes_),
        builder_(path, &model_) {}

  Model Read() {
    model_.format = "PLY";
    for (const PlyElement& element : head_.elements) ReadElement(element);
    if (values_.HasMore())
      ++model_.skipped[{"rest of the file behind the last element", "not looked at"}];
    SurfaceNames names;
    names.layer = path_.stem().string();
    names.texture = head_.texture;
    if (!names.texture.empty()) names.texture_place = path_.string();
    if (!names.texture.empty()) names.material = head_.texture;
    surface_ = builder_.SurfaceOf(names);
    if (!colors_.empty() && !starts_.empty()) builder_.SayColorsByVertex();
    for (size_t f = 0; f + 1 < starts_.size(); ++f) AddFace(f);
    builder_.Finish();
    SayWhatHeadSays();
    return std::move(model_);
  }

 private:
  // Of unit and precision; text has as many digits as it has.
  void SayWhatHeadSays() {
    const Eigen::AlignedBox3d box = BoxOf(model_.mesh);
    if (box.isEmpty()) return;
    const bool is_text = head_.encoding == PlyEncoding::kText;
    const double largest =
        std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    const std::string note =
        is_text || has_double_places_ ? "" : SinglePrecisionNote(path_, largest);
    if (!note.empty()) model_.warnings.push_back(note);
    if (!head_.unit) return;
    model_.metres_per_unit = head_.unit->metres;
    for (Vector3d& vertex : model_.mesh.vertices) vertex *= head_.unit->metres.value_or(1);
    model_.warnings.push_back(InputError(path_, UnitNote(*head_.unit)).what());
  }

  void ReadElement(const PlyElement& element) {
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    const bool is_strips = element.name == "tristrips";
    if (!is_vertex && !is_face && !is_strips && element.count > 0) {
      model_.skipped[{element.name.substr(0, 40), "no surface"}] +=
          static_cast<int>(std::min<int64_t>(element.count, std::numeric_limits<int>::max()));
    }
    std::vector<std::optional<PlyMeaning>> meanings;
    states_normals_ = false;
    for (const PlyProperty& property : element.properties) {
      meanings.push_back(MeaningOf(property));
      states_normals_ |= meanings.back() == kNx;
      has_double_places_ |= meanings.back() == kX && property.type == PlyType::kDouble;
      if (!meanings.back() && element.count > 0 && (is_vertex || is_face)) {
        ++model_.skipped[{"property " + property.name.substr(0, 40),
                          "of " + element.name + ": not shown"}];
      }
    }
    if (element.properties.empty()) return;
    for (int64_t i = 0; i < element.count; ++i) {
      values_.Begin(element, i);
      ReadRow(element, meanings);
      if (is_vertex) AddVertex();
      if (is_face) AddCorners(0, corners_.size());
      if (is_strips) AddStrips();
    }
  }

  void ReadRow(const PlyElement& element, const std::vector<std::optional<PlyMeaning>>& meanings) {
    row_.fill(std::numeric_limits<double>::quiet_NaN());
    corners_.clear();
    corner_uvs_.clear();
    for (size_t p = 0; p < meanings.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.count_type) {
        ReadList(property, meanings[p]);
        continue;
      }
      const double value = values_.Next(property.type);
      if (!meanings[p]) continue;
      const bool is_color = *meanings[p] >= kRed && *meanings[p] <= kBlue;
      row_[*meanings[p]] = is_color ? LinearFromCode(value, property.type) : value;
    }
  }

  void ReadList(const PlyProperty& property, std::optional<PlyMeaning> meaning) {
    const double count = values_.Next(*property.count_type);
    for (double i = 0; i < count; ++i) {
      const double value = values_.Next(property.type);
      if (meaning == kCorners) corners_.push_back(value);
      if (meaning == kCornerUvs) corner_uvs_.push_back(static_cast<float>(value));
    }
  }

  bool Has(PlyMeaning meaning) const { return !std::isnan(row_[meaning]); }

  void AddVertex() {
    ++model_.entities["vertex"];
    builder_.AddVertex({row_[kX], row_[kY], row_[kZ]}, path_.filename().string());
    if (Has(kNx) && Has(kNy) && Has(kNz)) {
      normals_.resize(model_.mesh.vertices.size() - 1, Eigen::Vector3f::Zero());
      normals_.push_back(Vector3d(row_[kNx], row_[kNy], row_[kNz]).normalized().cast<float>());
    } else if (states_normals_) {
      ++model_.skipped[{"normal", "no direction: its faces have their own"}];
    }
    if (Has(kU) && Has(kV)) {
      uvs_.resize(model_.mesh.vertices.size() - 1, Eigen::Vector2f::Zero());
      uvs_.push_back(Eigen::Vector2d(row_[kU], row_[kV]).cast<float>());
    }
    if (Has(kRed) && Has(kGreen) && Has(kBlue)) {
      colors_.resize(model_.mesh.vertices.size() - 1, Eigen::Vector3f::Ones());
      colors_.push_back(Vector3d(row_[kRed], row_[kGreen], row_[kBlue]).cast<float>());
    }
  }

  // The corners from `first` on; looked up once all vertices are there, which may come later.
  void AddCorners(size_t first, size_t end, bool turned = false) {
    ++model_.entities["face"];
    if (starts_.empty()) starts_.push_back(0);
    for (size_t i = first; i < end; ++i) all_corners_.push_back(corners_[i]);
    if (turned) std::swap(all_corners_[all_corners_.size() - 1], *(all_corners_.end() - 2));
    starts_.push_back(all_corners_.size());
    if (corner_uvs_.size() == 2 * (end - first)) {
      all_uvs_.resize(2 * starts_[starts_.size() - 2], 0);
      all_uvs_.insert(all_uvs_.end(), corner_uvs_.begin(), corner_uvs_.end());
    }
    if (Has(kRed) && Has(kGreen) && Has(kBlue)) {
      face_colors_.resize(starts_.size() - 2, Eigen::Vector3f::Ones());
      face_colors_.push_back(Vector3d(row_[kRed], row_[kGreen], row_[kBlue]).cast<float>());
    }
  }

  // A negative number begins a new strip.
  void AddStrips() {
    size_t start = 0;
    for (size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] < 0) {
        start = i + 1;
      } else if (i >= start + 2) {
        AddCorners(i - 2, i + 1, (i - start) % 2 == 1);
      }
    }
  }

  void AddFace(size_t f) {
    face_.Clear();
    const auto count = static_cast<double>(model_.mesh.vertices.size());
    Eigen::Vector3f color = Eigen::Vector3f::Zero();
    for (size_t i = starts_[f]; i < starts_[f + 1]; ++i) {
      const double index = all_corners_[i];
      if (!(index >= 0 && index < count)) {
        throw InputError(path_, "face " + std::to_string(f + 1) + " names vertex " +
                                    Formatted("%.0f", index) + ", expected 0 to " +
                                    std::to_string(model_.mesh.vertices.size() - 1));
      }
      const auto vertex = static_cast<size_t>(index);
      face_.corners.push_back(static_cast<int>(vertex));
      if (!normals_.empty()) face_.normals.push_back(At(normals_, vertex));
      if (2 * i + 1 < all_uvs_.size()) {
        face_.uvs.emplace_back(all_uvs_[2 * i], all_uvs_[2 * i + 1]);
      } else if (!uvs_.empty()) {
        face_.uvs.push_back(At(uvs_, vertex));
      }
      if (!colors_.empty()) color += At(colors_, vertex);
    }
    color /= static_cast<float>(std::max<size_t>(face_.corners.size(), 1));
    if (f < face_colors_.size()) color = face_colors_[f];
    const bool is_colored = !colors_.empty() || !face_colors_.empty();
    builder_.AddFace(
        face_, is_colored ? builder_.ColoredSurface(surface_, color.cast<double>()) : surface_);
  }

  template <typename T>
  static T At(const std::vector<T>& values, size_t index) {
    return index < values.size() ? values[index] : T(T::Zero());
  }

  std::filesystem::path path_;
  std::string bytes_;
  PlyHead head_;
  PlyValues values_;
  Model model_;
  MeshBuilder builder_;
  BuiltFace face_;
  int surface_ = 0;
  bool states_normals_ = false;  // of the element at hand
  bool has_double_places_ = false;
  std::array<double, kMeanings> row_{};
  std::vector<double> corners_, all_corners_;
  std::vector<float> corner_uvs_, all_uvs_;
  std::vector<size_t> starts_;  // of each face in all_corners_, and the end of the last
  std::vector<Eigen::Vector3f> normals_, colors_, face_colors_;
  std::vector<Eigen::Vector2f> uvs_;
};

}  // namespace

Model ReadPly(const std::filesystem::path& path) { return PlyReader(path).Read(); }

}  // namespace insitu
