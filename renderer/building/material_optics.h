// SPDX-License-Identifier: GPL-3.0-or-later
// What of a planned material mirrors and lets light through, in building/materials.json.
#pragma once

#include "radiometry/library/material_keys.h"
#include "renderer/building/artificial_environment.h"

namespace insitu {

// Of a material's entry, keys
//   specular: none, fresnel (needs ior), mirror, conductor (needs complex_index [[nm, n, k], ...]),
//   specular_weight 0..1, roughness 0..1, distribution: ggx or beckmann,
//   specular_rgb [r, g, b]: reflectance of a coloured mirror, the same at all angles, 0..1,
//   transmission 0..1: share of the light that is not mirrored and goes through; with
//   thin true (the default): a pane of thickness_m drawn as one face, or
//   solid true: the faces bound a body, at which light is refracted,
//   absorption_per_m: [r, g, b] >= 0, or absorption_table: [[nm, per metre], ...],
//   translucent_rgb [r, g, b] or translucent_table [[nm, share], ...]: share of the light that
//   falls on one side and leaves the other in all directions (blinds, membranes, leaves), alike
//   from both sides; with the colour times diffuse_weight at most 1, and not beside transmission,
//   bumps: see ReadBumps.
// Sets specular, specular_rgb, metal, glass, translucent and bumps; `surface` has its colour.
// Throws InputError: out of range, an unknown word, an index of 1 or less, both thin and solid, a
// table that does not rise or covers less than the visible range.
void ReadOptics(const MaterialKeys& material, SurfaceMaterial* surface);

}  // namespace insitu
