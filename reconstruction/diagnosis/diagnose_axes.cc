// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/diagnosis/diagnose_axes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "calibration/files/wording.h"
#include "reconstruction/diagnosis/control_fit.h"

namespace insitu {
namespace {

constexpr double kGoodFit = 5;       // [sigma]
constexpr double kImprovement = 4;   // of the RMS, by which an explanation must be better
constexpr double kSignificant = 20;  // of the weighted square sum, between two explanations
constexpr double kUpright = -0.2;    // mean z of the upward axes; some photos look up or down
constexpr size_t kMostPhotos = 8;    // enough evidence, and quick with hundreds

using MovedPoint = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;
using MovedPixel = std::function<Eigen::Vector2d(const Eigen::Vector2d&, const Camera&)>;

// The correction that would undo a fault.
struct Hypothesis {
  Sentence correction;  // "with x and y of the control points exchanged"
  Sentence fault;       // what is wrong, if that correction helps
  Sentence remedy;
  MovedPoint point = {};  // one of the two is set
  MovedPixel pixel = {};
};

struct Explanation {
  const Hypothesis* hypothesis = nullptr;  // of the list that is tried
  double rms_px = 0, square_sum = 0, redundancy = 0;
  double up = 0;  // mean z of the cameras' upward axes; photographers seldom stand on their heads
};

std::vector<Hypothesis> MarkHypotheses() {
  return {
      {Sentence("axesMarksSwap", "with x and y of the marks exchanged"),
       Sentence("axesMarksSwapped", "the marks' x and y are exchanged"),
       Sentence("axesMarksSwapDo",
                "exchange the columns x and y: x counts to the right, y downwards"),
       {},
       [](const auto& p, const Camera&) { return Eigen::Vector2d(p.y(), p.x()); }},
      {Sentence("axesMarksTop", "with y of the marks counted from the top"),
       Sentence("axesMarksBottom", "the marks' y is counted from the bottom"),
       Sentence("axesMarksTopDo",
                "write height - 1 - y for y: (0, 0) is the centre of the top-left pixel"),
       {},
       [](const auto& p, const Camera& c) {
         return Eigen::Vector2d(p.x(), c.height() - 1 - p.y());
       }},
      {Sentence("axesMarksRight", "with the marks turned to the right by 90 degrees"),
       Sentence("axesMarksTurned", "the marks were measured on a turned copy of the photograph"),
       Sentence("axesMarksTurnDo",
                "measure in the photograph's own pixel grid, without its EXIF orientation"),
       {},
       [](const auto& p, const Camera& c) {
         return Eigen::Vector2d(c.width() - 1 - p.y(), p.x());
       }},
      {Sentence("axesMarksLeft", "with the marks turned to the left by 90 degrees"),
       Sentence("axesMarksTurned", "the marks were measured on a turned copy of the photograph"),
       Sentence("axesMarksTurnDo",
                "measure in the photograph's own pixel grid, without its EXIF orientation"),
       {},
       [](const auto& p, const Camera& c) {
         return Eigen::Vector2d(p.y(), c.height() - 1 - p.x());
       }},
  };
}

void AddScales(const Sentence& axes, const Eigen::Vector3d& mask,
               std::vector<Hypothesis>* hypotheses) {
  struct Unit {
    double factor;
    Sentence name;
  };
  const Unit units[] = {{0.001, Sentence("unitMillimetres", "millimetres")},
                        {0.3048, Sentence("unitFeet", "feet")},
                        {1000, Sentence("unitKilometres", "kilometres")}};
  for (const Unit& unit : units) {
    const Eigen::Vector3d factors = (mask * (unit.factor - 1)).array() + 1;
    hypotheses->push_back(
        {Sentence("axesScale", "with {axes} of the control points times {factor}",
                  {{"axes", axes.ToJson()}, {"factor", ShortNumber(unit.factor)}}),
         Sentence("axesUnits",
                  "{axes} of the control points in {unit}, the rest in metres: the units are mixed",
                  {{"axes", axes.ToJson()}, {"unit", unit.name.ToJson()}}),
         Sentence("axesUnitsDo", "give all coordinates in metres"),
         [factors](const auto& p) { return factors.cwiseProduct(p).eval(); }});
  }
}

std::vector<Hypothesis> ControlHypotheses() {
  std::vector<Hypothesis> hypotheses = {
      {Sentence("axesControlSwap", "with x and y of the control points exchanged"),
       Sentence(
           "axesControlMirrored",
           "the control points are mirrored (left-handed): their x and y are exchanged, or an axis "
           "counts backwards"),
       Sentence("axesControlSwapDo",
                "exchange the columns x and y if northing stands before easting; else change the "
                "sign of "
                "the axis that counts backwards, so that x points east, y north and z up"),
       [](const auto& p) { return Eigen::Vector3d(p.y(), p.x(), p.z()); }},
      {Sentence("axesControlUp", "with z of the control points counted upwards"),
       Sentence("axesControlDown",
                "the control points are mirrored (left-handed): their z counts downwards"),
       Sentence("axesControlUpDo", "change the sign of z: heights, not depths"),
       [](const auto& p) { return Eigen::Vector3d(p.x(), p.y(), -p.z()); }},
  };
  AddScales(Sentence::Verbatim("z"), {0, 0, 1}, &hypotheses);
  AddScales(Sentence("axesXAndY", "x and y"), {1, 1, 0}, &hypotheses);
  AddScales(Sentence::Verbatim("x"), {1, 0, 0}, &hypotheses);
  AddScales(Sentence::Verbatim("y"), {0, 1, 0}, &hypotheses);
  return hypotheses;
}

// The commoner ones first: that decides between those that explain alike, as marks counted from the
// bottom and heights counted downwards do.
std::vector<Hypothesis> Hypotheses(const Survey& survey) {
  const auto& points = survey.control_points;
  const bool are_depths = std::all_of(points.begin(), points.end(),
                                      [](const auto& point) { return point.position.z() < 0; });
  std::vector<Hypothesis> marks = MarkHypotheses(), control = ControlHypotheses();
  if (are_depths) marks.swap(control);
  for (Hypothesis& hypothesis : control) marks.push_back(std::move(hypothesis));
  return marks;
}

Survey Corrected(const DiagnosisInput& input, const Hypothesis& hypothesis) {
  Survey survey = input.survey;
  if (hypothesis.point) {
    for (ControlPoint& point : survey.control_points) {
      point.position = hypothesis.point(point.position);
    }
  }
  if (!hypothesis.pixel) return survey;
  for (ImageObservation& mark : survey.observations) {
    const auto photo = std::find(input.photos.begin(), input.photos.end(), mark.photo);
    INSITU_CHECK(photo != input.photos.end());
    mark.pixel = hypothesis.pixel(mark.pixel, input.cameras[photo - input.photos.begin()]);
  }
  return survey;
}

std::vector<ControlFit> FitEach(const DiagnosisInput& input, const Survey& survey,
                                const std::vector<size_t>& photos) {
  std::vector<ControlFit> fits;
  for (const size_t photo : photos) {
    const auto fit = FitControl(survey, input.photos, input.cameras, photo);
    if (fit) fits.push_back(*fit);
  }
  return fits;
}

Explanation Summary(const Hypothesis& hypothesis, const std::vector<ControlFit>& fits) {
  Explanation summary{&hypothesis};
  double squares = 0, marks = 0;
  for (const ControlFit& fit : fits) {
    const auto count = static_cast<double>(fit.marks.size());
    squares += count * fit.rms_px * fit.rms_px;
    marks += count;
    summary.square_sum += (2 * count - 6) * fit.rms_over_sigma * fit.rms_over_sigma;
    summary.redundancy += 2 * count - 6;
    const Eigen::Vector3d up = fit.cam_from_world.rotation.conjugate() * -Eigen::Vector3d::UnitY();
    summary.up += up.z() / static_cast<double>(fits.size());
  }
  summary.rms_px = std::sqrt(squares / marks);
  return summary;
}

// What a hypothesis is tried on, and how that fits as given: corrected control concerns all photos,
// corrected marks the bad ones.
struct Trial {
  std::vector<size_t> photos;
  std::optional<double> rms_px;  // nullopt: some fit no camera position at all
};

Trial TrialOf(const DiagnosisInput& input, const std::vector<size_t>& bad, bool is_of_control) {
  Trial trial{bad, {}};
  for (size_t i = 0; is_of_control && i < input.photos.size(); ++i) {
    const bool is_bad = std::find(bad.begin(), bad.end(), i) != bad.end();
    const bool is_judged = ControlMarksOn(input.survey, input.photos[i]).size() >= 4;
    if (!is_bad && is_judged) trial.photos.push_back(i);
  }
  if (trial.photos.size() > kMostPhotos) trial.photos.resize(kMostPhotos);
  const std::vector<ControlFit> fits = FitEach(input, input.survey, trial.photos);
  if (fits.size() == trial.photos.size()) trial.rms_px = Summary({}, fits).rms_px;
  return trial;
}

std::optional<Explanation> Try(const DiagnosisInput& input, const Trial& trial,
                               const Hypothesis& hypothesis) {
  const Survey corrected = Corrected(input, hypothesis);
  const std::vector<ControlFit> fits = FitEach(input, corrected, trial.photos);
  const auto good = std::count_if(fits.begin(), fits.end(), [](const ControlFit& fit) {
    return fit.rms_over_sigma < kGoodFit;
  });
  if (fits.empty() || 4 * static_cast<size_t>(good) < 3 * trial.photos.size()) return std::nullopt;
  const Explanation explanation = Summary(hypothesis, fits);
  if (trial.rms_px && explanation.rms_px * kImprovement > *trial.rms_px) return std::nullopt;
  return explanation;
}

// Those that are not significantly worse than the best; upright cameras first.
std::vector<Explanation> Likeliest(std::vector<Explanation> explanations) {
  if (explanations.empty()) return {};
  const Explanation best =
      *std::min_element(explanations.begin(), explanations.end(),
                        [](const auto& a, const auto& b) { return a.square_sum < b.square_sum; });
  const double unit = std::max(best.square_sum / best.redundancy, 1.0);
  std::erase_if(explanations, [&](const Explanation& other) {
    return other.square_sum - best.square_sum > kSignificant * unit;
  });
  std::stable_partition(explanations.begin(), explanations.end(),
                        [](const auto& explanation) { return explanation.up > kUpright; });
  return explanations;
}

FilePlace PlaceOf(const DiagnosisInput& input, const Hypothesis& hypothesis,
                  const std::vector<size_t>& bad) {
  if (hypothesis.point) return input.survey.control_points.front().place;
  return ControlMarksOn(input.survey, input.photos[bad.front()]).front().mark->place;
}

Sentence Told(const DiagnosisInput& input, const Trial& trial, const Explanation& explanation) {
  std::vector<std::string> names;
  for (const size_t photo : trial.photos) names.push_back(input.photos[photo]);
  const Hypothesis& hypothesis = *explanation.hypothesis;
  Sentence::Values values = {{"fault", hypothesis.fault.ToJson()},
                             {"photos", SaidPhotos(names)},
                             {"rms", ShortNumber(explanation.rms_px)},
                             {"correction", hypothesis.correction.ToJson()},
                             {"remedy", hypothesis.remedy.ToJson()}};
  if (!trial.rms_px) {
    return Sentence("axesNoFit",
                    "{fault}. The marks of control points on {photos} fit no camera position as "
                    "given, to {rms} px {correction}. Expected: {remedy}",
                    values);
  }
  values["given"] = ShortNumber(*trial.rms_px);
  return Sentence("axesFit",
                  "{fault}. The marks of control points on {photos} fit to {given} px (RMS) as "
                  "given, to {rms} px {correction}. Expected: {remedy}",
                  values);
}

}  // namespace

std::vector<Diagnosis> DiagnoseAxes(const DiagnosisInput& input, const std::vector<size_t>& bad) {
  const Trial of_marks = TrialOf(input, bad, false), of_control = TrialOf(input, bad, true);
  const std::vector<Hypothesis> hypotheses = Hypotheses(input.survey);
  std::vector<Explanation> explanations;
  for (const Hypothesis& hypothesis : hypotheses) {
    const auto found = Try(input, hypothesis.point ? of_control : of_marks, hypothesis);
    if (found) explanations.push_back(*found);
  }
  explanations = Likeliest(std::move(explanations));
  if (explanations.empty()) return {};
  const Explanation& first = explanations.front();
  const Trial& trial = first.hypothesis->point ? of_control : of_marks;
  Diagnosis diagnosis{PlaceOf(input, *first.hypothesis, bad), Told(input, trial, first)};
  for (size_t i = 1; i < explanations.size(); ++i) {  // as good, but less common
    if (explanations[i].up < kUpright) continue;
    diagnosis.message = Sentence("axesOr", "{first}; or {other}",
                                 {{"first", diagnosis.message.ToJson()},
                                  {"other", explanations[i].hypothesis->fault.ToJson()}});
  }
  return {diagnosis};
}

}  // namespace insitu
