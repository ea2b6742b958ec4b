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
               "the control points are in two coordinate systems: " + QuotedList(names) +
                   " are all shifted by " + Meters(shift) +
                   " against the others, by what the photos show. Expected: all coordinates in "
                   "one system"}};
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

  std::string SeenByPhotos(const ControlPoint& control) const {
    std::vector<std::string> photos;
    for (const ControlMark& mark : outliers_.at(&control)) photos.push_back(mark.mark->photo);
    return "photo" + std::string(photos.size() > 1 ? "s " : " ") + QuotedList(photos);
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
    return {one.place, "points '" + one.name + "' and '" + other.name + "' (line " +
                           std::to_string(other.place.line) +
                           ") are exchanged: " + SeenByPhotos(one) +
                           " show each where the other's coordinates are. Did you mean '" +
                           other.name + "' here, and '" + one.name +
                           "' there? Expected: the two names exchanged, here or in all marks"};
  }

  Diagnosis MarkedAsAnother(const ControlPoint& control, const ControlPoint& other) {
    const ImageObservation& mark = *outliers_.at(&control).front().mark;
    return {mark.place,
            "the marks of '" + control.name + "' show point '" + other.name + "' on " +
                SeenByPhotos(control) + "; did you mean '" + other.name +
                "'? Expected: the name of the point shown, or the coordinates of '" + control.name +
                "' (control_points.csv:" + std::to_string(control.place.line) + ") corrected"};
  }

  Diagnosis FarOff(const ControlPoint& control, const Eigen::Vector3d& seen) const {
    const Eigen::Vector3d& given = control.position;
    const Eigen::Vector3d off = given - seen;
    const double reach = ReachOf(control, seen);
    std::string message = "control point '" + control.name + "' lies " + ShortNumber(off.norm()) +
                          " m from where " + SeenByPhotos(control) + " show it, " + Meters(seen) +
                          " instead of " + Meters(given);
    const Eigen::Vector3d exchanged(given.y(), given.x(), given.z());
    if ((exchanged - seen).norm() < reach) {
      return {control.place, message + ": its x and y are exchanged. Expected: x east, y north"};
    }
    if ((given / 1000 - seen).norm() < reach) {
      return {control.place, message + ": it is in millimetres. Expected: metres, as the others"};
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(off[axis]) > 4 * reach &&
          (off - off[axis] * Eigen::Vector3d::Unit(axis)).norm() < reach) {
        message += std::string(": only ") + "xyz"[axis] + " is wrong, is it a slip of a digit?";
      }
    }
    return {control.place, message + ". Expected: coordinates and marks of one and the same point",
            Diagnosis::Kind::kMisfit};
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

  Diagnosis OfMark(const ControlMark& outlier) {
    const ImageObservation& mark = *outlier.mark;
    const ControlPoint& control = *outlier.control;
    std::string where = "point '" + control.name + "' is marked on photo '" + mark.photo + "' at " +
                        Pixel(mark.pixel);
    const auto expected = ImageOf(control.position, mark.photo);
    if (expected) {
      where += ", " + ShortNumber((*expected - mark.pixel).norm()) +
               " px from where its coordinates " + "appear, " + Pixel(*expected) +
               " (the marks that agree fit to " + ShortNumber(rms_px_.at(mark.photo)) + " px)";
    }
    const auto shown = ShownBy(outlier);
    for (const ControlPoint* other : shown) {
      const ImageObservation* others_mark = MarkOf(other->name, mark.photo);
      if (others_mark && IsImageOf(*others_mark, others_mark->pixel, control)) {
        return {mark.place, where + ": '" + control.name + "' and '" + other->name + "' (line " +
                                std::to_string(others_mark->place.line) +
                                ") are exchanged on this photo; did you mean '" + other->name +
                                "'? Expected: the two names exchanged"};
      }
    }
    if (!shown.empty()) {
      std::string names;
      for (const ControlPoint* other : shown) {
        names += (names.empty() ? "'" : " or '") + other->name + "'";
      }
      return {mark.place, where + ": that is where " + names + " is; did you mean " + names +
                              "? Expected: the name of the point shown"};
    }
    return Displaced(outlier, where, expected);
  }

  Diagnosis Displaced(const ControlMark& outlier, const std::string& where,
                      const std::optional<Eigen::Vector2d>& expected) const {
    const ImageObservation& mark = *outlier.mark;
    const insitu::Camera& camera = Camera(mark.photo).camera;
    const Eigen::Vector2d exchanged(mark.pixel.y(), mark.pixel.x());
    const Eigen::Vector2d from_top(mark.pixel.x(), camera.height() - 1 - mark.pixel.y());
    if (IsImageOf(mark, exchanged, *outlier.control)) {
      return {mark.place, where + ": its x and y are exchanged. Expected: x to the right, y down"};
    }
    if (IsImageOf(mark, from_top, *outlier.control)) {
      return {mark.place, where + ": its y is counted from the bottom. Expected: y from the top"};
    }
    const std::string outside =
        camera.Sees(mark.pixel) ? "" : ": that is outside photo '" + mark.photo + "'";
    return {mark.place,
            where + outside + ". Expected: the mark of '" + outlier.control->name +
                (expected ? "' there" : "' on a photo that shows it") +
                ", another name, or corrected coordinates",
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
