// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/adjusted_survey.h"

#include <numbers>

#include "calibration/files/wording.h"

namespace insitu {
namespace {

constexpr double kUsualBuilding = 20;  // [m]

}  // namespace

std::string Adjustment::DatumWorthInWords(double building) const {
  constexpr double kDegrees = 180 / std::numbers::pi;
  const DatumWorth& worth = datum_worth;
  const auto share = [&](double part) { return ShortNumber(100 * part) + " %"; };
  std::string text = worth.scale ? "scale to " + share(*worth.scale) : "no scale";
  text += worth.tilt ? ", plumb to " + ShortNumber(*worth.tilt * kDegrees) + " deg (" +
                           share(*worth.tilt) + ")"
                     : ", no plumb";
  text += worth.heading ? ", north to " + ShortNumber(*worth.heading * kDegrees) + " deg (" +
                              share(*worth.heading) + ")"
                        : ", no north";
  if (!has_scale) return text + "; in per cent of a building's size";
  text += worth.height ? ", height to " + ShortNumber(*worth.height) + " m (" +
                             share(*worth.height / building) + ")"
                       : ", no height";
  return text + "; in per cent of a building of " + ShortNumber(building) + " m";
}

std::string Adjustment::BriefReport() const {
  std::string text = Formatted(
      "%zu photos, %zu points, %zu polygons: %d observations, %d unknowns, redundancy %d\n",
      poses.size(), points.size(), scene.polygons.size(), observations, unknowns, redundancy);
  text += Formatted("sigma0 %.3f (1 expected; p of the global test %.3f), %d iterations\n", sigma0,
                    chi_square_p, iterations);
  for (const AdjustedPose& pose : poses) {
    const Eigen::Vector3d sigma = pose.covariance.diagonal().tail<3>().cwiseSqrt();
    text += Formatted("photo %s: %d points, RMS %.2f px, camera to ", pose.photo.c_str(),
                      pose.points, pose.rms_px);
    text += has_scale ? Formatted("%.1f mm\n", 1000 * sigma.norm())
                      : Formatted("%.2g of the arbitrary unit\n", sigma.norm());
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
  if (control.size() < 3) text += "datum: " + DatumWorthInWords(kUsualBuilding) + "\n";
  for (const std::string& warning : warnings) text += "warning: " + warning + "\n";
  if (datum_defect > 0) text += "warning: the datum is " + datum + "\n";
  return text;
}

}  // namespace insitu
