// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/levels/avr_levels.h"

namespace insitu {

ArtificialEnvironment FormOf(ArtificialEnvironment building) {
  for (SurfaceMaterial& material : building.materials) {
    material = SurfaceMaterial{.name = material.name};
  }
  building.lights.clear();
  return building;
}

}  // namespace insitu
