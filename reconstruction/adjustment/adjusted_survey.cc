// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/adjusted_survey.h"

#include "calibration/files/wording.h"

namespace insitu {

std::string Adjustment::BriefReport() const {
  std::string text = Formatted(
      "%zu photos, %zu points, %zu polygons: %d observations, %d unknowns, redundancy %d\n",
      poses.size(), points.size(), scene.polygons.size(), observations, unknowns, redundancy);
  text += Formatted("sigma0 %.3f (1 expected; p of the global test %.3f), %d iterations\n", sigma0,
                    chi_square_p, iterations);
  for (const AdjustedPose& pose : poses) {
    const Eigen::Vector3d sigma = pose.covariance.diagonal().tail<3>().cwiseSqrt();
    text += Formatted("photo %s: %d points, RMS %.2f px, camera to %.1f mm\n", pose.photo.c_str(),
                      pose.points, pose.rms_px, 1000 * sigma.norm());
  }
  if (check.empty()) {
    text += "no check points: accuracy not verified\n";
    if (!left_out.empty()) {
      text += Formatted("leaving out one control point at a time: RMS %.2f of the expected sigma\n",
                        left_out_rms_over_sigma);
    }
  } else {
    text += Formatted("check points: %zu, RMS %.2f of their combined sigma\n", check.size(),
                      check_rms_over_sigma);
  }
  for (const std::string& warning : warnings) text += "warning: " + warning + "\n";
  if (datum_defect > 0) text += "warning: the datum is " + datum + "\n";
  return text;
}

}  // namespace insitu
