// SPDX-License-Identifier: GPL-3.0-or-later
// What light loses between the facets of a rough mirror, to give it back.
#pragma once

#include "radiometry/light/microfacet.h"

namespace insitu {

// Share of the light that a viewer at this cosine sees come back after one reflection, of facets
// that mirror all: MirrorLobe integrated over the hemisphere, 0..1; the rest meets further facets.
// From a table, good to 0.01. `roughness.slope` 0: 1. [Kulla & Conty 2017]
double MirroredShare(const Roughness& roughness, double cosine);

}  // namespace insitu
