// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/model_file.h"

#include "calibration/files/error.h"
#include "renderer/formats/assimp_model.h"
#include "renderer/formats/ifc_model.h"
#include "renderer/formats/model_format.h"
#include "renderer/formats/obj_model.h"
#include "renderer/formats/stl_model.h"

namespace insitu {

void ImportOptions::Check() const {
  dxf.Check();
  INSITU_CHECK(seconds > 0);
}

Model ReadModel(const std::filesystem::path& path, const ImportOptions& options) {
  options.Check();
  const ModelFormat format = RequireModelFormat(path);
  if (format == ModelFormat::kDxf) return ReadDxf(path, options.dxf);
  if (format == ModelFormat::kObj) return ReadObj(path);
  if (format == ModelFormat::kIfc) return ReadIfc(path, options.seconds);
  if (format == ModelFormat::kStl) return ReadStl(path);
  return ReadWithAssimp(path, format, options.seconds);
}

}  // namespace insitu
