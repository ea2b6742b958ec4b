// SPDX-License-Identifier: GPL-3.0-or-later
// Where a photograph shows that the sun does not reach the site's surfaces although no polygon
// stands in its way: shadows of trees, cars, people. [Durisch92, case D3: the sun is not removed
// again]
#pragma once

#include "calibration/photo/foreground.h"
#include "renderer/shadows/shadow_separation.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

// `camera` and `photo` are one view; `scene` holds its light among surfaces. Pixels in front of
// which something stands (`foreground`, may be null), on mirroring surfaces, turned away from the
// sun or shaded by polygons are not judged. Photographs above 4 megapixels are looked at in blocks.
SunShares FindExistingShadows(const MontageScene& scene, const PosedCamera& camera,
                              const Raster& photo, const Foreground* foreground);

}  // namespace insitu
