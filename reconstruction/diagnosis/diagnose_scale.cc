// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/diagnosis/diagnose_scale.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "calibration/files/wording.h"

namespace insitu {
namespace {

using Kind = Diagnosis::Kind;

constexpr double kFarAway = 2000;       // [m], of the camera: unusual
constexpr double kVeryFarAway = 10000;  // [m]: hardly ever
constexpr double kTooClose = 0.05;      // [m]
constexpr double kLargeSigma = 0.5;     // [m], of control that shows in photographs
constexpr double kMuchBetter = 20;      // fit of the photos than the sigmas of control

// A unit that is taken for metres: what was written is `factor` metres' worth.
struct Unit {
  double factor;
  Sentence name;
};

std::optional<Unit> UnitOfRatio(double ratio, double tolerance) {
  for (const Unit& unit : {Unit{1000, Sentence("unitMillimetres", "millimetres")},
                           Unit{1 / 0.3048, Sentence("unitFeet", "feet")}}) {
    if (std::abs(ratio / unit.factor - 1) < tolerance) return unit;
  }
  return std::nullopt;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// A measured distance between two surveyed points.
struct Distance {
  const GeometricConstraint* constraint;
  const ControlPoint *from, *to;
  double surveyed = 0, sigma = 0;  // [m]
};

std::vector<Distance> DistancesOf(const Survey& survey) {
  std::map<std::string, const ControlPoint*> points;
  for (const ControlPoint& point : survey.control_points) points[point.name] = &point;
  std::vector<Distance> distances;
  for (const GeometricConstraint& constraint : survey.constraints) {
    if (constraint.kind != GeometricConstraint::Kind::kDistance) continue;
    const auto from = points.find(constraint.points[0]), to = points.find(constraint.points[1]);
    if (from == points.end() || to == points.end()) continue;
    const Eigen::Vector3d &a = from->second->sigma, &b = to->second->sigma;
    distances.push_back({&constraint, from->second, to->second,
                         (from->second->position - to->second->position).norm(),
                         std::hypot(constraint.sigma, a.maxCoeff(), b.maxCoeff())});
  }
  return distances;
}

Json::Value Told(const Distance& distance) {
  return Sentence("scaleApart",
                  "the distance from '{from}' to '{to}' is {value} m, their coordinates are "
                  "{surveyed} m apart",
                  {{"from", distance.from->name},
                   {"to", distance.to->name},
                   {"value", ShortNumber(distance.constraint->value)},
                   {"surveyed", ShortNumber(distance.surveyed)}})
      .ToJson();
}

Sentence Question(const Distance& distance, const std::optional<Unit>& points,
                  const std::optional<Unit>& value) {
  Sentence::Values values = {{"apart", Told(distance)}};
  if (!points && !value) {
    return Sentence("scaleDiffer", "{apart}. Expected: both alike, in metres", values);
  }
  values["unit"] = (points ? points : value)->name.ToJson();
  return points
             ? Sentence("scalePointsUnit",
                        "{apart}: are the control points in {unit}? Expected: both alike, in "
                        "metres",
                        values)
             : Sentence("scaleValueUnit",
                        "{apart}: is value_m in {unit}? Expected: both alike, in metres", values);
}

// Measured distances against coordinates: all by the same factor, or one alone. Millimetres and
// feet are common, kilometres are not: what is longer is at fault.
std::vector<Diagnosis> AgainstDistances(const Survey& survey) {
  const std::vector<Distance> distances = DistancesOf(survey);
  std::vector<double> ratios;
  for (const Distance& distance : distances) {
    ratios.push_back(distance.surveyed / distance.constraint->value);
  }
  if (ratios.empty()) return {};
  const double ratio = Median(ratios);
  const std::optional<Unit> control_unit = UnitOfRatio(ratio, 0.02);
  if (control_unit && ratios.size() > 1) {
    const FilePlace& place = distances.front().constraint->place;
    return {{survey.control_points.front().place,
             Sentence("scaleControl",
                      "the control points are in {unit}: {apart} ({file}:{line}). Expected: "
                      "coordinates and sigmas in metres",
                      {{"unit", control_unit->name.ToJson()},
                       {"apart", Told(distances.front())},
                       {"file", place.path.filename().string()},
                       {"line", place.line}})}};
  }
  std::vector<Diagnosis> diagnoses;
  for (size_t i = 0; i < distances.size(); ++i) {
    const Distance& distance = distances[i];
    if (std::abs(distance.surveyed - distance.constraint->value) < 10 * distance.sigma) continue;
    std::optional<Unit> points, value;
    if (ratios[i] > 1) points = UnitOfRatio(ratios[i], 0.02);
    if (ratios[i] < 1) value = UnitOfRatio(1 / ratios[i], 0.02);
    diagnoses.push_back({distance.constraint->place, Question(distance, points, value),
                         points || value ? Kind::kFault : Kind::kMisfit});
  }
  return diagnoses;
}

// All coordinates whole numbers, as millimetres are written.
bool AreWholeNumbers(const Survey& survey) {
  const auto& points = survey.control_points;
  return points.size() > 3 && std::all_of(points.begin(), points.end(), [](const auto& point) {
           return point.position == point.position.array().round().matrix();
         });
}

// What photos that fit say about control: how far the cameras stand [m], how well points fit [m].
struct Plausibility {
  double distance = 0, fit = 0, sigma = 0;  // medians
};

Plausibility PlausibilityOf(const DiagnosisInput& input, const std::vector<ControlFit>& fits) {
  std::vector<double> distances, errors, sigmas;
  for (const ControlFit& fit : fits) {
    for (const ControlMark& mark : fit.marks) {
      const double distance = (fit.cam_from_world * mark.control->position).norm();
      distances.push_back(distance);
      errors.push_back(distance * fit.rms_px / input.cameras[fit.photo].focal_px());
      sigmas.push_back(mark.control->sigma.maxCoeff());
    }
  }
  return {Median(distances), Median(errors), Median(sigmas)};
}

// A wrong unit is no contradiction, but the likely cause where the survey turns out unusable.
std::vector<Diagnosis> Implausible(const DiagnosisInput& input,
                                   const std::vector<ControlFit>& fits) {
  const FilePlace place = input.survey.control_points.front().place;
  const auto [distance, fit, sigma] = PlausibilityOf(input, fits);
  const bool is_whole = AreWholeNumbers(input.survey);
  const Sentence::Values values = {{"distance", ShortNumber(distance)}};
  std::vector<Diagnosis> diagnoses;
  if (is_whole && distance > kFarAway) {
    diagnoses.push_back(
        {place,
         Sentence("scaleWhole",
                  "the cameras stand {distance} m from the control points, whose coordinates are "
                  "whole numbers: are these in millimetres? Expected: metres; photos alone cannot "
                  "tell the scale, a distance in constraints.json can",
                  values),
         Kind::kMisfit});
  } else if (distance > kVeryFarAway) {
    diagnoses.push_back(
        {place,
         Sentence("scaleFar",
                  "the cameras stand {distance} m from the control points: are these in "
                  "millimetres? Expected: metres; photos alone cannot tell the scale, a distance "
                  "in constraints.json can",
                  values),
         Kind::kMisfit});
  } else if (distance < kTooClose) {
    diagnoses.push_back(
        {place,
         Sentence("scaleClose",
                  "the cameras stand {distance} m from the control points: are their coordinates "
                  "in kilometres? Expected: metres",
                  values),
         Kind::kMisfit});
  }
  if (sigma > kLargeSigma && fit * kMuchBetter < sigma) {
    diagnoses.push_back(
        {place,
         Sentence("scaleSigmas",
                  "the control points have sigmas of {sigma} m, but fit the photos to {fit} m: are "
                  "the sigmas in millimetres? Expected: metres",
                  {{"sigma", ShortNumber(sigma)}, {"fit", ShortNumber(fit)}}),
         Kind::kQuestion});
  }
  return diagnoses;
}

}  // namespace

std::vector<Diagnosis> DiagnoseScale(const DiagnosisInput& input,
                                     const std::vector<ControlFit>& fits) {
  std::vector<Diagnosis> diagnoses = AgainstDistances(input.survey);
  if (fits.empty() || !diagnoses.empty()) return diagnoses;
  return Implausible(input, fits);
}

}  // namespace insitu
