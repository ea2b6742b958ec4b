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
  const char* name;
};
constexpr Unit kUnits[] = {{1000, "millimetres"}, {1 / 0.3048, "feet"}};

const Unit* UnitOfRatio(double ratio, double tolerance) {
  for (const Unit& unit : kUnits) {
    if (std::abs(ratio / unit.factor - 1) < tolerance) return &unit;
  }
  return nullptr;
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

std::string Told(const Distance& distance) {
  return "the distance from '" + distance.from->name + "' to '" + distance.to->name + "' is " +
         ShortNumber(distance.constraint->value) + " m, their coordinates are " +
         ShortNumber(distance.surveyed) + " m apart";
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
  const Unit* control_unit = UnitOfRatio(ratio, 0.02);
  if (control_unit && ratios.size() > 1) {
    return {{survey.control_points.front().place,
             "the control points are in " + std::string(control_unit->name) + ": " +
                 Told(distances.front()) + " (" +
                 distances.front().constraint->place.path.filename().string() + ":" +
                 std::to_string(distances.front().constraint->place.line) +
                 "). Expected: coordinates and sigmas in metres"}};
  }
  std::vector<Diagnosis> diagnoses;
  for (size_t i = 0; i < distances.size(); ++i) {
    const Distance& distance = distances[i];
    if (std::abs(distance.surveyed - distance.constraint->value) < 10 * distance.sigma) continue;
    const Unit* points = ratios[i] > 1 ? UnitOfRatio(ratios[i], 0.02) : nullptr;
    const Unit* value = ratios[i] < 1 ? UnitOfRatio(1 / ratios[i], 0.02) : nullptr;
    const std::string question =
        points  ? ": are the control points in " + std::string(points->name) + "?"
        : value ? ": is value_m in " + std::string(value->name) + "?"
                : ".";
    diagnoses.push_back({distance.constraint->place,
                         Told(distance) + question + " Expected: both alike, in metres",
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
  const std::string stand =
      "the cameras stand " + ShortNumber(distance) + " m from the control points";
  std::vector<Diagnosis> diagnoses;
  if (distance > kVeryFarAway || (distance > kFarAway && is_whole)) {
    diagnoses.push_back({place,
                         stand + (is_whole ? ", whose coordinates are whole numbers" : "") +
                             ": are these in millimetres? Expected: metres; photos alone "
                             "cannot tell the scale, a distance in constraints.json can",
                         Kind::kMisfit});
  } else if (distance < kTooClose) {
    diagnoses.push_back(
        {place, stand + ": are their coordinates in kilometres? Expected: metres", Kind::kMisfit});
  }
  if (sigma > kLargeSigma && fit * kMuchBetter < sigma) {
    diagnoses.push_back({place,
                         "the control points have sigmas of " + ShortNumber(sigma) +
                             " m, but fit the photos to " + ShortNumber(fit) +
                             " m: are the sigmas in millimetres? Expected: metres",
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
