// SPDX-License-Identifier: GPL-3.0-or-later
// What a COLLADA material says of a surface.
#pragma once

#include "renderer/foreign/collada_library.h"
#include "renderer/mesh/model.h"

namespace insitu {

// Name, colour or image, and opacity, without a layer. Opacity by all four ways of `opaque`; what
// names none and comes out wholly clear is taken as opaque, for programs write 0 there and mean
// that. Colours are those of a screen. What is not shown is counted as skipped.
SurfaceNames ReadColladaMaterial(const ColladaLibrary& library, const XmlNode& material,
                                 Model* model);

}  // namespace insitu
