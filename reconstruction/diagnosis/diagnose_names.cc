// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/diagnosis/diagnose_names.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "calibration/files/wording.h"
#include "reconstruction/diagnosis/control_fit.h"
#include "reconstruction/geometry/intersection.h"

namespace insitu {
namespace {

constexpr double kNear = 6;         // [sigma], from where a point appears
constexpr double kNearPx = 3;       // [px], and at least this
constexpr double kGrossPx = 8;      // [px], below this a mark is only bad, which the w-test tells
constexpr double kMinAngle = 0.02;  // [rad], to trust an intersection

std::string Pixel(const Eigen::Vector2d& pixel) {
  return Formatted("(%.1f, %.1f)", pixel.x(), pixel.y());
}

std::string Meters(const Eigen::Vector3d& vector) {
  return Formatted("(%.3f, %.3f, %.3f) m", vector.x(), vector.y(), vector.z());
}

class NameDiagnosis {
 public:
  NameDiagnosis(const DiagnosisInput& input, const std::vector<size_t>& bad) : input_(input) {
    for (size_t photo = 0; photo < input.photos.size(); ++photo) {
      auto fit = FitControlRobustly(input.survey, input.photos, input.cameras, photo);
      if (!fit) continue;
      for (const ControlMark& mark : fit->fit.marks) agreeing_.insert(mark.control);
      const bool is_bad = std::find(bad.begin(), bad.end(), photo) != bad.end();
      if (is_bad) {
        for (const ControlMark& mark : fit->outliers) outliers_[mark.control].push_back(mark);
      }
      const size_t index = posed_.size();
      posed_.push_back({input.photos[photo], input.cameras[photo], fit->fit.cam_from_world});
      index_of_photo_[input.photos[photo]] = index;
      rms_px_[input.photos[photo]] = fit->fit.rms_px;
    }
  }

  std::vector<Diagnosis> Find() {
    FindPoints();
    std::vector<Diagnosis> found = ShiftedTogether();
    if (!found.empty()) return found;
    for (const auto& [control, marks] : outliers_) {
      if (explained_.contains(control)) continue;
      const auto seen = seen_at_.find(control);
      const std::optional<Diagnosis> diagnosis =
          seen != seen_at_.end() ? OfPoint(*control, seen->second) : std::nullopt;
      if (diagnosis) {
        found.push_back(*diagnosis);
      } else {
        for (const ControlMark& mark : marks) {
          if (IsGross(mark)) found.push_back(OfMark(mark));
        }
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& x, const auto& y) {
      return std::tuple(x.kind, x.place.path, x.place.line) <
             std::tuple(y.kind, y.place.path, y.place.line);
    });
    return found;
  }

 private:
  const PosedCamera& Camera(const std::string& photo) const {
    return posed_[index_of_photo_.at(photo)];
  }

  // Where a point appears on a posed photo.
  std::optional<Eigen::Vector2d> ImageOf(const Eigen::Vector3d& point,
                                         const std::string& photo) const {
    const PosedCamera& posed = Camera(photo);
    return posed.camera.Project(posed.cam_from_world * point);
  }

  double TolerancePx(const ImageObservation& mark, const ControlPoint& control) const {
    const PosedCamera& posed = Camera(mark.photo);
    return std::max(kNearPx,
                    kNear * SigmaPx({&mark, &control}, posed.camera, posed.cam_from_world));
  }

  bool IsImageOf(const ImageObservation& mark, const Eigen::Vector2d& pixel,
                 const ControlPoint& control) const {
    const auto image = ImageOf(control.position, mark.photo);
    return image && (*image - pixel).norm() < TolerancePx(mark, control);
  }

  // The points whose marks agree with each other but nowhere with the coordinates.
  void FindPoints() {
    for (const auto& [control, marks] : outliers_) {
      if (agreeing_.contains(control) || marks.size() < 2) continue;
      std::vector<Sight> sights;
      for (const ControlMark& mark : marks) {
        sights.push_back({&Camera(mark.mark->photo), mark.mark->pixel});
      }
      const auto point = Intersect(sights, kMinAngle);
      if (!point) continue;
      ControlPoint seen = *control;
      seen.position = *point;
      if (std::all_of(marks.begin(), marks.end(), [&](const ControlMark& mark) {
            return IsImageOf(*mark.mark, mark.mark->pixel, seen);
          })) {
        seen_at_[control] = *point;
      }
    }
  }

  // How far an intersected point may be from the truth [m], generously.
  double ReachOf(const ControlPoint& control, const Eigen::Vector3d& seen) const {
    double reach = kNear * control.sigma.maxCoeff();
    for (const ControlMark& mark : outliers_.at(&control)) {
      const PosedCamera& posed = Camera(mark.mark->photo);
      const double distance = (posed.cam_from_world * seen).norm();
      reach = std::max(reach, kNear * 2 * mark.mark->sigma_px * distance / posed.camera.focal_px());
    }
    return reach;
  }

  // Two systems: several points off by one and the same vector.
  std::vector<Diagnosis> ShiftedTogether() {
    for (const auto& [control, seen] : seen_at_) {
      const Eigen::Vector3d shift = control->position - seen;
      std::vector<std::string> names;
      const ControlPoint* first = control;
      for (const auto& [other, other_seen] : seen_at_) {
        const double reach = ReachOf(*control, seen) + ReachOf(*other, other_seen);
        if ((other->position - other_seen - shift).norm() > reach) continue;
        names.push_back(other->name);
        if (other->place.line < first->place.line) first = other;
      }
      if (names.size() < 3) continue;
      return {{first->place,
               Sentence("namesShifted",
                        "the control points are in two coordinate systems: {names} are all shifted "
                        "by {shift} against the others, by what the photos show. Expected: all "
                        "coordinates in one system",
                        {{"names", SaidNames(names)}, {"shift", Meters(shift)}})}};
    }
    return {};
  }

  // Points of the survey at a place.
  const ControlPoint* ControlAt(const Eigen::Vector3d& place, const ControlPoint& but,
                                double reach) const {
    for (const ControlPoint& point : input_.survey.control_points) {
      if (&point != &but && (point.position - place).norm() < reach) return &point;
    }
    return nullptr;
  }

  Json::Value SeenByPhotos(const ControlPoint& control) const {
    std::vector<std::string> photos;
    for (const ControlMark& mark : outliers_.at(&control)) photos.push_back(mark.mark->photo);
    return SaidPhotos(photos);
  }

  std::optional<Diagnosis> OfPoint(const ControlPoint& control, const Eigen::Vector3d& seen) {
    const double reach = ReachOf(control, seen);
    if (const ControlPoint* other = ControlAt(seen, control, reach)) {
      const auto other_seen = seen_at_.find(other);
      const bool is_exchange =
          other_seen != seen_at_.end() && (other_seen->second - control.position).norm() < reach;
      return is_exchange ? ExchangedRows(control, *other) : MarkedAsAnother(control, *other);
    }
    return FarOff(control, seen);
  }

  Diagnosis ExchangedRows(const ControlPoint& one, const ControlPoint& other) {
    explained_.insert({&one, &other});
    return {one.place,
            Sentence("namesExchanged",
                     "points '{one}' and '{other}' (line {line}) are exchanged: {photos} show each "
                     "where the other's coordinates are. Did you mean '{other}' here, and '{one}' "
                     "there? Expected: the two names exchanged, here or in all marks",
                     {{"one", one.name},
                      {"other", other.name},
                      {"line", other.place.line},
                      {"photos", SeenByPhotos(one)}})};
  }

  Diagnosis MarkedAsAnother(const ControlPoint& control, const ControlPoint& other) {
    const ImageObservation& mark = *outliers_.at(&control).front().mark;
    return {mark.place,
            Sentence("namesAnother",
                     "the marks of '{name}' show point '{other}' on {photos}; did you mean "
                     "'{other}'? Expected: the name of the point shown, or the coordinates of "
                     "'{name}' (control_points.csv:{line}) corrected",
                     {{"name", control.name},
                      {"other", other.name},
                      {"photos", SeenByPhotos(control)},
                      {"line", control.place.line}})};
  }

  Diagnosis FarOff(const ControlPoint& control, const Eigen::Vector3d& seen) const {
    const Eigen::Vector3d& given = control.position;
    const Eigen::Vector3d off = given - seen;
    const double reach = ReachOf(control, seen);
    const Sentence lies("namesFarOff",
                        "control point '{name}' lies {distance} m from where {photos} show it, "
                        "{seen} instead of {given}",
                        {{"name", control.name},
                         {"distance", ShortNumber(off.norm())},
                         {"photos", SeenByPhotos(control)},
                         {"seen", Meters(seen)},
                         {"given", Meters(given)}});
    const Sentence::Values values = {{"lies", lies.ToJson()}};
    const Eigen::Vector3d exchanged(given.y(), given.x(), given.z());
    if ((exchanged - seen).norm() < reach) {
      return {control.place,
              Sentence("namesPointSwapped",
                       "{lies}: its x and y are exchanged. Expected: x east, y north", values)};
    }
    if ((given / 1000 - seen).norm() < reach) {
      return {control.place,
              Sentence("namesPointUnit",
                       "{lies}: it is in millimetres. Expected: metres, as the others", values)};
    }
    return {control.place, FarOffAlong(values, off, reach), Diagnosis::Kind::kMisfit};
  }

  static Sentence FarOffAlong(Sentence::Values values, const Eigen::Vector3d& off, double reach) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(off[axis]) > 4 * reach &&
          (off - off[axis] * Eigen::Vector3d::Unit(axis)).norm() < reach) {
        values["axis"] = std::string(1, "xyz"[axis]);
        return Sentence("namesOneAxis",
                        "{lies}: only {axis} is wrong, is it a slip of a digit? Expected: "
                        "coordinates and marks of one and the same point",
                        values);
      }
    }
    return Sentence("namesPointOff",
                    "{lies}. Expected: coordinates and marks of one and the same point", values);
  }

  bool IsGross(const ControlMark& mark) const {
    const auto image = ImageOf(mark.control->position, mark.mark->photo);
    return !image || (*image - mark.mark->pixel).norm() > kGrossPx;
  }

  // The points that appear where a mark is.
  std::vector<const ControlPoint*> ShownBy(const ControlMark& mark) const {
    std::vector<const ControlPoint*> shown;
    for (const ControlPoint& point : input_.survey.control_points) {
      if (&point != mark.control && IsImageOf(*mark.mark, mark.mark->pixel, point)) {
        shown.push_back(&point);
      }
    }
    return shown;
  }

  const ImageObservation* MarkOf(const std::string& point, const std::string& photo) const {
    for (const ImageObservation& mark : input_.survey.observations) {
      if (mark.photo == photo && mark.point == point) return &mark;
    }
    return nullptr;
  }

  Sentence WhereMarked(const ControlMark& outlier,
                       const std::optional<Eigen::Vector2d>& expected) const {
    const ImageObservation& mark = *outlier.mark;
    Sentence::Values values = {
        {"name", outlier.control->name}, {"photo", mark.photo}, {"pixel", Pixel(mark.pixel)}};
    if (!expected) {
      return Sentence("namesMarked", "point '{name}' is marked on photo '{photo}' at {pixel}",
                      values);
    }
    values["distance"] = ShortNumber((*expected - mark.pixel).norm());
    values["expected"] = Pixel(*expected);
    values["rms"] = ShortNumber(rms_px_.at(mark.photo));
    return Sentence("namesMarkedOff",
                    "point '{name}' is marked on photo '{photo}' at {pixel}, {distance} px from "
                    "where its coordinates appear, {expected} (the marks that agree fit to {rms} "
                    "px)",
                    values);
  }

  Diagnosis OfMark(const ControlMark& outlier) {
    const ImageObservation& mark = *outlier.mark;
    const ControlPoint& control = *outlier.control;
    const auto expected = ImageOf(control.position, mark.photo);
    const Json::Value where = WhereMarked(outlier, expected).ToJson();
    const auto shown = ShownBy(outlier);
    for (const ControlPoint* other : shown) {
      const ImageObservation* others_mark = MarkOf(other->name, mark.photo);
      if (others_mark && IsImageOf(*others_mark, others_mark->pixel, control)) {
        return {mark.place,
                Sentence("namesMarksExchanged",
                         "{where}: '{name}' and '{other}' (line {line}) are exchanged on this "
                         "photo; did you mean '{other}'? Expected: the two names exchanged",
                         {{"where", where},
                          {"name", control.name},
                          {"other", other->name},
                          {"line", others_mark->place.line}})};
      }
    }
    if (!shown.empty()) {
      Json::Value names = SaidNames({shown.front()->name});
      for (size_t i = 1; i < shown.size(); ++i) {
        names =
            Sentence("nameOr", "{first} or '{name}'", {{"first", names}, {"name", shown[i]->name}})
                .ToJson();
      }
      return {mark.place, Sentence("namesShows",
                                   "{where}: that is where {names} is; did you mean {names}? "
                                   "Expected: the name of the point shown",
                                   {{"where", where}, {"names", names}})};
    }
    return Displaced(outlier, where, expected);
  }

  Diagnosis Displaced(const ControlMark& outlier, const Json::Value& where,
                      const std::optional<Eigen::Vector2d>& expected) const {
    const ImageObservation& mark = *outlier.mark;
    const insitu::Camera& camera = Camera(mark.photo).camera;
    const Eigen::Vector2d exchanged(mark.pixel.y(), mark.pixel.x());
    const Eigen::Vector2d from_top(mark.pixel.x(), camera.height() - 1 - mark.pixel.y());
    Sentence::Values values = {{"where", where}};
    if (IsImageOf(mark, exchanged, *outlier.control)) {
      return {
          mark.place,
          Sentence("namesMarkSwapped",
                   "{where}: its x and y are exchanged. Expected: x to the right, y down", values)};
    }
    if (IsImageOf(mark, from_top, *outlier.control)) {
      return {
          mark.place,
          Sentence("namesMarkBottom",
                   "{where}: its y is counted from the bottom. Expected: y from the top", values)};
    }
    if (!camera.Sees(mark.pixel)) {
      values["where"] = Sentence("namesOutside", "{where}: that is outside photo '{photo}'",
                                 {{"where", where}, {"photo", mark.photo}})
                            .ToJson();
    }
    values["name"] = outlier.control->name;
    return {mark.place,
            expected ? Sentence("namesMarkThere",
                                "{where}. Expected: the mark of '{name}' there, another name, or "
                                "corrected coordinates",
                                values)
                     : Sentence("namesMarkElsewhere",
                                "{where}. Expected: the mark of '{name}' on a photo that shows it, "
                                "another name, or corrected coordinates",
                                values),
            Diagnosis::Kind::kMisfit};
  }

  const DiagnosisInput& input_;
  std::vector<PosedCamera> posed_;
  std::map<std::string, size_t> index_of_photo_;
  std::map<std::string, double> rms_px_;
  // By place in the file, so that the same survey is told alike.
  struct ByLine {
    bool operator()(const ControlPoint* a, const ControlPoint* b) const {
      return a->place.line != b->place.line ? a->place.line < b->place.line : a->name < b->name;
    }
  };
  std::set<const ControlPoint*, ByLine> agreeing_, explained_;
  std::map<const ControlPoint*, std::vector<ControlMark>, ByLine> outliers_;
  std::map<const ControlPoint*, Eigen::Vector3d, ByLine> seen_at_;
};

}  // namespace

std::vector<Diagnosis> DiagnoseNames(const DiagnosisInput& input, const std::vector<size_t>& bad) {
  return NameDiagnosis(input, bad).Find();
}

}  // namespace insitu
