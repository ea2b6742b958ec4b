// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/model_file.h"

#include "calibration/files/error.h"
#include "renderer/foreign/collada_model.h"
#include "renderer/foreign/ply_model.h"
#include "renderer/formats/ifc_model.h"
#include "renderer/formats/isolated.h"
#include "renderer/formats/model_format.h"
#include "renderer/formats/obj_model.h"
#include "renderer/formats/objects_model.h"
#include "renderer/formats/stl_model.h"
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

}  // namespace

void ImportOptions::Check() const {
  dxf.Check();
  INSITU_CHECK(seconds > 0);
}

Model ReadModel(const std::filesystem::path& path, const ImportOptions& options) {
  options.Check();
  switch (RequireModelFormat(path)) {
    case ModelFormat::kDxf:
      return ReadDxf(path, options.dxf);
    case ModelFormat::kIfc:
      return ReadIfc(path, options.seconds);
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

}  // namespace insitu
