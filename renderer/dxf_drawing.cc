// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf_drawing.h"

#include <algorithm>

#include "renderer/dxf_units.h"

namespace insitu {
namespace {

using Records = std::span<const DxfRecord>;

// How many records come before the next one of this kind.
size_t CountUntil(Records records, std::string_view kind) {
  const auto found = std::ranges::find(records, kind, &DxfRecord::kind);
  return static_cast<size_t>(found - records.begin());
}

// The header's variables are pairs: 9 and a name, then the value.
void ReadHeader(const DxfRecord& header, DxfDrawing* drawing) {
  const auto tags = header.tags();
  for (size_t i = 0; i + 1 < tags.size(); ++i) {
    if (tags[i].code != 9 || tags[i].value != "$INSUNITS") continue;
    const int units = header.IntegerOf(tags[i + 1]);
    drawing->metres_per_unit = MetresPerDxfUnit(units);
    if (units != 0 && !drawing->metres_per_unit) {
      throw header.ErrorAt(
          tags[i + 1], "$INSUNITS is " + std::to_string(units) + ", expected 0 to 24 (6: metres)");
    }
  }
}

void ReadTables(Records records, DxfDrawing* drawing) {
  for (const DxfRecord& record : records) {
    if (record.kind() != "LAYER") continue;
    const bool frozen = record.Integer(70, 0) & 1;
    const bool off = record.Integer(62, 7) < 0;  // the colour, negative if off
    drawing->layers[DxfKey(record.Name(2))] = {frozen, off};
  }
}

void ReadBlocks(Records records, DxfDrawing* drawing) {
  while (!records.empty()) {
    const DxfRecord& head = records.front();
    records = records.subspan(1);
    if (head.kind() != "BLOCK") continue;
    const size_t count = CountUntil(records, "ENDBLK");
    if (count == records.size()) {
      throw head.Error("block \"" + head.Name(2) + "\" is not closed, expected an ENDBLK");
    }
    constexpr int kExternal = 4 | 8;  // attached, overlaid
    DxfBlock block = ReadDxfEntities(records.first(count));
    block.base = head.FindPoint(10).value_or(Eigen::Vector3d(Eigen::Vector3d::Zero()));
    block.external = head.Integer(70, 0) & kExternal;
    drawing->blocks[DxfKey(head.Name(2))] = std::move(block);
    records = records.subspan(count);
  }
}

}  // namespace

std::string DxfKey(const std::string& name) {
  std::string key = name;
  for (char& c : key) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return key;
}

DxfDrawing ReadDxfDrawing(const DxfFile& file) {
  DxfDrawing drawing;
  Records records = file.records();
  while (!records.empty()) {
    const DxfRecord& head = records.front();
    records = records.subspan(1);
    if (head.kind() != "SECTION") continue;
    const std::string name = head.Name(2);
    const size_t count = CountUntil(records, "ENDSEC");
    if (count == records.size()) {
      throw head.Error("section " + name + " is not closed, expected an ENDSEC");
    }
    const Records content = records.first(count);
    if (name == "HEADER") ReadHeader(head, &drawing);
    if (name == "TABLES") ReadTables(content, &drawing);
    if (name == "BLOCKS") ReadBlocks(content, &drawing);
    if (name == "ENTITIES") drawing.model_space = ReadDxfEntities(content);
    records = records.subspan(count);
  }
  return drawing;
}

}  // namespace insitu
