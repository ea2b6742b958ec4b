// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/find_start_values.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "calibration/files/error_at.h"
#include "calibration/files/wording.h"
#include "reconstruction/adjustment/start_growth.h"

namespace insitu {
namespace {

void RequireOnPhotograph(const Sentence& what, const std::string& photo, const Camera& camera,
                         const Eigen::Vector2d& pixel, const FilePlace& place) {
  if (camera.Sees(pixel)) return;
  throw ErrorAt(place,
                Sentence("startOutside",
                         "{what} is marked outside photo '{photo}', expected a position within "
                         "{width}x{height} pixels",
                         {{"what", what.ToJson()},
                          {"photo", photo},
                          {"width", camera.width()},
                          {"height", camera.height()}}));
}

// Grows the start values of a survey that must be whole: tells what it lacks.
class StartFinder {
 public:
  StartFinder(const Survey& survey, const std::vector<std::string>& photos,
              const std::vector<Camera>& cameras,
              const std::map<std::string, Rigid3>& initial_cam_from_world)
      : survey_(survey), growth_(survey, photos, cameras, initial_cam_from_world) {
    RequireMarksOnPhotographs(survey, photos, cameras);
  }

  StartValues Find() {
    growth_.TakeControl();
    if (survey_.tie_points) growth_.PlaceByTiePoints();
    std::vector<size_t> ambiguous, waiting;
    for (size_t photo = 0; photo < growth_.values().cameras.size(); ++photo) {
      if (growth_.IsPosed(photo)) continue;
      if (survey_.tie_points && !growth_.CanResect(photo)) {
        waiting.push_back(photo);
      } else if (ResectFromControl(photo)) {
        ambiguous.push_back(photo);
      } else {
        growth_.SetPosed(photo);
      }
    }
    growth_.FindPoints();
    for (const size_t photo : ambiguous) ResectAgain(photo);
    growth_.FindPoints();
    ResectWaiting(std::move(waiting));
    RequireAllFound();
    if (survey_.tie_points) growth_.TakeTiePoints();
    return std::move(growth_.values());
  }

 private:
  const std::string& NameOf(size_t photo) { return growth_.values().cameras[photo].photo; }

  // Photos that image matching left out and that show too little control: from points that others
  // determine, as long as that helps.
  void ResectWaiting(std::vector<size_t> waiting) {
    while (!waiting.empty()) {
      const auto next = std::find_if(waiting.begin(), waiting.end(),
                                     [&](size_t photo) { return growth_.CanResect(photo); });
      const size_t photo = next == waiting.end() ? waiting.front() : *next;
      if (ResectFromControl(photo)) ResectAgain(photo);  // throws if it still shows too little
      growth_.SetPosed(photo);
      std::erase(waiting, photo);
      growth_.FindPoints();
    }
  }

  // Returns whether the points left several poses to choose from.
  bool ResectFromControl(size_t photo) {
    const std::string& name = NameOf(photo);
    const auto [points, first_known, first] = growth_.MarksOf(photo);
    if (points.size() < 3) {
      const FilePlace place = first ? first->place : FileOfObservations(survey_);
      throw ErrorAt(place,
                    Sentence("startFewControl",
                             "photo '{photo}' shows {count} control points, expected at least "
                             "three (check points do not count); mark more, or let "
                             "insitu-tie-points connect it to photos that show them",
                             {{"photo", name}, {"count", static_cast<int>(points.size())}}));
    }
    std::vector<Eigen::Vector3d> positions;
    for (const ResectionPoint& point : points) positions.push_back(point.world);
    if (AreCollinear(positions)) {
      throw ErrorAt(first_known->place,
                    Sentence("startOnLine",
                             "the {count} control points on photo '{photo}' lie on one line, "
                             "expected one well beside it",
                             {{"count", static_cast<int>(points.size())}, {"photo", name}}));
    }
    const Resections resections = Resect(photo, points, first_known->place);
    return resections.best.ambiguous || !resections.seconds.empty();
  }

  void ResectAgain(size_t photo) {
    const StartGrowth::PhotoMarks marks = growth_.MarksOf(photo);
    const Resections resections = Resect(photo, marks.known, marks.first_known->place);
    if (resections.best.ambiguous) {
      growth_.values().warnings.push_back(
          "photo '" + NameOf(photo) +
          "' fits its three control points from several places; the most "
          "upright was taken: mark a fourth or give an estimate");
    }
    if (!resections.seconds.empty()) WarnOfSecondPose(photo, marks.known.size(), resections);
    growth_.SetPosed(photo);
  }

  void WarnOfSecondPose(size_t photo, size_t points, const Resections& resections) {
    const auto place = [](const Rigid3& cam_from_world) {
      const Eigen::Vector3d center = Center(cam_from_world);
      return Formatted("(%.2f, %.2f, %.2f)", center.x(), center.y(), center.z());
    };
    const SecondPose& second = resections.seconds[0];
    const double apart =
        (Center(second.cam_from_world) - Center(resections.best.cam_from_world)).norm();
    std::string decides = "give its place by --start or camera_positions.csv";
    if (resections.deciding_m) {
      decides = "mark a known point " + ShortNumber(*resections.deciding_m) +
                " m or more off the plane of the " + "others, or " + decides;
    }
    growth_.values().warnings.push_back(
        "photo '" + NameOf(photo) + "' fits its " + std::to_string(points) + " known points" +
        (resections.are_coplanar ? ", which lie nearly in one plane," : "") +
        " from two places: " + place(resections.best.cam_from_world) + ", which was taken, with " +
        ShortNumber(resections.best.rms_px) + " px (RMS), and " + place(second.cam_from_world) +
        ", " + ShortNumber(apart) + " m away, with " + ShortNumber(second.rms_px) +
        " px; the marks do not decide between them: " + decides);
  }

  Resections Resect(size_t photo, const std::vector<ResectionPoint>& points,
                    const FilePlace& place) {
    const auto resections = growth_.Resect(photo, points);
    if (resections) return *resections;
    throw ErrorAt(place,
                  Sentence("startNoPlace",
                           "photo '{photo}' cannot be resected from its {count} control "
                           "points, expected marks that one camera position explains",
                           {{"photo", NameOf(photo)}, {"count", static_cast<int>(points.size())}}));
  }

  void RequireAllFound() const {
    if (growth_.unknown().empty()) return;
    const std::string& name = *growth_.unknown().begin();
    const int rays = static_cast<int>(growth_.Rays(name));
    const Sentence photos = rays == 1 ? Sentence("onePhoto", "1 photo")
                                      : Sentence("manyPhotos", "{count} photos", {{"count", rays}});
    throw ErrorAt(PlaceOfPoint(survey_, name),
                  Sentence("startNoPoint",
                           "point '{point}' is marked on {photos} and cannot be determined; "
                           "expected marks on two photos from different places, or one mark and a "
                           "polygon with three other known vertices, or its coordinates as a "
                           "control point",
                           {{"point", name}, {"photos", photos.ToJson()}}));
  }

  const Survey& survey_;
  StartGrowth growth_;
};

}  // namespace

void RequireMarksOnPhotographs(const Survey& survey, const std::vector<std::string>& photos,
                               const std::vector<Camera>& cameras, double most_outside) {
  struct Frame {
    const Camera* camera = nullptr;
    double outside = 0, all = 0;
  };
  std::unordered_map<std::string, Frame> frames;
  for (size_t i = 0; i < photos.size(); ++i) frames[photos[i]].camera = &cameras[i];
  const auto count = [&](const auto& marks) {
    for (const auto& mark : marks) {
      Frame& frame = frames.at(mark.photo);
      frame.all += 1;
      frame.outside += frame.camera->Sees(mark.pixel) ? 0 : 1;
    }
  };
  count(survey.observations);
  count(survey.edges);
  const auto may_be_slip = [&](const auto& mark) {
    const Frame& frame = frames.at(mark.photo);
    return frame.outside > 0 && frame.outside <= most_outside * frame.all;
  };
  for (const ImageObservation& mark : survey.observations) {
    if (!may_be_slip(mark)) continue;
    RequireOnPhotograph(Sentence("startPoint", "point '{point}'", {{"point", mark.point}}),
                        mark.photo, *frames.at(mark.photo).camera, mark.pixel, mark.place);
  }
  for (const EdgeMark& mark : survey.edges) {
    if (!may_be_slip(mark)) continue;
    RequireOnPhotograph(
        Sentence("startEdge", "edge '{from}' to '{to}'", {{"from", mark.from}, {"to", mark.to}}),
        mark.photo, *frames.at(mark.photo).camera, mark.pixel, mark.place);
  }
}

StartValues FindStartValues(const Survey& survey, const std::vector<std::string>& photos,
                            const std::vector<Camera>& cameras,
                            const std::map<std::string, Rigid3>& initial_cam_from_world) {
  INSITU_CHECK(photos.size() == cameras.size());
  return StartFinder(survey, photos, cameras, initial_cam_from_world).Find();
}

}  // namespace insitu
