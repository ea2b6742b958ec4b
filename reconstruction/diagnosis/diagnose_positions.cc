// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/diagnosis/diagnose_positions.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "calibration/files/wording.h"

namespace insitu {
namespace {

using Kind = Diagnosis::Kind;

constexpr double kFar = 10;          // [sigma]
constexpr double kLeast = 0.05;      // [m], tripods are not surveyed better
constexpr double kSamePlace = 0.02;  // [m]
constexpr double kSameViewPx = 3;    // [px]

// A surveyed centre and the resected one.
struct Pair {
  const CameraPosition* surveyed;
  Eigen::Vector3d resected;
  double tolerance = 0;  // [m]
};

std::vector<Pair> PairsOf(const DiagnosisInput& input, const std::vector<ControlFit>& fits) {
  std::vector<Pair> pairs;
  for (const ControlFit& fit : fits) {
    for (const CameraPosition& surveyed : input.survey.camera_positions) {
      if (surveyed.photo != input.photos[fit.photo]) continue;
      if (surveyed.role == PositionRole::kFree) continue;  // somebody's guess
      const double factor = std::max(1.0, fit.rms_over_sigma);
      const double resected = factor * std::sqrt(fit.center_covariance.trace());
      double control = 0;
      for (const ControlMark& mark : fit.marks) {
        control = std::max(control, mark.control->sigma.maxCoeff());
      }
      pairs.push_back({&surveyed, Center(fit.cam_from_world),
                       kLeast + kFar * std::hypot(resected, control, surveyed.sigma.maxCoeff())});
    }
  }
  return pairs;
}

bool Agrees(const Pair& pair, const Eigen::Vector3d& position) {
  return (position - pair.resected).norm() < pair.tolerance;
}

struct Correction {
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> apply;
  Sentence fault, remedy;
};

std::vector<Correction> Corrections() {
  const auto times = [](double factor) {
    return [factor](const Eigen::Vector3d& p) { return Eigen::Vector3d(factor * p); };
  };
  const Sentence one_unit("positionsUnitDo", "metres in both files");
  return {
      {[](const auto& p) { return Eigen::Vector3d(p.y(), p.x(), p.z()); },
       Sentence("positionsSwapped", "have x and y exchanged"),
       Sentence("positionsSwapDo", "x and y in the same order in both files")},
      {times(0.001), Sentence("positionsMm", "are in millimetres and the control points in metres"),
       one_unit},
      {times(1000),
       Sentence("positionsControlMm", "are in metres and the control points in millimetres"),
       one_unit},
      {times(0.3048), Sentence("positionsFeet", "are in feet and the control points in metres"),
       one_unit},
      {times(1 / 0.3048),
       Sentence("positionsControlFeet", "are in metres and the control points in feet"), one_unit},
  };
}

// Agreement within a hundredth of the distance will do: a unit's scale is far from 1, but it
// scales errors too.
bool AgreesCorrected(const Pair& pair, const Eigen::Vector3d& position, double site_size) {
  return (position - pair.resected).norm() < std::max(pair.tolerance, 0.01 * site_size);
}

// "that of photo 'a' lies 3 m from where ...".
Sentence::Values Off(const Pair& pair) {
  return {{"photo", pair.surveyed->photo},
          {"distance", ShortNumber((pair.surveyed->position - pair.resected).norm())}};
}

std::vector<Diagnosis> AllWrong(const std::vector<Pair>& pairs, double site_size) {
  for (const Correction& correction : Corrections()) {
    if (!std::all_of(pairs.begin(), pairs.end(), [&](const Pair& pair) {
          return AgreesCorrected(pair, correction.apply(pair.surveyed->position), site_size);
        })) {
      continue;
    }
    const Pair& first = pairs.front();
    Sentence::Values values = Off(first);
    values["fault"] = correction.fault.ToJson();
    values["remedy"] = correction.remedy.ToJson();
    return {{first.surveyed->place,
             Sentence("positionsAll",
                      "the camera positions {fault}: that of photo '{photo}' lies {distance} m "
                      "from where the control points put it, corrected it agrees. Expected: "
                      "{remedy}",
                      values)}};
  }
  return {};
}

std::vector<Diagnosis> SomeWrong(const std::vector<Pair>& pairs) {
  std::vector<Diagnosis> diagnoses;
  for (const Pair& pair : pairs) {
    if (Agrees(pair, pair.surveyed->position)) continue;
    const auto other = std::find_if(pairs.begin(), pairs.end(), [&](const Pair& candidate) {
      return &candidate != &pair && Agrees(candidate, pair.surveyed->position);
    });
    const bool is_named = other != pairs.end();
    Sentence::Values values = Off(pair);
    if (!is_named) {
      diagnoses.push_back({pair.surveyed->place,
                           Sentence("positionsOff",
                                    "the camera position of photo '{photo}' lies {distance} m from "
                                    "where the control points put it. Expected: the centre of the "
                                    "lens, in the system of the control points",
                                    values),
                           Kind::kMisfit});
      continue;
    }
    values["other"] = other->surveyed->photo;
    diagnoses.push_back({pair.surveyed->place,
                         Sentence("positionsNamed",
                                  "the camera position of photo '{photo}' lies {distance} m from "
                                  "where the control points put it; did you mean photo '{other}'? "
                                  "Expected: each position under the photo taken there",
                                  values)});
  }
  std::stable_sort(diagnoses.begin(), diagnoses.end(),
                   [](const auto& a, const auto& b) { return a.place.line < b.place.line; });
  return diagnoses;
}

double MedianDistance(const std::vector<ControlFit>& fits) {
  std::vector<double> distances;
  for (const ControlFit& fit : fits) {
    for (const ControlMark& mark : fit.marks) {
      distances.push_back((fit.cam_from_world * mark.control->position).norm());
    }
  }
  std::sort(distances.begin(), distances.end());
  return distances[distances.size() / 2];
}

bool IsSameView(const DiagnosisInput& input, const ControlFit& a, const ControlFit& b) {
  const Eigen::Vector3d step = Center(a.cam_from_world) - Center(b.cam_from_world);
  const double uncertain = std::sqrt((a.center_covariance + b.center_covariance).trace());
  if (step.norm() > std::min(3 * uncertain, kSamePlace + uncertain)) return false;
  return std::all_of(a.marks.begin(), a.marks.end(), [&](const ControlMark& mark) {
    const auto other = input.cameras[b.photo].Project(b.cam_from_world * mark.control->position);
    return other && (*other - mark.mark->pixel).norm() < kSameViewPx;
  });
}

std::vector<Diagnosis> SameViews(const DiagnosisInput& input, const std::vector<ControlFit>& fits) {
  std::vector<Diagnosis> diagnoses;
  for (size_t i = 0; i < fits.size(); ++i) {
    for (size_t j = i + 1; j < fits.size(); ++j) {
      if (!IsSameView(input, fits[i], fits[j])) continue;
      diagnoses.push_back(
          {fits[j].marks.front().mark->place,
           Sentence("positionsSameView",
                    "photos '{one}' and '{other}' have one exterior orientation: is one a copy of "
                    "the other? Expected: each photograph once, and others from well apart",
                    {{"one", input.photos[fits[i].photo]}, {"other", input.photos[fits[j].photo]}}),
           Kind::kQuestion});
    }
  }
  return diagnoses;
}

}  // namespace

std::vector<Diagnosis> DiagnosePositions(const DiagnosisInput& input,
                                         const std::vector<ControlFit>& fits) {
  std::vector<Diagnosis> diagnoses = SameViews(input, fits);
  const std::vector<Pair> pairs = PairsOf(input, fits);
  const bool all_agree = std::all_of(pairs.begin(), pairs.end(), [](const Pair& pair) {
    return Agrees(pair, pair.surveyed->position);
  });
  if (all_agree) return diagnoses;
  std::vector<Diagnosis> wrong = AllWrong(pairs, MedianDistance(fits));
  if (wrong.empty()) wrong = SomeWrong(pairs);
  diagnoses.insert(diagnoses.end(), wrong.begin(), wrong.end());
  return diagnoses;
}

}  // namespace insitu
