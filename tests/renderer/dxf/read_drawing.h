// SPDX-License-Identifier: GPL-3.0-or-later
// Drawings of a test's own, read.
#pragma once

#include <string>

#include "renderer/dxf/dxf.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/dxf/dxf_text.h"

namespace insitu {

inline Model ReadText(const std::string& text) {
  const ScratchFolder folder;
  return ReadDxf(folder.Write("drawing.dxf", text));
}

// Of a drawing in metres with these entities in model space.
inline Model ReadEntities(const std::string& entities, const std::string& blocks = "") {
  return ReadText(DrawingText(entities, blocks));
}

}  // namespace insitu
