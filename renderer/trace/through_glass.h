// SPDX-License-Identifier: GPL-3.0-or-later
// Light that comes through the planned building's glass, straight on.
#pragma once

#include "renderer/trace/montage_scene.h"

namespace insitu {

// What a pane mirrors and lets through at this cosine, whatever its roughness.
SheetOptics PaneOptics(const SpectralGlass& glass, double cosine);
// The share that one face of a body lets through.
double FaceTransmittance(const SpectralGlass& glass, double cosine);

// The share of light along a ray, up to its far end, that the building lets through: 0 behind
// something opaque, 1 where nothing stands. A pane counts with all reflections in it, a body of
// glass with both its interfaces and the way inside, as if it were a slab: light that it bends or
// scatters elsewhere goes straight on.
Spectrum TransmittanceAlong(const MontageScene& scene, const Ray& ray);

}  // namespace insitu
