// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf_inserts.h"

#include <algorithm>

namespace insitu {
namespace {

constexpr size_t kDeepest = 64;
constexpr double kMostPieces = 20e6;

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

const DxfBlock& InsertedBlock(const DxfDrawing& drawing, const DxfInsert& insert) {
  const auto found = drawing.blocks.find(DxfKey(insert.block));
  if (found == drawing.blocks.end()) {
    throw insert.record.Error("INSERT of block \"" + insert.block +
                              "\", which the drawing does not define");
  }
  return found->second;
}

void CheckInserts(const DxfDrawing& drawing) {
  InsertCheck(drawing).AllInserted(drawing.model_space);
}

}  // namespace insitu
