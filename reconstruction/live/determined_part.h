// SPDX-License-Identifier: GPL-3.0-or-later
// The largest part of an unfinished survey that can be adjusted now, and what the rest lacks.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "calibration/files/sentence.h"
#include "calibration/lens/camera.h"
#include "calibration/lens/rigid3.h"
#include "reconstruction/adjustment/adjustment_options.h"
#include "reconstruction/adjustment/start_values.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// Something that takes no part in the adjustment.
struct LeftOut {
  enum class Kind {
    kPhoto,
    kPoint,
    kPolygon,
    kSun,
    kZenith,
    kEdge,
    kConstraint,
    kObservation,
  };
  Kind kind = Kind::kPhoto;
  std::string name;      // of the photo, point or polygon; else the points or polygons it joins
  std::string photo;     // of observations and edges, else empty
  Sentence reason;       // in plain words: "needs one more control point"
  FilePlace place = {};  // where it is stated; line 0: in that file, or not yet
  bool is_contradiction = false;  // it is not unfinished but wrong
};

// "photo", "point", "polygon", "sun", "zenith", "edge", "constraint", "observation".
const char* Word(LeftOut::Kind kind);

struct DeterminedPart {
  Survey survey;                    // all of it can be adjusted; maybe nothing
  std::vector<std::string> photos;  // the posed ones, in their order
  std::vector<size_t> indices;      // of these among the photos asked about
  StartValues start;                // of the part, cameras as `photos`
  std::vector<LeftOut> left_out;
  // Posed photos that show fewer than three control points: points of other photos place them.
  // FindStartValues would refuse these.
  std::vector<std::string> placed_by_points;
};

// Leaves out photos that nothing places, points that nothing determines and what names them, until
// everything left is determined. Gross contradictions are left out too: marks off their photograph
// or on a photo that is not among `photos`, photos that no place explains, polygons far from
// planar, direction pairs that point away from the others, edges between points in one place.
// Throws nothing for any survey that ReadSurvey returns.
DeterminedPart FindDeterminedPart(const Survey& survey, const std::vector<std::string>& photos,
                                  const std::vector<Camera>& cameras,
                                  const std::map<std::string, Rigid3>& initial_cam_from_world = {},
                                  const AdjustmentOptions& options = {});

}  // namespace insitu
