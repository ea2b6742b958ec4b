// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of a montage and what they state.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/photo/montage_files.h"
#include "calibration/program/site.h"
#include "renderer/levels/avr_levels.h"
#include "renderer/picture/render.h"
#include "renderer/render_view.h"
#include "renderer/shadows/shadow_separation.h"

namespace insitu {

// What all pictures of a run are.
struct MontageKind {
  bool with_building = true;
  AvrLevel avr = AvrLevel::kMaterials;
  std::string quality = {};  // empty: final
  std::string parameters = {};
};

struct MontageFormat {
  Frame frame = Frame::kPhoto;
  bool with_tiff = false;  // of 16 bits
  bool is_quick = false;   // pictures packed little
};

// What they state of themselves; `computed` names what of the building is in them.
MontageStatement StatementOf(const SitePaths& site, const MontageKind& kind);

// montages/<photo>.exr and the others (montage_files.h). What of the photograph could not be
// delivered is returned. `linear` is the picture, of `result` the counts are taken.
std::vector<std::string> WriteMontage(const SitePaths& site,
                                      const std::filesystem::path& photograph,
                                      const MontageFormat& format, Photograph photo, Raster linear,
                                      const RenderResult& result,
                                      const MontageStatement& statement);

// montages/<photo>.shadows.exr, upright as the montage's EXR is; without `shares`, what an earlier
// run has left goes.
void WriteSunShares(const SitePaths& site, const std::filesystem::path& photograph,
                    const std::optional<SunShares>& shares);

// montages/<photo>.layers.exr, upright too, and <photo>.unseen.exr: how much of each pixel is of
// surfaces, mirrored or behind glass, that no photograph shows (red). If there is none, what of it
// an earlier run has left goes.
void WriteLayers(const SitePaths& site, const std::filesystem::path& photograph,
                 const RenderResult& result);

// What an earlier run has left.
void RemoveMontage(const SitePaths& site, const std::string& photo);

}  // namespace insitu
