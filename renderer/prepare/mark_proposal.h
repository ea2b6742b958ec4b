// SPDX-License-Identifier: GPL-3.0-or-later
// Where a mark might better be, or where the same point shows on another photo. Proposals only: on
// rendered photographs a corner finder is no better than a careful hand (0.56 px against 0.36).
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>
#include <variant>

#include "calibration/files/sentence.h"
#include "calibration/lens/camera.h"

namespace insitu {

struct MarkProposal {
  Eigen::Vector2d pixel;
  double sigma_px = 0;  // >= 0.3
  double quality = 0;   // 0..1
  double shift_px = 0;  // from where it was asked for
};

// What speaks against a proposal, for people.
using NoProposal = Sentence;

// Grey values around the whole pixel nearest to a place.
struct GreyPatch {
  cv::Mat grey;            // 8 bit, (2 r + 1)^2
  Eigen::Vector2i center;  // of the photograph
};

// The corner near the middle, by the gradients of a window of 7 x 7 pixels. [Foerstner & Guelch
// 1987] None: it lies more than 2.5 px away, or an edge or an even surface is there and no corner.
std::variant<MarkProposal, NoProposal> RefineCorner(const GreyPatch& patch,
                                                    const Eigen::Vector2d& pixel);

// The centre of a point-symmetric figure near the middle: a cross, dot or ring, as fiducial marks
// are. By the correlation of 21 x 21 pixels with themselves turned by 180 degrees. None: it lies
// more than 4 px away, or a line or an even surface is there.
std::variant<MarkProposal, NoProposal> RefineSymmetric(const GreyPatch& patch,
                                                       const Eigen::Vector2d& pixel);

// The place in `other`, within `radius` [px] of `predicted`, that looks like the surroundings of
// `pixel`: `other_from_photo` is how offsets there [px] follow from offsets here. By normalised
// cross-correlation of 21 x 21 pixels. None: nothing reaches 0.8, two places look alike.
std::variant<MarkProposal, NoProposal> MatchPatch(
    const GreyPatch& patch, const Eigen::Vector2d& pixel, const GreyPatch& other,
    const Eigen::Vector2d& predicted, const Eigen::Matrix2d& other_from_photo, double radius);

// How offsets about the image of a world point change from one photo to another, on a surface
// through the point with this normal.
Eigen::Matrix2d OffsetsBetween(const PosedCamera& photo, const PosedCamera& other,
                               const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

}  // namespace insitu
