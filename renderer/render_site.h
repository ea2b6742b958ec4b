// SPDX-License-Identifier: GPL-3.0-or-later
// From a site's files to its montages.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "calibration/photo/photograph.h"
#include "calibration/program/site.h"
#include "renderer/building/building_uncertainty.h"
#include "renderer/levels/avr_levels.h"
#include "renderer/picture/render.h"
#include "renderer/render_view.h"
#include "renderer/tiles/render_watcher.h"

namespace insitu {

enum class Sharpness {
  kMeasured,
  kIdeal
};  // as insitu-light measured it in the photograph, or each pixel the mean over its square

struct RenderSiteOptions {
  Frame frame = Frame::kPhoto;
  bool with_building = true;
  std::vector<std::string> photos;  // names; empty: every photo of the site
  RenderOptions render;             // point spread and grain apart: each photograph has its own
  Sharpness sharpness = Sharpness::kMeasured;
  bool with_grain = false;
  // Shadows of what no polygon stands for are looked for in the photographs; not with
  // uniform_ambient, nor where somebody has drawn them.
  bool find_shadows = true;
  bool uniform_ambient = false;     // the paper's light as printed, instead of light among surfaces
  bool as_printed = false;          // MontageScene::as_printed, with uniform_ambient
  std::optional<int> bounces = {};  // of light among surfaces, at most; 0: sun and sky alone
  bool with_tiff = false;           // of 16 bits, of every photograph
  bool is_quick = false;            // pictures packed little
  // What so many pixels hide of the building is taken together; 0: nothing is.
  double occlusion_pixels = 0;
  AvrLevel avr = AvrLevel::kMaterials;
  std::string quality = {};  // what the pictures say of it; empty: final
  // By ChosenLayers(), to <photo>.parts.exr; empty: none. Of the tiles that an earlier run has kept
  // those without these layers are rendered again.
  std::vector<std::string> layers = {};
  int light_coarseness = 1;          // of light among surfaces, as AddInterreflection has it
  bool keeps_pictures = true;        // in the reports, too: as much memory as all montages together
  std::function<bool()> stops = {};  // asked before each tile, from any thread
  RenderWatcher* watcher = nullptr;  // null: nobody looks on

  void Check() const;  // throws CheckError that names the field that is wrong
};

struct RenderSiteReport {
  std::string photo;
  RenderResult result;  // its picture is written already; empty unless keeps_pictures
  double pixels = 0;    // of the picture
  std::optional<PointSpread> point_spread;  // applied; nullopt: ideal
  bool has_grain = false;
  double seconds = 0;                             // rendering, files apart
  std::optional<UncertaintySummary> uncertainty;  // of the building's image; nullopt: no building
                                                  // in the frame, or no covariances
  // What of the photograph could not be delivered, what of it is clipped and changed all the same.
  std::vector<std::string> remarks;
  // Taken from within a solid of the building: nothing was rendered, and montages/ has none of it.
  bool is_within_building = false;
};

// It was asked to stop: what() tells how far it was. The same call goes on there.
class RenderStopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Reads work/environment.json and the input images that it names, work/building.json and its
// textures, the photographs to render into, survey/foreground/ and survey/shadows/, of the rest of
// survey/ only the hash; writes montages/<photo>.exr, .png and .jpg, .tif of a TIFF
// (montage_files.h); in <photo>.layers.exr which share of each pixel is the
// photograph's (red), computed (green), in front by the matte (blue); in <photo>.shadows.exr which
// share of the sun it shows to arrive (red), and its standard deviation (green); in
// <photo>.unseen.exr, if anything is, how much of each pixel is of surfaces, mirrored or behind
// glass, that no photograph shows (red); and how well the
// building's outline and sharp corners are known in <photo>.uncertainty.csv. Keeps the textures in
// linear light in work/textures/, light among surfaces for later renders of the same site and
// building in work/render/light.cache, and finished tiles in work/render/<photo>.partial until all
// photographs are written: whatever ends the program, the next run of the same inputs and options
// goes on there and comes to the same bytes. Throws InputError: a stage before is missing, an
// unknown photo, a texture that is not there, a photograph or matte whose size is not its camera's,
// a matte that is not grey, a photograph that another program is rendering; RenderStopped;
// std::runtime_error: the disk is full.
std::vector<RenderSiteReport> RenderSite(const SitePaths& site, const RenderSiteOptions& options);

}  // namespace insitu
