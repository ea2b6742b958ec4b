// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf/dxf_entity_reader.h"

#include <cmath>
#include <numbers>
#include <set>

#include "calibration/files/wording.h"
#include "renderer/dxf/dxf_body.h"
#include "renderer/dxf/dxf_surfaces.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr int kClosed = 1, kSmoothed = 4, kIs3d = 8, kPolygonMesh = 16, kClosedAlongColumns = 32,
              kPolyface = 64;

// No CAD program scales by zero: such a file means that nothing was set.
double Scale(const DxfRecord& insert, int code) {
  const double scale = insert.Number(code, 1);
  return scale == 0 ? 1 : scale;
}

int CopyCount(const DxfRecord& insert, int code) {
  const int count = insert.Integer(code, 1);
  if (count < 0) {
    throw insert.ErrorAt(*insert.Find(code), "an INSERT with " + std::to_string(count) +
                                                 " copies, expected none or more");
  }
  return std::max(count, 1);
}

DxfInsert ReadInsert(const DxfRecord& record, const DxfLook& look) {
  const Eigen::Matrix3d axes = DxfEntityAxes(record);
  const double degrees = record.Number(50, 0);
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, Vector3d::UnitZ());
  DxfInsert insert{record.place(), record.Name(2), look, Eigen::Affine3d::Identity(), 1, 1, {}, {}};
  insert.holder_from_block.linear() =
      axes * turn * Eigen::Scaling(Scale(record, 41), Scale(record, 42), Scale(record, 43));
  insert.holder_from_block.translation() =
      axes * record.FindPoint(10).value_or(Vector3d(Vector3d::Zero()));
  insert.columns = CopyCount(record, 70);
  insert.rows = CopyCount(record, 71);
  insert.column_step = axes * (turn * Vector3d(record.Number(44, 0), 0, 0));
  insert.row_step = axes * (turn * Vector3d(0, record.Number(45, 0), 0));
  return insert;
}

constexpr int kLastColor = 257;  // BYENTITY; 256: BYLAYER

// A colour that is no number costs itself.
std::optional<int> ColorNumber(const DxfRecord& record, int code, SkippedEntities* skipped) {
  const DxfTag* tag = record.Find(code);
  if (!tag) return std::nullopt;
  try {
    return record.IntegerOf(*tag);
  } catch (const InputError&) {
    ++(*skipped)[{"colour", "no number: that of the layer is taken"}];
    return std::nullopt;
  }
}

// What an entity says of its look that is not shown.
void CountNotShown(const DxfRecord& record, SkippedEntities* skipped) {
  constexpr int kByValue = 0x02000000, kOpaque = 255;
  const int value = ColorNumber(record, 440, skipped).value_or(0);
  if ((value & kByValue) != 0 && (value & kOpaque) != kOpaque) {
    ++(*skipped)[{"transparency", "of the drawing: shown opaque, see materials.json"}];
  }
  if (record.Find(347)) {
    ++(*skipped)[{"material", "of the drawing: not read, see materials.json"}];
  }
}

DxfLook LookOf(const DxfRecord& record, SkippedEntities* skipped) {
  DxfLook look;
  CountNotShown(record, skipped);
  if (const DxfTag* tag = record.Find(8)) {
    if (tag->value != "0") look.layer = record.Name(8);
  }
  // A colour is negative only in the layer table, but some programs write it so here too.
  const int64_t index = ColorNumber(record, 62, skipped).value_or(kColorByLayer);
  look.color = static_cast<int>(std::abs(index) & 0xFFFF);
  if (look.color > kLastColor) ++(*skipped)[{"colour", "no index of one: shown in mid grey"}];
  if (const auto color = ColorNumber(record, 420, skipped)) look.true_color = *color & 0xFFFFFF;
  return look;
}

// Why a kind of entity is not read. Only what is known to have no surface is called so: anything
// else may be a roof.
std::string ReasonFor(std::string_view kind) {
  using Kinds = std::set<std::string_view>;
  static const Kinds kLines = {"ELLIPSE", "SPLINE", "HELIX", "MLINE",
                               "XLINE",   "RAY",    "POINT", "3DLINE"};
  static const Kinds kLettering = {
      "TEXT",           "MTEXT",     "RTEXT",         "ATTDEF",
      "ARCALIGNEDTEXT", "DIMENSION", "LEADER",        "TOLERANCE",
      "MULTILEADER",    "MLEADER",   "ACAD_TABLE",    "HATCH",
      "MPOLYGON",       "SHAPE",     "ARC_DIMENSION", "LARGE_RADIAL_DIMENSION"};
  static const Kinds kAids = {"VIEWPORT",         "IMAGE",       "WIPEOUT",     "OLEFRAME",
                              "OLE2FRAME",        "LIGHT",       "CAMERA",      "SUN",
                              "SECTIONOBJECT",    "PDFUNDERLAY", "DWFUNDERLAY", "DGNUNDERLAY",
                              "GEOPOSITIONMARKER"};
  if (kLines.contains(kind)) return "a line or point, no surface";
  if (kLettering.contains(kind)) return "lettering, symbol or flat filling, no surface";
  if (kAids.contains(kind)) return "a view, picture or lamp of the drawing, no surface";
  return "is not known and may have a surface: explode it, or save it as MESH, polyface or 3DFACE";
}

// As it can be shown, whatever a damaged file holds.
std::string NameOfKind(std::string_view kind) {
  const std::string quoted = Quoted(kind);
  return quoted.substr(1, quoted.size() - 2);
}

bool HasThickness(const DxfRecord& record) { return record.Number(39, 0) != 0; }

constexpr char kNoThickness[] = "without thickness or width, no surface";

}  // namespace

int DxfEntityReader::LookIndex(const DxfLook& look) {
  const std::string key = look.layer + '\0' + std::to_string(look.color) + '/' +
                          (look.true_color ? std::to_string(*look.true_color) : "");
  const auto [found, is_new] =
      look_of_key_.try_emplace(key, static_cast<int>(block_->looks.size()));
  if (is_new) block_->looks.push_back(look);
  return found->second;
}

void DxfEntityReader::Skip(std::string_view kind, const std::string& reason) {
  ++block_->skipped[{NameOfKind(kind), reason}];
}

void DxfEntityReader::Add(const DxfRecord& record) {
  const bool is_vertex = record.kind() == "VERTEX" && polyline_;
  try {
    is_vertex ? AddVertex(record) : Begin(record);
  } catch (const DxfNoNumber&) {
    Skip(is_vertex ? "POLYLINE" : record.kind(), "holds a coordinate that is no number");
    if (polyline_) polyline_->hidden = true;  // with what follows of it
  }
}

void DxfEntityReader::Begin(const DxfRecord& record) {
  if (record.kind() == "SEQEND" || record.kind() == "VERTEX") return Finish();
  if (record.kind() == "ATTRIB") return;  // the lettering of an INSERT
  Finish();
  ++block_->entities[NameOfKind(record.kind())];
  Read(record);
}

void DxfEntityReader::Read(const DxfRecord& record) {
  const bool invisible = record.Integer(60, 0) == 1, on_paper = record.Integer(67, 0) == 1;
  if (invisible || on_paper) {
    Skip(record.kind(), invisible ? "invisible" : "paper space");
    if (record.kind() == "POLYLINE") {
      polyline_ = Polyline{};
      polyline_->hidden = true;
    }
    return;
  }
  const DxfLook look = LookOf(record, &block_->skipped);
  if (record.kind() == "INSERT") return AddInsert(record, look);
  const int index = LookIndex(look);
  if (record.kind() == "POLYLINE") return BeginPolyline(record, index);
  if (ReadSurface(record, index)) {
    ++block_->kinds_of_look[{index, std::string(record.kind())}];
  }
}

void DxfEntityReader::AddInsert(const DxfRecord& record, const DxfLook& look) {
  block_->inserts.push_back(ReadInsert(record, look));
}

// Whether the entity was one to read; if not, it is counted as skipped.
bool DxfEntityReader::ReadSurface(const DxfRecord& record, int look) {
  const std::string_view kind = record.kind();
  if (kind == "3DFACE") {
    AddDxf3dFace(record, look, block_);
  } else if (kind == "SOLID" || kind == "TRACE") {
    AddDxfSolid(record, look, block_);
  } else if (kind == "MESH") {
    AddDxfMesh(record, look, block_);
  } else if (IsDxfBody(kind)) {
    block_->bodies.push_back(DxfBodyOf(record));
    block_->bodies.back().look = look;
  } else if ((kind == "LINE" || kind == "CIRCLE" || kind == "ARC") && !HasThickness(record)) {
    Skip(kind, kNoThickness);
    return false;
  } else if (kind == "LINE" || kind == "CIRCLE" || kind == "ARC" || kind == "LWPOLYLINE") {
    DxfPath path = kind == "LINE"         ? DxfLinePath(record)
                   : kind == "LWPOLYLINE" ? DxfLwPolylinePath(record)
                                          : DxfArcPath(record);
    path.look = look;
    if (!path.IsSurface()) {
      Skip(kind, kNoThickness);
      return false;
    }
    block_->paths.push_back(std::move(path));
  } else {
    Skip(kind, ReasonFor(kind));
    return false;
  }
  return true;
}

void DxfEntityReader::BeginPolyline(const DxfRecord& record, int look) {
  polyline_ = Polyline{};
  Polyline& polyline = *polyline_;
  polyline.place = record.place();
  polyline.look = look;
  polyline.flags = record.Integer(70, 0);
  const bool smoothed = polyline.flags & kSmoothed;
  polyline.rows = record.Integer(smoothed ? 73 : 71, 0);
  polyline.columns = record.Integer(smoothed ? 74 : 72, 0);
  if (polyline.flags & (kPolygonMesh | kPolyface)) return;
  polyline.path.look = look;
  polyline.path.axes = DxfEntityAxes(record);
  polyline.path.closed = polyline.flags & kClosed;
  polyline.path.thickness = polyline.flags & kIs3d ? 0 : record.Number(39, 0);
  polyline.start_width = record.Number(40, 0);
  polyline.end_width = record.Number(41, 0);
  polyline.path.vertices.push_back({Vector3d(0, 0, record.Number(30, 0)), 0, 0, 0});  // elevation
}

void DxfEntityReader::AddVertex(const DxfRecord& vertex) {
  constexpr int kControlPoint = 16;  // of a smoothed mesh or a fitted line: not on it
  if (polyline_->hidden) return;
  const int flags = vertex.Integer(70, 0);
  if (polyline_->flags & kPolyface) return AddPolyfaceVertex(vertex, flags);
  if (flags & kControlPoint) return;
  if (polyline_->flags & kPolygonMesh) {
    polyline_->locations.push_back(vertex.Point(10));
  } else {
    AddPathVertex(vertex);
  }
}

void DxfEntityReader::AddPathVertex(const DxfRecord& vertex) {
  DxfPathVertex& elevation = polyline_->path.vertices.front();
  DxfPathVertex point;
  point.point = vertex.Point(10);
  point.point.z() = elevation.point.z();
  point.bulge = vertex.Number(42, 0);
  point.start_width = vertex.Number(40, polyline_->start_width);
  point.end_width = vertex.Number(41, polyline_->end_width);
  polyline_->path.vertices.push_back(point);
}

void DxfEntityReader::AddPolyfaceVertex(const DxfRecord& vertex, int flags) {
  constexpr int kLocation = 64, kFace = 128;
  if (flags & kLocation) {
    polyline_->locations.push_back(vertex.Point(10));
  } else if (flags & kFace) {
    DxfLook look = LookOf(vertex, &block_->skipped);
    // Many programs leave the faces on layer 0.
    if (look.layer == "0") look.layer = block_->looks[polyline_->look].layer;
    polyline_->faces.emplace_back(
        LookIndex(look),
        DxfPolyfaceCorners(vertex, static_cast<int64_t>(polyline_->locations.size())));
  }
}

void DxfEntityReader::FinishPolygonMesh(const Polyline& polyline) {
  const int64_t rows = polyline.rows, columns = polyline.columns;
  const auto count = static_cast<int64_t>(polyline.locations.size());
  if (rows < 2 || columns < 2 || rows * columns != count) {
    throw polyline.place.Error("a polygon mesh of " + std::to_string(rows) + " x " +
                               std::to_string(columns) + " vertices has " + std::to_string(count) +
                               " of them");
  }
  AddDxfGrid({polyline.rows, polyline.columns, (polyline.flags & kClosed) != 0,
              (polyline.flags & kClosedAlongColumns) != 0},
             polyline.locations, polyline.look, block_);
}

void DxfEntityReader::Finish() {
  if (!polyline_) return;
  Polyline polyline = std::move(*polyline_);
  polyline_.reset();
  if (polyline.hidden) return;
  if (polyline.flags & kPolyface) {
    const int first = AddDxfVertices(polyline.locations, block_);
    for (auto& [look, corners] : polyline.faces) {
      AddDxfFace(look, first, std::move(corners), block_);
    }
  } else if (polyline.flags & kPolygonMesh) {
    FinishPolygonMesh(polyline);
  } else {
    polyline.path.vertices.erase(polyline.path.vertices.begin());  // the elevation's
    if (polyline.flags & kIs3d || !polyline.path.IsSurface()) return Skip("POLYLINE", kNoThickness);
    block_->paths.push_back(std::move(polyline.path));
  }
  ++block_->kinds_of_look[{polyline.look, "POLYLINE"}];
}

}  // namespace insitu
