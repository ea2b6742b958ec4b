// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/model_file.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <string_view>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/plain_text.h"
#include "calibration/files/whole_file.h"
#include "renderer/foreign/collada_model.h"
#include "renderer/foreign/ply_model.h"
#include "renderer/foreign/text_lines.h"
#include "renderer/formats/ifc_model.h"
#include "renderer/formats/isolated.h"
#include "renderer/formats/model_format.h"
#include "renderer/formats/obj_model.h"
#include "renderer/formats/objects_model.h"
#include "renderer/formats/stl_model.h"
#include "renderer/formats/temporary_folder.h"
#include "renderer/gltf/gltf_extensions.h"
#include "renderer/gltf/gltf_model.h"

namespace insitu {
namespace {

// Draco's decoder may break on a faulty file: it runs in a process of its own.
Model ReadGltfFile(const std::filesystem::path& path, int seconds) {
  const GltfFile file(path);
  if (!UsesDraco(file)) return ReadGltf(file);
  const IsolationLimits limits{.seconds = seconds};
  IsolatedModel isolated = ReadIsolated([&] { return ReadGltf(file); }, limits);
  if (isolated.model) return *std::move(isolated.model);
  const std::string prefix = path.string() + ": ";
  std::string failure = isolated.failure;
  if (failure.starts_with(prefix)) failure.erase(0, prefix.size());
  throw InputError(path, failure);
}

bool IsUtf16File(const std::filesystem::path& path) {
  constexpr int kHead = 16;
  char head[kHead] = {};
  std::ifstream file(path, std::ios::binary);
  file.read(head, kHead);
  return IsUtf16(std::string_view(head, static_cast<size_t>(file.gcount())));
}

// By lines, since files are large; a faulty line's bytes are of a code page.
bool IsUtf8File(const std::filesystem::path& path) {
  TextLines lines(path);
  for (std::string line; lines.Next(&line);) {
    if (!IsUtf8(line)) return false;
  }
  return true;
}

std::string Renamed(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// DXF and IFC are read piece by piece: a copy in UTF-8 is.
Model ReadCopy(const std::filesystem::path& path, const std::string& text,
               const std::function<Model(const std::filesystem::path&)>& read) {
  const TemporaryFolder folder;
  const std::filesystem::path copy = folder.path() / path.filename();
  WriteWhole(copy, text);
  try {
    Model model = read(copy);
    for (std::string& warning : model.warnings) {
      warning = Renamed(warning, copy.string(), path.string());
    }
    return model;
  } catch (const InputError& error) {
    const std::string prefix = copy.string() + ": ";
    std::string message = error.what();
    if (message.starts_with(prefix)) message.erase(0, prefix.size());
    throw InputError(path, Renamed(message, copy.string(), path.string()));
  }
}

Model ReadDxfFile(const std::filesystem::path& path, const DxfOptions& options) {
  if (!IsUtf16File(path)) return ReadDxf(path, options);
  DxfOptions of_copy = options;
  of_copy.stands_for = path;
  return ReadCopy(path, DecodedText(ReadWhole(path)),
                  [&](const auto& file) { return ReadDxf(file, of_copy); });
}

// web-ifc takes a second a megabyte: what takes far longer has no end.
int SecondsOfSize(const std::filesystem::path& path, int seconds) {
  constexpr double kAtLeast = 60, kBytesPerSecond = 5e4;
  const double expected = kAtLeast + static_cast<double>(file_size(path)) / kBytesPerSecond;
  return static_cast<int>(std::min<double>(seconds, expected));
}

// Old exporters write names in Windows-1252, where IFC has ASCII and its own codes.
Model ReadIfcFile(const std::filesystem::path& path, int most_seconds) {
  const int seconds = SecondsOfSize(path, most_seconds);
  if (!IsUtf16File(path) && IsUtf8File(path)) return ReadIfc(path, seconds);
  std::string text = DecodedText(ReadWhole(path));
  if (!IsUtf8(text)) text = PlainText(path, std::move(text));
  return ReadCopy(path, text, [&](const auto& file) { return ReadIfc(file, seconds); });
}

Model ReadByFormat(const std::filesystem::path& path, const ImportOptions& options) {
  switch (RequireModelFormat(path)) {
    case ModelFormat::kDxf:
      return ReadDxfFile(path, options.dxf);
    case ModelFormat::kIfc:
      return ReadIfcFile(path, options.seconds);
    case ModelFormat::kGltf:
      return ReadGltfFile(path, options.seconds);
    case ModelFormat::kCollada:
      return ReadCollada(path);
    case ModelFormat::kObj:
      return ReadObj(path);
    case ModelFormat::kPly:
      return ReadPly(path);
    case ModelFormat::kStl:
      return ReadStl(path);
    case ModelFormat::kObjects:
      return ReadObjects(path);
  }
  throw InputError(path, "is of no format that is read");
}

// Lines of lists, and terminals, end at what some files have within names.
void BlankControls(std::string* name) {
  const auto is_control = [](char c) { return (c >= 0 && c < ' ') || c == 127; };
  std::ranges::replace_if(*name, is_control, ' ');
}

void BlankControls(Model* model) {
  for (SurfaceNames& names : model->mesh.surfaces) {
    for (std::string* name : {&names.layer, &names.block, &names.material}) BlankControls(name);
  }
  for (std::string& warning : model->warnings) BlankControls(&warning);
  SkippedEntities skipped;
  for (const auto& [what, count] : model->skipped) {
    auto shown = what;
    BlankControls(&shown.first);
    BlankControls(&shown.second);
    skipped[shown] += count;
  }
  model->skipped = std::move(skipped);
}

}  // namespace

void ImportOptions::Check() const {
  dxf.Check();
  INSITU_CHECK(seconds > 0);
}

Model ReadModel(const std::filesystem::path& path, const ImportOptions& options) {
  options.Check();
  Model model = ReadByFormat(path, options);
  BlankControls(&model);
  return model;
}

}  // namespace insitu
