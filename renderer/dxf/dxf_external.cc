// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf/dxf_external.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "renderer/dxf/dxf_body.h"
#include "renderer/foreign/file_reference.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

bool IsDwg(const fs::path& path) {
  constexpr size_t kHead = 4;
  std::string head(kHead, '\0');
  std::ifstream(path, std::ios::binary).read(head.data(), kHead);
  return head == "AC10";
}

std::string NamedAsDxf(const std::string& name) {
  const size_t dot = name.rfind('.');
  const bool has_ending = dot != name.npos && name.find_first_of("/\\", dot) == name.npos;
  return (has_ending ? name.substr(0, dot) : name) + ".dxf";
}

// DEFPOINTS is one layer, and 0 is the INSERT's.
bool IsOfEveryDrawing(const std::string& layer) {
  return layer == "0" || NameKey(layer) == "DEFPOINTS";
}

// Calls everything in a drawing "grid|NAME".
class Renamer {
 public:
  Renamer(const std::string& name, DxfDrawing* into) : prefix_(name + "|"), into_(*into) {}

  void Move(DxfDrawing from) {
    for (auto& [key, layer] : from.layers) {
      if (!IsOfEveryDrawing(key)) into_.layers.try_emplace(NameKey(prefix_) + key, layer);
    }
    for (auto& [key, block] : from.blocks) {
      Rename(&block);
      block.name = prefix_ + block.name;
      into_.blocks.try_emplace(NameKey(prefix_) + key, std::move(block));
    }
    for (auto& [handle, name] : from.block_of_handle) {
      into_.block_of_handle[prefix_ + handle] = prefix_ + name;
    }
    for (auto& [handle, bytes] : from.body_of_handle) {
      into_.body_of_handle[DxfHandle(prefix_ + handle)] = std::move(bytes);
    }
    for (auto& [key, handle] : from.dynamic_block) {
      into_.dynamic_block[NameKey(prefix_) + key] = prefix_ + handle;
    }
    std::ranges::move(from.warnings, std::back_inserter(into_.warnings));
    std::ranges::move(from.files, std::back_inserter(into_.files));
  }

  void Rename(DxfBlock* block) const {
    for (DxfLook& look : block->looks) Rename(&look);
    for (DxfInsert& insert : block->inserts) {
      Rename(&insert.look);
      insert.block = prefix_ + insert.block;
    }
    for (DxfBody& body : block->bodies) body.handle = prefix_ + DxfHandle(body.handle);
  }

 private:
  void Rename(DxfLook* look) const {
    if (!IsOfEveryDrawing(look->layer)) look->layer = prefix_ + look->layer;
  }

  std::string prefix_;
  DxfDrawing& into_;
};

// By how much any INSERT of the block scales it in x, if none scales as the units ask.
std::optional<double> OtherScale(const DxfDrawing& drawing, const std::string& block,
                                 double expected) {
  std::optional<double> other;
  const auto look_at = [&](const DxfBlock& holder) {
    for (const DxfInsert& insert : holder.inserts) {
      if (NameKey(insert.block) != block) continue;
      const double scale = insert.holder_from_block.linear().col(0).norm();
      if (std::abs(scale / expected - 1) > 0.01) other = scale;
    }
  };
  look_at(drawing.model_space);
  for (const auto& [key, holder] : drawing.blocks) look_at(holder);
  return other;
}

void WarnOfUnits(const fs::path& path, const std::string& key, const DxfDrawing& other,
                 DxfDrawing* drawing) {
  if (!other.metres_per_unit || !drawing->metres_per_unit) return;
  const double expected = *other.metres_per_unit / *drawing->metres_per_unit;
  const std::optional<double> scale = OtherScale(*drawing, key, expected);
  if (!scale) return;
  drawing->warnings.push_back(
      InputError(path, Formatted("its unit is %g times that of the drawing which refers to it, "
                                 "whose INSERT scales it by %g: shown so; is that meant?",
                                 expected, *scale))
          .what());
}

std::string WhyNotFound(const fs::path& path, const std::string& name) {
  const auto file = FindReference(path, name);
  const std::string remedy = fs::path(NamedAsDxf(name)).filename().string();
  const size_t at = remedy.find_last_of("\\/");
  const std::string as_dxf = at == remedy.npos ? remedy : remedy.substr(at + 1);
  if (file && IsDwg(*file)) {
    return "which is a DWG drawing: save it as DXF beside it (" + as_dxf + ")";
  }
  return "which is not there: put it beside the drawing as DXF (" + as_dxf +
         "), or bind it (AutoCAD: XREF > Bind)";
}

// Empty: it may be read.
std::string WhyNotToRead(const std::vector<fs::path>& nesting, const DxfBlock& block,
                         const std::optional<fs::path>& file) {
  if (!file) return WhyNotFound(nesting.back(), block.external_file);
  if (std::ranges::find(nesting, *file) != nesting.end()) return "which it is within";
  constexpr size_t kDeepestReference = 8;
  if (nesting.size() > kDeepestReference) return "more than 8 drawings deep";
  if (block.is_overlay && nesting.size() > 1) {
    return "an overlay, which further drawings do not show";
  }
  return "";
}

}  // namespace

std::optional<fs::path> FindExternalDrawing(const fs::path& path, const std::string& name) {
  for (const std::string& tried : {NamedAsDxf(name), name}) {
    const auto file = FindReference(path, tried);
    if (file && !IsDwg(*file)) return *file;
  }
  return std::nullopt;
}

void AddExternalDrawings(const std::vector<fs::path>& nesting,
                         const std::function<DxfDrawing(const fs::path&)>& read,
                         DxfDrawing* drawing) {
  std::vector<std::string> externals;
  for (const auto& [key, block] : drawing->blocks) {
    if (block.external && block.entities.empty()) externals.push_back(key);
  }
  for (const std::string& key : externals) {
    DxfBlock& block = drawing->blocks.at(key);
    const auto file = FindExternalDrawing(nesting.back(), block.external_file);
    block.why_unread = WhyNotToRead(nesting, block, file);
    if (!block.why_unread.empty()) continue;
    DxfDrawing other;
    try {
      other = read(*file);
    } catch (const InputError& error) {
      block.why_unread = "which cannot be read";
      drawing->warnings.emplace_back(error.what());
      continue;
    }
    WarnOfUnits(*file, key, other, drawing);
    DxfBlock content = std::exchange(other.model_space, {});
    content.name = block.name;
    content.base = block.base;
    Renamer renamer(block.name, drawing);
    renamer.Rename(&content);
    block = std::move(content);
    drawing->files.push_back(*file);
    renamer.Move(std::move(other));
  }
}

}  // namespace insitu
