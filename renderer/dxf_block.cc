// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf_block.h"

#include <cmath>
#include <functional>
#include <numbers>

#include "renderer/dxf_surfaces.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

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

DxfInsert ReadInsert(const DxfRecord& record) {
  const Eigen::Matrix3d axes = DxfEntityAxes(record);
  const double degrees = record.Number(50, 0);
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, Vector3d::UnitZ());
  DxfInsert insert{
      record, record.Name(2), record.Name(8, "0"), Eigen::Affine3d::Identity(), 1, 1, {}, {}};
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

// Whether the POLYLINE carried a surface.
bool ReadPolyline(const DxfRecord& polyline, std::span<const DxfRecord> following,
                  DxfModel* model) {
  constexpr int kPolygonMesh = 16, kPolyface = 64;
  size_t count = 0;
  while (count < following.size() && following[count].kind() == "VERTEX") ++count;
  const std::span<const DxfRecord> vertices = following.first(count);
  const int flags = polyline.Integer(70, 0);
  if (flags & kPolyface) {
    AddDxfPolyface(polyline, vertices, model);
  } else if (flags & kPolygonMesh) {
    AddDxfPolygonMesh(polyline, vertices, model);
  }
  return flags & (kPolyface | kPolygonMesh);
}

// Whether the entity, first of `entities`, was one to read.
bool ReadEntity(std::span<const DxfRecord> entities, DxfBlock* block) {
  const DxfRecord& entity = entities.front();
  if (entity.kind() == "3DFACE") {
    AddDxf3dFace(entity, &block->content);
  } else if (entity.kind() == "SOLID" || entity.kind() == "TRACE") {
    AddDxfSolid(entity, &block->content);
  } else if (entity.kind() == "MESH") {
    AddDxfMesh(entity, &block->content);
  } else if (entity.kind() == "POLYLINE") {
    return ReadPolyline(entity, entities.subspan(1), &block->content);
  } else if (entity.kind() == "INSERT") {
    block->inserts.push_back(ReadInsert(entity));
  } else {
    return false;
  }
  return true;
}

bool IsPartOfAnother(const DxfRecord& record) {
  return record.kind() == "VERTEX" || record.kind() == "SEQEND" || record.kind() == "ATTRIB";
}

}  // namespace

Eigen::Matrix3d DxfEntityAxes(const DxfRecord& entity) {
  const std::optional<Vector3d> extrusion = entity.FindPoint(210);
  if (!extrusion) return Eigen::Matrix3d::Identity();
  if (extrusion->norm() == 0) {
    throw entity.ErrorAt(*entity.Find(210), "an extrusion direction of no length");
  }
  const Vector3d z = extrusion->normalized();
  const bool near_world_z = std::abs(z.x()) < 1.0 / 64 && std::abs(z.y()) < 1.0 / 64;
  const Vector3d x = (near_world_z ? Vector3d::UnitY() : Vector3d::UnitZ()).cross(z).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

DxfBlock ReadDxfEntities(std::span<const DxfRecord> entities) {
  DxfBlock block;
  for (size_t i = 0; i < entities.size(); ++i) {
    const DxfRecord& entity = entities[i];
    if (IsPartOfAnother(entity)) continue;
    const std::string kind(entity.kind());
    if (entity.Integer(60, 0) == 1) {
      ++block.content.skipped[kind + " (invisible)"];
    } else if (entity.Integer(67, 0) == 1) {
      ++block.content.skipped[kind + " (paper space)"];
    } else {
      const bool read = ReadEntity(entities.subspan(i), &block);
      ++(read ? block.content.entities : block.content.skipped)[kind];
    }
  }
  return block;
}

}  // namespace insitu
