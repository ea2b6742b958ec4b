// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_sun.h"

#include <algorithm>
#include <cmath>

#include "calibration/algebra/decompositions.h"
#include "reconstruction/adjustment/adjusted_scene.h"
#include "reconstruction/geometry/omega_phi_kappa.h"

namespace insitu {
namespace {

// The larger of a direction's two sigmas [deg].
double SigmaInDegrees(const Direction& direction) {
  const double variance = EigenOfSymmetric(direction.covariance).values[2];
  return std::sqrt(std::max(0.0, variance)) / kDegree;
}

Json::Value EphemerisOf(const SunPosition& measured, const LiveSite& site) {
  if (!site.julian_day) return {};
  const SunPosition sun = PositionOfSun(*site.julian_day, site.place);
  const ClockError clock = FindClockError(measured, *site.julian_day, site.place);
  Json::Value ephemeris;
  ephemeris["azimuth_deg"] = sun.azimuth / kDegree;
  ephemeris["elevation_deg"] = sun.elevation / kDegree;
  ephemeris["difference_deg"] = AngleBetween(measured, sun) / kDegree;
  ephemeris["clock_minutes"] = clock.minutes;
  ephemeris["clock_difference_deg"] = clock.remaining / kDegree;
  return ephemeris;
}

}  // namespace

Json::Value LiveSun(const Survey& survey, const SolvedSurvey& solved,
                    const std::optional<LiveSite>& site) {
  const SurveyNetwork& survey_network = solved.survey_network;
  if (!survey_network.sun) return {};
  const Direction sun = AdjustedDirection(survey_network, solved.solution, *survey_network.sun);
  const Direction zenith =
      AdjustedDirection(survey_network, solved.solution, *survey_network.zenith);
  const SunPosition measured = PositionOfDirection(
      sun.unit, site ? site->true_north : Eigen::Vector3d::UnitY(), zenith.unit);
  Json::Value told;
  told["azimuth_deg"] = measured.azimuth / kDegree;
  told["elevation_deg"] = measured.elevation / kDegree;
  told["sigma_deg"] = SigmaInDegrees(sun);
  told["pairs"] = static_cast<Json::UInt>(survey.sun_pairs.size());
  told["ephemeris"] = site ? EphemerisOf(measured, *site) : Json::Value();
  return told;
}

Json::Value LiveZenith(const Survey& survey, const SolvedSurvey& solved) {
  if (survey.zenith_pairs.empty()) return {};
  const Direction zenith =
      AdjustedDirection(solved.survey_network, solved.solution, *solved.survey_network.zenith);
  Json::Value told;
  told["tilt_deg"] = std::atan2(zenith.unit.head<2>().norm(), zenith.unit.z()) / kDegree;
  told["sigma_deg"] = SigmaInDegrees(zenith);
  told["pairs"] = static_cast<Json::UInt>(survey.zenith_pairs.size());
  return told;
}

}  // namespace insitu
