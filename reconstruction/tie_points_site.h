// SPDX-License-Identifier: GPL-3.0-or-later
// The stage insitu-tie-points on a site folder: photographs in, tie points and first poses out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "calibration/program/site.h"
#include "reconstruction/colmap/colmap_run.h"
#include "reconstruction/colmap/select_tie_points.h"

namespace insitu {

struct TiePointsOptions {
  ColmapOptions colmap;
  TiePointSelection selection;
  // A COLMAP model of these photographs made elsewhere, to be taken instead of running COLMAP. Its
  // keypoints must be those of the original photographs.
  std::filesystem::path model;

  void Check() const;  // throws CheckError that names the field
};

struct SiteTiePoints {
  TiePoints tie_points;
  TiePointCounts counts;
  std::string BriefReport() const;  // with a line "warning: ..." for each remark
};

// Takes the largest connected model, adds others that share control with it (three points each),
// keeps a well distributed choice of points, and writes site.tie_points(), beside it the largest
// model as COLMAP text in model/, and the programs' logs in logs/.
// `photos` as ListPhotographs gives them, `cameras` go with them.
// Throws InputError: two photographs with the same content, one of another size than its camera, a
// model of other photographs, COLMAP not installed or failing, no two photographs that it connects.
SiteTiePoints MakeTiePoints(const SitePaths& site, const std::vector<std::filesystem::path>& photos,
                            const std::vector<Camera>& cameras,
                            const TiePointsOptions& options = {});

// The same with the site's own photographs and camera.
SiteTiePoints MakeTiePoints(const SitePaths& site, const TiePointsOptions& options = {});

// Whether some photograph shows fewer than three control points, so that it cannot be resected
// alone.
bool NeedsTiePoints(const SitePaths& site);

}  // namespace insitu
