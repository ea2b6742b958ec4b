// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf_drawing.h"

#include <algorithm>

#include "renderer/dxf_units.h"

namespace insitu {
namespace {

using Records = std::span<const DxfRecord>;

constexpr size_t kDeepest = 64;
constexpr double kMostPieces = 20e6;  // vertices, entities and copies of blocks

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

// Of a block with all that it inserts.
struct Extent {
  double pieces = 0;  // far beyond any integer in a malicious drawing
  size_t depth = 0;   // of blocks
};

double OwnPieces(const DxfBlock& block) {
  double pieces = static_cast<double>(block.content.mesh.vertices.size());
  for (const auto& [kind, count] : block.content.entities) pieces += count;
  for (const auto& [kind, count] : block.content.skipped) pieces += count;
  return pieces;
}

// Looks at every block that the model space uses, once, before any is copied.
class InsertCheck {
 public:
  explicit InsertCheck(const DxfDrawing& drawing) : drawing_(drawing) {}

  Extent AllInserted(const DxfBlock& holder) {
    Extent all;
    for (const DxfInsert& insert : holder.inserts) {
      const Extent one = Inserted(insert);
      all.pieces += one.pieces * insert.rows * insert.columns;
      all.depth = std::max(all.depth, one.depth);
      if (all.pieces > kMostPieces) {
        throw insert.record.Error("copies of blocks come to over 20 million pieces");
      }
    }
    return all;
  }

 private:
  Extent Inserted(const DxfInsert& insert) {
    const DxfBlock& block = InsertedBlock(drawing_, insert);
    if (std::ranges::find(nesting_, &block) != nesting_.end()) {
      throw insert.record.Error("block \"" + insert.block + "\" inserts itself");
    }
    const auto known = extents_.find(&block);
    const size_t depth = nesting_.size() + (known == extents_.end() ? 1 : known->second.depth);
    if (depth > kDeepest) {
      throw insert.record.Error("blocks within blocks, more than 64 deep");
    }
    if (known != extents_.end()) return known->second;
    nesting_.push_back(&block);
    const Extent inner = AllInserted(block);
    nesting_.pop_back();
    return extents_[&block] = {1 + OwnPieces(block) + inner.pieces, 1 + inner.depth};
  }

  const DxfDrawing& drawing_;
  std::vector<const DxfBlock*> nesting_;
  std::map<const DxfBlock*, Extent> extents_;
};

}  // namespace

std::string DxfKey(const std::string& name) {
  std::string key = name;
  for (char& c : key) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return key;
}

const DxfBlock& InsertedBlock(const DxfDrawing& drawing, const DxfInsert& insert) {
  const auto found = drawing.blocks.find(DxfKey(insert.block));
  if (found == drawing.blocks.end()) {
    throw insert.record.Error("INSERT of block \"" + insert.block +
                              "\", which the drawing does not define");
  }
  return found->second;
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
  InsertCheck(drawing).AllInserted(drawing.model_space);
  return drawing;
}

}  // namespace insitu
