// SPDX-License-Identifier: GPL-3.0-or-later
// How the sky of a site is spread, from what its photographs show of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "calibration/files/sentence.h"
#include "calibration/program/site.h"
#include "radiometry/measure/fit_sky.h"
#include "radiometry/measure/photograph_set.h"
#include "radiometry/measure/samples.h"
#include "radiometry/measure/sky_places.h"
#include "radiometry/natural_environment.h"

namespace insitu {

struct SeenSky {
  SkyFit fit;
  int photos = 0;  // that show the sky
};

// The blocks of a site's photographs, what stands in front (survey/foreground/) left out: kept for
// when the sky is measured again, as long as lens and matte are the same. What is asked for under
// one name is one photograph.
class KeptSkyBlocks {
 public:
  // Of photos[index], taken by scene.cameras[index]. Throws InputError: a matte at fault.
  const SkyBlocks& Of(const SitePaths& site, const SceneGeometry& scene,
                      const PhotographSet& photos, size_t index);

 private:
  struct Kept {
    std::string made_of;  // lens and matte
    SkyBlocks blocks;
  };
  std::map<std::string, Kept> of_photo_;
};

// From all photographs; a shape that is not uniform goes into the light of `environment`, whose
// scene and spectra are known. `horizon` samples tell what is sky; `is_average`: one shape for all
// wavelengths. Throws InputError: a matte at fault.
SeenSky MeasureSky(const SitePaths& site, const PhotographSet& photos,
                   const std::vector<PixelSample>& horizon, bool is_average, KeptSkyBlocks* kept,
                   NaturalEnvironment* environment);

// Whether a photographed sky is 1.5 times as bright, or as dark, as the one that lights the
// samples.
bool IsAnotherSky(const Spectrum& photographed, const Spectrum& lighting, const SpectralBins& bins);

// Warns where the photographs show another sky than that which lights the daylight samples: both
// are told in one unit, if the samples' albedo is known.
void WarnOfAnotherSky(const NaturalEnvironment& environment, const SeenSky& sky,
                      std::vector<Sentence>* warnings);

}  // namespace insitu
