// SPDX-License-Identifier: GPL-3.0-or-later
// How much of the planned building a picture shows, in the levels of an accurate visual
// representation (AVR). [London View Management Framework 2012, Appendix C]
#pragma once

#include <map>
#include <string>

#include "calibration/lens/camera.h"
#include "calibration/photo/foreground.h"
#include "calibration/photo/raster.h"
#include "renderer/building/artificial_environment.h"
#include "renderer/building/building_outline.h"
#include "renderer/picture/render.h"
#include "renderer/trace/montage_scene.h"

namespace insitu {

// Place and size; what of it is seen as well; its form; its materials.
enum class AvrLevel { kSilhouette, kOutline, kForm, kMaterials };

inline const std::map<std::string, AvrLevel> kAvrLevels = {{"0", AvrLevel::kSilhouette},
                                                           {"1", AvrLevel::kOutline},
                                                           {"2", AvrLevel::kForm},
                                                           {"3", AvrLevel::kMaterials}};

// Neither is rendered: no light is needed.
inline bool IsDrawn(AvrLevel level) { return level < AvrLevel::kForm; }

// All of it matte and of one grey, of albedo 0.5: no textures, mirrors, glass and lamps.
ArtificialEnvironment FormOf(ArtificialEnvironment building);

// One view of a building. References must outlive the call.
struct DrawnView {
  const MontageScene& scene;
  const PosedCamera& camera;
  const Raster& photo;  // linear
  const Foreground* foreground = nullptr;
};

// All that lines of sight would meet of the building, hidden or not, in one colour that the
// photograph shines through. 16 lines a pixel where its edge may be.
RenderResult DrawSilhouette(const DrawnView& view);

// The border of the building's image as a line, dashed where the site or what is in front hides it;
// edges before the building itself, or behind it, are left out.
RenderResult DrawOutline(const DrawnView& view, const BuildingEdges& edges);

}  // namespace insitu
