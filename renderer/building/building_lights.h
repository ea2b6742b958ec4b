// SPDX-License-Identifier: GPL-3.0-or-later
// The building's lamps: building/lights.json.
#pragma once

#include <filesystem>
#include <vector>

#include "radiometry/library/material_library.h"
#include "renderer/building/artificial_environment.h"
#include "renderer/mesh/model.h"

namespace insitu {

// {"site_luminance_cd_m2": 5000, "lights": [{"name": "lamp", "position": [x, y, z], ...}]}, a light
// with either intensity_rgb [r, g, b] in the site's unit, or
//   spectrum (D65, A, blackbody with temperature_K, or a lamp of the library), spectrum_table [[nm,
//   value], ...] or spectrum_file (CSV: wavelength,value), and one of luminous_intensity_cd,
//   luminous_flux_lm, luminance_cd_m2 (area), or ies (a file beside it; dimming 0..1).
// "type": "point" (the default); "spot" with direction, half_angle_deg and edge_deg (over which it
// fades); "area", a parallelogram from position along edge_u and edge_v, that shines to the side of
// their cross product; an ies lamp has direction (down if absent) and turn_deg. An area becomes
// samples x samples (4 x 4) lamps. radius_m: of a luminous sphere about the position, which makes
// soft shadows; visible true: it, or the area, is seen itself.
// Photometric strengths need the luminance that the site's unit stands for, which a luminance meter
// tells; without it they are kept in candela, and intensity_rgb is zero.
// Throws InputError: unreadable, a negative strength, an unknown type or spectrum, a direction of
// no length, a faulty IES file.
std::vector<PointLight> ReadLights(const std::filesystem::path& path,
                                   const MaterialLibrary& library = {});

// Lamps that a model itself holds, in the world; their strength is known in the site's unit if
// lights.json (`path`, which need not be there) states site_luminance_cd_m2.
std::vector<PointLight> LightsOfModel(const std::vector<ModelLamp>& lamps,
                                      const std::filesystem::path& path);

}  // namespace insitu
