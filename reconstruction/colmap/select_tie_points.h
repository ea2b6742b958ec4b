// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the many points that image matching finds go into the adjustment.
#pragma once

#include <map>
#include <string>

#include "calibration/lens/camera.h"
#include "reconstruction/survey/tie_points.h"

namespace insitu {

struct TiePointSelection {
  int points_per_photo = 2000;  // at most; 0: all
  int columns = 20, rows = 15;  // cells of a photo that share its points evenly
  double min_angle = 0.035;     // [rad], 2 degrees, largest between two of a point's rays
  double limit_sigma = 4;  // a mark that is off by more, of the median's robust sigma, is dropped

  // Throws CheckError that names the field: a number of points or an angle below 0, of cells or
  // sigmas that is not above.
  void Check() const;
};

struct TiePointCounts {
  int found = 0, kept = 0;
  int marks_off = 0;                                  // marks dropped for their residual
  int too_few_rays = 0, weak_angle = 0, crowded = 0;  // points dropped, for the first that applies
};

// Keeps, for each photo, well distributed points, those with most rays and then with the smallest
// residuals first, and sets sigma_px from the residuals of what it keeps. Marks behind a camera or
// off its photograph go. `cameras` holds those of all placed photos.
TiePointCounts SelectTiePoints(const std::map<std::string, Camera>& cameras,
                               const TiePointSelection& selection, TiePoints* tie_points);

}  // namespace insitu
