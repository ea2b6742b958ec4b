// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf/dxf_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "renderer/dxf/dxf_body.h"
#include "renderer/dxf/dxf_color.h"
#include "renderer/dxf/dxf_entity_reader.h"
#include "renderer/dxf/dxf_external.h"
#include "renderer/dxf/dxf_reader.h"
#include "renderer/dxf/dxf_units.h"

namespace insitu {
namespace {

constexpr size_t kDeepest = 64;

// The header's variables are pairs: 9 and a name, then the value.
void ReadHeader(const DxfRecord& header, DxfReader* reader, DxfDrawing* drawing) {
  const auto tags = header.tags();
  for (size_t i = 0; i + 1 < tags.size(); ++i) {
    if (tags[i].code != 9) continue;
    const DxfTag& value = tags[i + 1];
    if (tags[i].value == "$ACADVER") drawing->version = value.value;
    if (tags[i].value == "$DWGCODEPAGE") reader->SetCodePage(std::string(value.value));
    if (tags[i].value != "$INSUNITS") continue;
    const int units = header.IntegerOf(value);
    drawing->metres_per_unit = MetresPerDxfUnit(units);
    if (units != 0 && !drawing->metres_per_unit) {
      const std::string unit = "$INSUNITS is " + std::to_string(units);
      drawing->warnings.push_back(
          header.ErrorAt(value, unit + ", no unit that is known (6: metres)").what());
    }
  }
}

// The block's handle, and the one that its extended data AcDbBlockRepBTag names.
void ReadBlockTableEntry(const DxfRecord& record, DxfDrawing* drawing) {
  const std::string name = record.Name(2);
  if (const DxfTag* handle = record.Find(5)) {
    drawing->block_of_handle[DxfHandle(handle->value)] = name;
  }
  bool is_representation = false;
  for (const DxfTag& tag : record.tags()) {
    constexpr int kApplication = 1001, kHandle = 1005;
    if (tag.code == kApplication) is_representation = tag.value == "AcDbBlockRepBTag";
    if (is_representation && tag.code == kHandle) {
      drawing->dynamic_block[NameKey(name)] = DxfHandle(tag.value);
    }
  }
}

// A colour that is no number costs itself: white, as of a new layer.
int LayerColor(const DxfRecord& record, DxfDrawing* drawing) {
  constexpr int kWhite = 7;
  try {
    return record.Integer(62, kWhite);
  } catch (const InputError& error) {
    drawing->warnings.push_back(std::string(error.what()) + ": the layer's colour is left out");
    return kWhite;
  }
}

void ReadTableEntry(const DxfRecord& record, DxfDrawing* drawing) {
  if (record.kind() == "BLOCK_RECORD") return ReadBlockTableEntry(record, drawing);
  if (record.kind() != "LAYER") return;
  DxfLayer layer;
  const int color = LayerColor(record, drawing);  // negative if off
  layer.frozen = record.Integer(70, 0) & 1;
  layer.off = color < 0;
  layer.no_plot = record.Integer(290, 1) == 0;
  layer.rgb = ColorOfIndex(color == -2147483647 - 1 ? 0 : std::abs(color));
  if (const DxfTag* tag = record.Find(420)) {
    layer.rgb = LinearFromSrgb24(static_cast<uint32_t>(record.IntegerOf(*tag)) & 0xFFFFFF);
  }
  drawing->layers[NameKey(record.Name(2))] = layer;
}

// Reads the records of one section, whose end must come.
class SectionReader {
 public:
  SectionReader(DxfReader* reader, DxfDrawing* drawing) : reader_(reader), drawing_(drawing) {}

  // `head` is the SECTION; it is gone after the first record.
  void Read(const DxfRecord& head) {
    const std::string name = head.Name(2);
    const DxfPlace place = head.place();
    if (name == "HEADER") ReadHeader(head, reader_, drawing_);
    DxfEntityReader entities(&drawing_->model_space);
    while (const DxfRecord* record = reader_->Next()) {
      if (record->kind() == "ENDSEC") return Finish(&entities);
      if (name == "TABLES") ReadTableEntry(*record, drawing_);
      if (name == "BLOCKS") ReadBlockRecord(*record);
      if (name == "ENTITIES") entities.Add(*record);
      if (name == "ACDSDATA") ReadDxfBodyData(*record, &drawing_->body_of_handle);
    }
    throw place.Error("section " + name + " is not closed, expected an ENDSEC");
  }

 private:
  void Finish(DxfEntityReader* entities) {
    if (block_) {
      throw block_place_.Error("block \"" + block_->name + "\" is not closed, expected an ENDBLK");
    }
    entities->Finish();
  }

  void ReadBlockRecord(const DxfRecord& record) {
    if (!block_) {
      if (record.kind() == "BLOCK") BeginBlock(record);
    } else if (record.kind() == "ENDBLK") {
      block_entities_->Finish();
      drawing_->blocks[NameKey(block_->name)] = std::move(*block_);
      block_entities_.reset();
      block_.reset();
    } else {
      block_entities_->Add(record);
    }
  }

  void BeginBlock(const DxfRecord& head) {
    constexpr int kAttached = 4, kOverlaid = 8;
    block_place_ = head.place();
    block_.emplace();
    block_->name = head.Name(2);
    block_->base = head.FindPoint(10).value_or(Eigen::Vector3d(Eigen::Vector3d::Zero()));
    block_->external = head.Integer(70, 0) & (kAttached | kOverlaid);
    block_->is_overlay = head.Integer(70, 0) & kOverlaid;
    block_->external_file = head.Name(1);
    block_entities_.emplace(&*block_);
  }

  DxfReader* reader_;
  DxfDrawing* drawing_;
  DxfPlace block_place_;
  std::optional<DxfBlock> block_;
  std::optional<DxfEntityReader> block_entities_;
};

// Of a block with all that it inserts.
struct Extent {
  double pieces = 0;  // far beyond any integer in a malicious drawing
  size_t depth = 0;   // of blocks
};

double OwnPieces(const DxfBlock& block) {
  double pieces = static_cast<double>(block.vertices.size());
  for (const auto& [kind, count] : block.entities) pieces += count;
  return pieces;
}

// Looks at every block that the model space uses, once, before any is copied.
class InsertCheck {
 public:
  InsertCheck(const DxfDrawing& drawing, double most_pieces)
      : drawing_(drawing), most_pieces_(most_pieces) {}

  Extent AllInserted(const DxfBlock& holder) {
    Extent all;
    for (const DxfInsert& insert : holder.inserts) {
      const Extent one = Inserted(insert);
      all.pieces += one.pieces * insert.rows * insert.columns;
      all.depth = std::max(all.depth, one.depth);
      if (all.pieces > most_pieces_) {
        throw insert.place.Error("copies of blocks come to over " +
                                 std::to_string(std::lround(most_pieces_ / 1e6)) +
                                 " million pieces");
      }
    }
    return all;
  }

 private:
  Extent Inserted(const DxfInsert& insert) {
    const DxfBlock& block = InsertedBlock(drawing_, insert);
    if (std::ranges::find(nesting_, &block) != nesting_.end()) {
      throw insert.place.Error("block \"" + insert.block + "\" inserts itself");
    }
    const auto known = extents_.find(&block);
    const size_t depth = nesting_.size() + (known == extents_.end() ? 1 : known->second.depth);
    if (depth > kDeepest) {
      throw insert.place.Error("blocks within blocks, more than 64 deep");
    }
    if (known != extents_.end()) return known->second;
    nesting_.push_back(&block);
    const Extent inner = AllInserted(block);
    nesting_.pop_back();
    return extents_[&block] = {1 + OwnPieces(block) + inner.pieces, 1 + inner.depth};
  }

  const DxfDrawing& drawing_;
  double most_pieces_;
  std::vector<const DxfBlock*> nesting_;
  std::map<const DxfBlock*, Extent> extents_;
};

// An INSERT of a block within itself costs only itself. What is too deep is told by InsertCheck.
void DropOwnInserts(DxfDrawing* drawing, DxfBlock* holder, std::vector<const DxfBlock*>* nesting,
                    std::set<const DxfBlock*>* done) {
  if (nesting->size() > kDeepest || !done->insert(holder).second) return;
  nesting->push_back(holder);
  std::erase_if(holder->inserts, [&](const DxfInsert& insert) {
    DxfBlock& block = drawing->blocks.at(NameKey(insert.block));
    if (std::ranges::find(*nesting, &block) == nesting->end()) {
      DropOwnInserts(drawing, &block, nesting, done);
      return false;
    }
    ++holder->skipped[{"INSERT", "of block \"" + insert.block + "\", which it is within"}];
    return true;
  });
  nesting->pop_back();
}

// An INSERT of a block that is not there costs only itself.
void DropLostInserts(const DxfDrawing& drawing, DxfBlock* holder) {
  std::erase_if(holder->inserts, [&](const DxfInsert& insert) {
    if (drawing.blocks.contains(NameKey(insert.block))) return false;
    ++holder->skipped[{"INSERT",
                       "of block \"" + insert.block + "\", which the drawing does not define"}];
    return true;
  });
}

DxfDrawing ReadSections(const std::filesystem::path& path, bool blocks_only = false) {
  DxfDrawing drawing;
  DxfReader reader(path);
  drawing.binary = reader.binary();
  SectionReader section(&reader, &drawing);
  while (const DxfRecord* record = reader.Next()) {
    if (record->kind() != "SECTION") continue;
    if (blocks_only && record->Name(2) == "ENTITIES") break;  // the bulk of it
    section.Read(*record);
  }
  return drawing;
}

// `nesting` ends with the drawing itself.
DxfDrawing ReadWithReferences(const std::filesystem::path& path,
                              const std::vector<std::filesystem::path>& nesting) {
  DxfDrawing drawing = ReadSections(path);
  const auto read = [&nesting](const std::filesystem::path& other) {
    std::vector<std::filesystem::path> deeper = nesting;
    deeper.push_back(other);
    return ReadWithReferences(other, deeper);
  };
  AddExternalDrawings(nesting, read, &drawing);
  return drawing;
}

std::filesystem::path Whole(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).lexically_normal();
}

// Of "grid|*U3", "*U3".
std::string WithoutDrawing(const std::string& name) { return name.substr(name.rfind('|') + 1); }

}  // namespace

const DxfBlock& InsertedBlock(const DxfDrawing& drawing, const DxfInsert& insert) {
  const auto found = drawing.blocks.find(NameKey(insert.block));
  if (found == drawing.blocks.end()) {
    throw insert.place.Error("INSERT of block \"" + insert.block +
                             "\", which the drawing does not define");
  }
  return found->second;
}

std::string NameByUser(const DxfDrawing& drawing, const std::string& block) {
  if (!WithoutDrawing(block).starts_with('*')) return block;
  const auto handle = drawing.dynamic_block.find(NameKey(block));
  if (handle == drawing.dynamic_block.end()) return "";
  const auto named = drawing.block_of_handle.find(handle->second);
  const bool is_named =
      named != drawing.block_of_handle.end() && !WithoutDrawing(named->second).starts_with('*');
  return is_named ? named->second : "";
}

DxfDrawing ReadDxfDrawing(const std::filesystem::path& path, double most_pieces,
                          const std::filesystem::path& beside) {
  DxfDrawing drawing = ReadWithReferences(path, {Whole(beside)});
  DropLostInserts(drawing, &drawing.model_space);
  for (auto& [name, block] : drawing.blocks) DropLostInserts(drawing, &block);
  std::vector<const DxfBlock*> nesting;
  std::set<const DxfBlock*> done;
  DropOwnInserts(&drawing, &drawing.model_space, &nesting, &done);
  InsertCheck(drawing, most_pieces).AllInserted(drawing.model_space);
  return drawing;
}

std::vector<std::filesystem::path> ExternalDrawingsOf(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  const DxfDrawing drawing = ReadSections(path, /*blocks_only=*/true);
  for (const auto& [key, block] : drawing.blocks) {
    if (!block.external || !block.entities.empty()) continue;
    if (const auto file = FindExternalDrawing(Whole(path), block.external_file)) {
      files.push_back(*file);
    }
  }
  return files;
}

}  // namespace insitu
