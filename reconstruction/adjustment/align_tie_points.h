// SPDX-License-Identifier: GPL-3.0-or-later
// From the frame of image matching to the world: by control points where the photographs show them,
// and by surveyed camera positions.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "reconstruction/geometry/similarity.h"
#include "reconstruction/survey/survey.h"
#include "reconstruction/survey/tie_points.h"

namespace insitu {

// What is known of a model's place in the world.
struct ModelControl {
  std::vector<std::string> names;     // "control point 'A'", "camera position of photo 'P1'"
  std::vector<SimilarityPair> pairs;  // model to world
};

// Control points (role control) that two or more placed photos mark, located in the model by
// intersecting these marks, and centres of placed photos with a surveyed position. A pair's sigma
// is that of the survey, of the intersection, and two thousandths of the extent, since a model of
// image matching bends. `cameras` by photo, of all placed ones.
ModelControl FindModelControl(const Survey& survey, const std::map<std::string, Camera>& cameras,
                              const TiePoints& tie_points);

struct TiePointAlignment {
  std::optional<SimilarityFit> fit;  // nullopt: fewer than three pairs, or they lie on one line
  Similarity3 world_from_model;      // of the fit, else as far as one or two pairs tell
  int pairs = 0;
  std::vector<std::string>
      warnings;  // outliers by name; what stays free; no fit and none of these:
                 // camera positions that tell no tilt, which is then upright's
};

// Moves the model into the world as well as its control tells: by three or more pairs wholly; by
// two in position and scale, turned as little as possible; by one in position. What these leave
// open upright_model.h gives, as far as it can.
// The warnings say what of scale and datum stays arbitrary. Throws InputError, at the control file,
// if a mirror image would fit far better.
TiePointAlignment AlignTiePoints(const Survey& survey, const std::map<std::string, Camera>& cameras,
                                 TiePoints* tie_points);

// The same model in the target frame.
void Transform(const Similarity3& target_from_model, TiePoints* tie_points);

}  // namespace insitu
