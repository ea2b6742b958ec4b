// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_solution.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "calibration/files/error_at.h"
#include "calibration/files/json_file.h"
#include "reconstruction/adjustment/adjusted_observations.h"
#include "reconstruction/adjustment/adjusted_scene.h"
#include "reconstruction/adjustment/adjusted_unknowns.h"
#include "reconstruction/diagnosis/survey_diagnosis.h"
#include "reconstruction/live/determined_part.h"
#include "renderer/live/live_polygons.h"
#include "renderer/live/live_predictions.h"
#include "renderer/live/live_sun.h"

namespace insitu {
namespace {

Json::Value ToPage(const LeftOut& what) {
  Json::Value told;
  told["kind"] = Word(what.kind);
  told["name"] = what.name;
  if (!what.photo.empty()) told["photo"] = what.photo;
  what.reason.SayIn(&told, "reason");
  told["file"] = what.place.path.string();
  told["line"] = what.place.line;
  return told;
}

// The first mark at a diagnosis' place tells which photo and point it is about.
class DiagnosisTeller {
 public:
  explicit DiagnosisTeller(const Survey& survey) : survey_(survey) {}

  Json::Value Tell(const char* kind, const Sentence& text, const FilePlace& place) const {
    Json::Value told;
    told["kind"] = kind;
    text.SayIn(&told, "text");
    told["file"] = place.path.string();
    told["line"] = place.line;
    AddSubject(place, &told);
    return told;
  }

 private:
  static bool IsAt(const FilePlace& a, const FilePlace& b) {
    return a.line == b.line && a.path == b.path;
  }

  void AddSubject(const FilePlace& place, Json::Value* told) const {
    if (place.line <= 0) return;
    for (const ImageObservation& mark : survey_.observations) {
      if (!IsAt(mark.place, place)) continue;
      (*told)["photo"] = mark.photo;
      (*told)["point"] = mark.point;
      return;
    }
    for (const ControlPoint& point : survey_.control_points) {
      if (IsAt(point.place, place)) (*told)["point"] = point.name;
    }
    for (const CameraPosition& position : survey_.camera_positions) {
      if (IsAt(position.place, place)) (*told)["photo"] = position.photo;
    }
  }

  const Survey& survey_;
};

const char* WordOf(Diagnosis::Kind kind) {
  switch (kind) {
    case Diagnosis::Kind::kFault:
      return "fault";
    case Diagnosis::Kind::kMisfit:
      return "misfit";
    case Diagnosis::Kind::kQuestion:
      break;
  }
  return "question";
}

// The place of an error that says "file:line: message".
FilePlace PlaceOf(const InputError& error) {
  const std::string text = error.what();
  const size_t colon = text.find(": ");
  if (colon == std::string::npos) return {};
  const std::string place = text.substr(0, colon);
  const size_t at = place.rfind(':');
  const bool has_line = at != std::string::npos && at + 1 < place.size() &&
                        std::all_of(place.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                                    place.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!has_line) return {place, 0};
  return {place.substr(0, at), std::stoi(place.substr(at + 1))};
}

Json::Value OrNull(const std::optional<double>& value) {
  return value ? Json::Value(*value) : Json::Value();
}

// Both components of each mark in one row: the largest |w|, the smallest redundancy.
Json::Value MarksToPage(const SolvedSurvey& solved, double significance) {
  Json::Value marks = Json::arrayValue;
  const auto rows = AdjustedObservations(solved.survey_network, solved.solution, significance);
  for (size_t i = 0; i + 1 < rows.size(); ++i) {
    const ObservationResidual &x = rows[i], &y = rows[i + 1];
    if (x.kind != ObservationKind::kImage || x.axis != 0 || x.is_tie_point) continue;
    Json::Value mark;
    mark["photo"] = x.photo;
    mark["point"] = x.subject;
    mark["vx"] = x.residual;
    mark["vy"] = y.residual;
    const bool is_x = !y.w || (x.w && std::abs(*x.w) >= std::abs(*y.w));
    mark["w"] = OrNull(is_x ? x.w : y.w);
    mark["r"] = std::min(x.redundancy, y.redundancy);
    mark["detectable"] = !x.detectable || !y.detectable
                             ? Json::Value()
                             : Json::Value(std::max(*x.detectable, *y.detectable));
    marks.append(std::move(mark));
  }
  return marks;
}

Json::Value ControlToPage(const Adjustment& adjustment) {
  Json::Value control = Json::arrayValue;
  const auto add = [&](const std::vector<PointComparison>& points, const char* role) {
    for (const PointComparison& point : points) {
      Json::Value told;
      told["name"] = point.name;
      told["difference"] = ToJson(point.difference);
      told["sigma"] = ToJson(point.sigma);
      told["role"] = role;
      control.append(std::move(told));
    }
  };
  add(adjustment.control, "control");
  add(adjustment.check, "check");
  return control;
}

// Builds one message.
class Solver {
 public:
  Solver(const LiveInput& input, const SceneFound& found) : input_(input), found_(found) {}

  LiveResult Solve() {
    const auto start = std::chrono::steady_clock::now();
    Json::Value& message = result_.message;
    for (const char* key : {"photos", "points", "polygons"}) message[key] = Json::objectValue;
    for (const char* key : {"marks", "control", "left_out", "diagnoses"}) {
      message[key] = Json::arrayValue;
    }
    for (const char* key : {"failed", "sun", "zenith", "p"}) message[key] = Json::Value();
    for (const char* key : {"redundancy", "observations", "unknowns"}) message[key] = 0;
    message["sigma0"] = 1.0;
    message["converged"] = true;
    TakePhotos();
    SolvePart();
    if (result_.solved) TakeScene();
    if (found_) found_(result_.scene);
    TellLeftOut();
    TellDiagnoses();
    if (result_.solved) TellSolution();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    message["seconds"] = taken.count();
    return std::move(result_);
  }

 private:
  // What is said of photos without lens is said once, not at each of their marks.
  void TakePhotos() {
    survey_ = input_.survey;
    std::set<std::string> blind;
    for (const LivePhoto& photo : input_.photos) {
      if (photo.camera) {
        names_.push_back(photo.name);
        cameras_.push_back(*photo.camera);
        lenses_.push_back(photo.lens);
        continue;
      }
      blind.insert(photo.name);
      LeaveOutPhoto(photo.name, photo.no_lens_because, FileOfObservations(input_.survey));
      result_.message["photos"][photo.name]["needs_lens"] = true;
    }
    const auto is_blind = [&](const auto& row) { return blind.contains(row.photo); };
    std::erase_if(survey_.observations, is_blind);
    std::erase_if(survey_.edges, is_blind);
    std::erase_if(survey_.camera_positions, is_blind);
    if (!blind.empty()) survey_.tie_points.reset();
  }

  void LeaveOutPhoto(const std::string& name, const Sentence& reason, const FilePlace& place) {
    result_.message["left_out"].append(
        ToPage(LeftOut{LeftOut::Kind::kPhoto, name, "", reason, place}));
    Json::Value& photo = result_.message["photos"][name];
    photo["oriented"] = false;
    reason.SayIn(&photo, "why");
  }

  // What start values seemed to determine and the adjustment does not, as a point that only a
  // plane seen edge-on holds, is left out too, so that the rest is told.
  void SolvePart() {
    constexpr int kMostTrials = 8;
    for (int trial = 1;; ++trial) {
      part_ = FindDeterminedPart(survey_, names_, cameras_, input_.last_poses, input_.options);
      if (part_.photos.empty()) return;
      std::vector<PhotoLens> lenses;
      for (const size_t index : part_.indices) lenses.push_back(lenses_[index]);
      try {
        result_.solved = std::make_shared<SolvedSurvey>(
            SolveSurvey(part_.survey, part_.start, lenses, input_.options));
        return;
      } catch (const UnsolvableSurvey& error) {
        if (trial < kMostTrials && (EraseMarksOf(error) || ErasePolygonsOf(error))) continue;
        TellFailure(error);
        return;
      } catch (const InputError& error) {
        TellFailure(error);
        return;
      }
    }
  }

  // Whether there were any.
  bool EraseMarksOf(const UnsolvableSurvey& error) {
    const std::set<std::string> points(error.points.begin(), error.points.end());
    const bool is_behind = !error.photo.empty();
    return std::erase_if(survey_.observations, [&](const ImageObservation& mark) {
             if (!points.contains(mark.point)) return false;
             if (is_behind && mark.photo != error.photo) return false;
             unsolvable_.push_back(
                 {LeftOut::Kind::kObservation, mark.point, mark.photo,
                  is_behind ? Sentence("markBehind", "its point would lie behind the photo")
                            : Sentence("markWeak",
                                       "the marks do not determine its point: "
                                       "one more photograph, from another side"),
                  mark.place, is_behind});
             return true;
           }) > 0;
  }

  // Of points that planes alone were to hold.
  bool ErasePolygonsOf(const UnsolvableSurvey& error) {
    return std::erase_if(survey_.polygons, [&](const PolygonOutline& polygon) {
             const std::vector<std::string> vertices = AllVertices(polygon);
             const auto held = std::find_first_of(vertices.begin(), vertices.end(),
                                                  error.points.begin(), error.points.end());
             if (held == vertices.end()) return false;
             unsolvable_.push_back(
                 {LeftOut::Kind::kPolygon, polygon.name, "",
                  Sentence("polygonHeld",
                           "the planes through its vertex {vertex} do not determine it: mark it",
                           {{"vertex", *held}}),
                  polygon.place});
             return true;
           }) > 0;
  }

  void TellFailure(const InputError& error) {
    const Sentence what = MessageOf(error);
    what.SayIn(&result_.message, "failed");
    result_.message["diagnoses"].append(
        DiagnosisTeller(input_.survey).Tell("misfit", what, PlaceOf(error)));
    for (const std::string& photo : part_.photos) {
      result_.message["photos"][photo]["oriented"] = false;
      Sentence("photoFails", "the adjustment fails")
          .SayIn(&result_.message["photos"][photo], "why");
    }
  }

  void TellLeftOut() {
    std::move(unsolvable_.begin(), unsolvable_.end(), std::back_inserter(part_.left_out));
    for (const LeftOut& what : part_.left_out) {
      if (what.kind == LeftOut::Kind::kPhoto) {
        LeaveOutPhoto(what.name, what.reason, what.place);
      } else {
        result_.message["left_out"].append(ToPage(what));
      }
    }
  }

  void TellDiagnoses() {
    const DiagnosisTeller teller(input_.survey);
    Json::Value& told = result_.message["diagnoses"];
    for (const Diagnosis& diagnosis : Diagnose(survey_, names_, cameras_)) {
      told.append(teller.Tell(WordOf(diagnosis.kind), diagnosis.message, diagnosis.place));
    }
    for (const LeftOut& what : part_.left_out) {
      if (!what.is_contradiction) continue;
      told.append(teller.Tell(
          "misfit",
          Sentence(
              "leftOut", "{kind} '{name}' is left out: {reason}",
              {{"kind", Word(what.kind)}, {"name", what.name}, {"reason", what.reason.ToJson()}}),
          what.place));
    }
    for (const std::string& photo : part_.placed_by_points) {
      told.append(teller.Tell("question",
                              Sentence("placedByPoints",
                                       "photo '{photo}' is placed by points of other photos "
                                       "alone; insitu-reconstruct wants three control points on it",
                                       {{"photo", photo}}),
                              FileOfObservations(input_.survey)));
      told[told.size() - 1]["photo"] = photo;
    }
  }

  void TellSolution() {
    TellStatistics();
    TellPhotos();
    TellPoints();
    Json::Value& message = result_.message;
    message["marks"] = MarksToPage(*result_.solved, input_.options.significance);
    message["polygons"] = ImagedPolygons(part_.survey, *result_.solved, result_.cameras);
    message["sun"] = LiveSun(part_.survey, *result_.solved, input_.site);
    message["zenith"] = LiveZenith(part_.survey, *result_.solved);
  }

  void TakeScene() {
    const SolvedSurvey& solved = *result_.solved;
    adjustment_.points = AdjustedPoints(solved.survey_network.network, solved.solution);
    adjustment_.poses = AdjustedPoses(solved.survey_network.network, solved.solution);
    result_.scene =
        AdjustedScene(part_.survey, solved.survey_network, solved.solution, adjustment_);
    std::erase_if(result_.scene->polygons,
                  [](const Polygon& polygon) { return !HasInterior(polygon); });
  }

  void TellStatistics() {
    const NetworkSolution& solution = result_.solved->solution;
    Json::Value& message = result_.message;
    message["sigma0"] = solution.sigma0;
    message["redundancy"] = solution.redundancy;
    message["observations"] = solution.observations;
    message["unknowns"] = solution.unknowns;
    message["converged"] = solution.is_converged;
    message["p"] = ChiSquareTwoSided(solution.square_sum, solution.redundancy);
  }

  void TellPhotos() {
    for (size_t i = 0; i < adjustment_.poses.size(); ++i) {
      const AdjustedPose& pose = adjustment_.poses[i];
      result_.cameras.push_back({pose.photo, cameras_[part_.indices[i]], pose.cam_from_world});
      result_.poses[pose.photo] = pose.cam_from_world;
      Json::Value& photo = result_.message["photos"][pose.photo];
      photo["oriented"] = true;
      photo["center"] = ToJson(Center(pose.cam_from_world));
      photo["sigma_mm"] = 1000 * std::sqrt(pose.covariance.diagonal().tail<3>().sum());
      photo["rms_px"] = pose.rms_px;
      photo["points"] = pose.points;
    }
  }

  void TellPoints() {
    const SolvedSurvey& solved = *result_.solved;
    result_.message["points"] = PredictedPoints(input_.survey, solved, result_.cameras);
    AddPointsOnPlanes(input_.survey, part_.survey, solved, result_.cameras,
                      input_.options.plane_sigma, &result_.message["points"]);
    CompareWithSurvey(part_.survey, &adjustment_);
    result_.message["control"] = ControlToPage(adjustment_);
  }

  const LiveInput& input_;
  const SceneFound& found_;
  LiveResult result_;
  Survey survey_;  // without the rows of photos without lens
  std::vector<std::string> names_;
  std::vector<Camera> cameras_;
  std::vector<PhotoLens> lenses_;
  DeterminedPart part_;
  Adjustment adjustment_;            // of `part_`, if that is solved
  std::vector<LeftOut> unsolvable_;  // marks that SolvePart left out
};

}  // namespace

LiveResult SolveLive(const LiveInput& input, const SceneFound& found) {
  return Solver(input, found).Solve();
}

Json::Value LiveSolution(const LiveInput& input) { return SolveLive(input).message; }

}  // namespace insitu
