// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf/dxf_body.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "reconstruction/geometry/sphere_facets.h"
#include "renderer/acis/acis_body.h"
#include "renderer/acis/acis_file.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

std::optional<int> HexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return std::nullopt;
}

void AppendBytes(const DxfRecord& record, const DxfTag& tag, std::string* bytes) {
  for (size_t i = 0; i + 1 < tag.value.size(); i += 2) {
    const auto high = HexDigit(tag.value[i]), low = HexDigit(tag.value[i + 1]);
    if (!high || !low) throw record.ErrorAt(tag, "no hexadecimal digits, expected bytes");
    bytes->push_back(static_cast<char>(*high << 4 | *low));
  }
}

// Lines begin with group 1 and go on, after 255 characters, in groups 3; "^ " stands for "^".
std::string TextOf(const DxfRecord& entity) {
  std::string text;
  bool has_blank = false, ends_with_caret = false;
  for (const DxfTag& tag : entity.tags()) {
    if (tag.code != 1 && tag.code != 3) continue;
    if (tag.code == 1) {
      text += '\n';
    } else if ((has_blank || tag.has_blank_before) && !ends_with_caret) {
      text += ' ';
    }
    for (size_t i = 0; i < tag.value.size(); ++i) {
      text += tag.value[i];
      if (tag.value[i] == '^' && i + 1 < tag.value.size() && tag.value[i + 1] == ' ') ++i;
    }
    has_blank = tag.has_blank_behind;
    ends_with_caret = tag.value.ends_with('^');
  }
  if (!text.empty()) text.erase(0, 1);
  return text;
}

// Some programs write it as it is.
bool IsPlain(const std::string& text) {
  const size_t first = text.find_first_not_of(" \n");
  return first != text.npos && text[first] >= '0' && text[first] <= '9';
}

std::optional<AcisFile> FileOf(const DxfBody& body, const std::string& sab) {
  if (body.text.empty()) return ReadSab(sab);
  return ReadSat(IsPlain(body.text) ? body.text : DecodedAcisText(body.text));
}

bool IsSimilarity(const Eigen::Affine3d& transform, double scale) {
  const Eigen::Matrix3d square = transform.linear().transpose() * transform.linear();
  return (square - scale * scale * Eigen::Matrix3d::Identity()).norm() < 1e-9 * scale * scale;
}

// Stretched by its block it is none any more.
void AddFacets(const AcisSphere& sphere, double tolerance, AcisShape* shape) {
  int level = 3;  // sides of about 90 / 2^level degrees
  while (level < 6 && sphere.radius * 0.31 / (1 << 2 * level) > tolerance) ++level;
  const SphereFacets unit = UnitSphereFacets(level);
  const int first = static_cast<int>(shape->vertices.size());
  for (const Vector3d& v : unit.vertices) {
    shape->vertices.push_back(sphere.center + sphere.radius * v);
  }
  for (const Eigen::Vector3i& facet : unit.triangles) {
    shape->triangles.push_back(facet + Eigen::Vector3i::Constant(first));
  }
}

}  // namespace

bool IsDxfBody(std::string_view kind) {
  static const std::set<std::string_view> kKinds = {
      "3DSOLID",       "BODY",         "REGION",          "SURFACE",      "EXTRUDEDSURFACE",
      "LOFTEDSURFACE", "PLANESURFACE", "REVOLVEDSURFACE", "SWEPTSURFACE", "NURBSURFACE"};
  return kKinds.contains(kind);
}

DxfBody DxfBodyOf(const DxfRecord& entity) {
  DxfBody body;
  body.kind = entity.kind();
  if (const DxfTag* handle = entity.Find(5)) body.handle = handle->value;
  body.text = TextOf(entity);
  return body;
}

std::string DxfHandle(std::string_view handle) {
  handle.remove_prefix(std::min(handle.find_first_not_of('0'), handle.size()));
  return NameKey(std::string(handle));
}

void ReadDxfBodyData(const DxfRecord& record, std::map<std::string, std::string>* body_of_handle) {
  const DxfTag* handle = record.Find(320);
  if (record.kind() != "ACDSRECORD" || !handle) return;
  std::string bytes;
  for (const DxfTag& tag : record.tags()) {
    if (tag.code == 310) AppendBytes(record, tag, &bytes);
  }
  const bool is_body = bytes.starts_with("ACIS BinaryFile") || bytes.starts_with("ASM BinaryFile");
  if (is_body) (*body_of_handle)[DxfHandle(handle->value)] = std::move(bytes);
}

FacetedBody Facet(const DxfBody& body, const std::string& sab,
                  const Eigen::Affine3d& world_from_block, const BodyOptions& options) {
  FacetedBody result;
  const std::string name = body.handle.empty() ? body.kind : body.kind + " " + body.handle;
  const std::optional<AcisFile> file = FileOf(body, sab);
  if (!file) {
    result.skipped[{name, "holds no ACIS body that can be read"}] = 1;
    return result;
  }
  const double scale = world_from_block.linear().colwise().norm().maxCoeff();
  AcisShape shape = FacetedAcis(*file, options.tolerance / scale, options.most_vertices);
  if (shape.faces == 0) result.skipped[{name, "its body has no face"}] = 1;
  for (const auto& [reason, count] : shape.unread) {
    const bool is_free_form = reason.starts_with("on a ") || reason.starts_with("bounded by ");
    const char* remedy = is_free_form ? ": make it a mesh (AutoCAD: MESHSMOOTH)" : "";
    result.skipped[{"face of " + name, reason + remedy}] += count;
  }
  for (const AcisSphere& sphere : shape.spheres) {
    if (IsSimilarity(world_from_block, scale)) {
      result.spheres.push_back({world_from_block * sphere.center, scale * sphere.radius, 0});
    } else {
      AddFacets(sphere, options.tolerance / scale, &shape);
    }
  }
  for (const Vector3d& vertex : shape.vertices) {
    result.vertices.push_back(world_from_block * vertex);
  }
  result.triangles = std::move(shape.triangles);
  if (world_from_block.linear().determinant() < 0) {
    for (Eigen::Vector3i& triangle : result.triangles) std::swap(triangle[1], triangle[2]);
  }
  return result;
}

}  // namespace insitu
