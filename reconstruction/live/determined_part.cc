// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/live/determined_part.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "calibration/files/error_at.h"
#include "reconstruction/adjustment/planarity.h"
#include "reconstruction/adjustment/start_growth.h"
#include "reconstruction/live/left_out_reasons.h"

namespace insitu {
namespace {

constexpr double kApart = 1e-6;  // [m], points nearer to one another lie in one place

std::string Joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

// Prunes a copy of a survey. Every pass grows the start values anew, for what is left out may have
// held something else: a polygon's plane a vertex, a photo's ray a point.
class PartFinder {
 public:
  PartFinder(const Survey& survey, const std::vector<std::string>& photos,
             const std::vector<Camera>& cameras,
             const std::map<std::string, Rigid3>& initial_cam_from_world,
             const AdjustmentOptions& options)
      : photos_(photos),
        cameras_(cameras),
        initial_cam_from_world_(initial_cam_from_world),
        options_(options) {
    for (size_t i = 0; i < photos.size(); ++i) index_of_photo_[photos[i]] = i;
    is_left_out_.assign(photos.size(), false);
    part_.survey = survey;
    NotePlaces();
  }

  DeterminedPart Find() {
    LeaveOutMarksOffPhotographs();
    std::optional<StartGrowth> growth;
    size_t before;
    do {
      before = part_.left_out.size();
      growth.emplace(part_.survey, photos_, cameras_, initial_cam_from_world_);
      Grow(&*growth);
      LeaveOutPhotos(*growth);
      LeaveOutPoints(*growth);
      EraseMarks(growth->unknown());
      LeaveOutWhatNamesThem(growth->values().points);
      if (part_.left_out.size() == before) LeaveOutContradictions(growth->values().points);
    } while (part_.left_out.size() > before);
    if (part_.survey.tie_points) growth->TakeTiePoints();
    TakeStart(std::move(growth->values()));
    return std::move(part_);
  }

 private:
  // As PlaceOfPoint, of all at once.
  void NotePlaces() {
    const Survey& survey = part_.survey;
    for (const ImageObservation& mark : survey.observations) {
      place_of_point_.try_emplace(mark.point, mark.place);
      place_of_photo_.try_emplace(mark.photo, mark.place);
      photos_of_point_[mark.point].insert(mark.photo);
    }
    for (const ControlPoint& point : survey.control_points) {
      place_of_point_.try_emplace(point.name, point.place);
    }
    for (const PolygonOutline& polygon : survey.polygons) {
      for (const std::string& vertex : AllVertices(polygon)) {
        place_of_point_.try_emplace(vertex, polygon.place);
      }
    }
    for (const JoinedPoints& points : JoinedByPairs(survey)) {
      for (const std::string& name : points.names) place_of_point_.try_emplace(name, points.place);
    }
  }

  void LeaveOut(LeftOut what) { part_.left_out.push_back(std::move(what)); }

  // Whether a mark is to be left out before anything else.
  bool IsOffPhotograph(LeftOut::Kind kind, const std::string& name, const std::string& photo,
                       const Eigen::Vector2d& pixel, const FilePlace& place) {
    const auto index = index_of_photo_.find(photo);
    if (index != index_of_photo_.end() && cameras_[index->second].Sees(pixel)) return false;
    const bool is_known = index != index_of_photo_.end();
    LeaveOut({kind, name, photo,
              is_known ? Sentence("markOutside", "marked outside the photograph")
                       : Sentence("markNoLens", "the lens of its photo is not known"),
              place, is_known});
    return true;
  }

  void LeaveOutMarksOffPhotographs() {
    std::erase_if(part_.survey.observations, [&](const ImageObservation& mark) {
      return IsOffPhotograph(LeftOut::Kind::kObservation, mark.point, mark.photo, mark.pixel,
                             mark.place);
    });
    std::erase_if(part_.survey.edges, [&](const EdgeMark& edge) {
      return IsOffPhotograph(LeftOut::Kind::kEdge, Joined({edge.from, edge.to}), edge.photo,
                             edge.pixel, edge.place);
    });
    std::erase_if(part_.survey.camera_positions, [&](const CameraPosition& position) {
      return !index_of_photo_.contains(position.photo);
    });
  }

  void PlaceByTiePoints(StartGrowth* growth) {
    if (!part_.survey.tie_points) return;
    try {
      growth->PlaceByTiePoints();
    } catch (const InputError& contradiction) {
      LeaveOut(
          {LeftOut::Kind::kObservation, "tie points", "", SentenceOf(contradiction), {}, true});
      part_.survey.tie_points.reset();
    }
  }

  // Poses the photos that can be, first from control, then from what others determine; those that
  // fit several places only when nothing more is found.
  void Grow(StartGrowth* growth) {
    growth->TakeControl();
    PlaceByTiePoints(growth);
    part_.placed_by_points.clear();
    std::set<size_t> ambiguous;
    bool is_control = true;
    std::set<size_t> open = growth->TakeChangedPhotos();
    do {
      for (const size_t photo : open) Place(photo, is_control, &ambiguous, growth);
      growth->FindPoints();
      open = growth->TakeChangedPhotos();
      if (is_control || open.empty()) {
        for (const size_t photo : std::exchange(ambiguous, {})) {
          Place(photo, is_control, nullptr, growth);
        }
        growth->FindPoints();
        open.merge(growth->TakeChangedPhotos());
        std::erase_if(open, [&](size_t photo) { return growth->IsPosed(photo); });
      }
      is_control = false;
    } while (!open.empty() || !ambiguous.empty());
  }

  // Without `ambiguous` the most upright of several poses is taken.
  void Place(size_t photo, bool is_control, std::set<size_t>* ambiguous, StartGrowth* growth) {
    if (is_left_out_[photo] || !growth->CanResect(photo)) return;
    const auto resection = growth->Resect(photo, growth->MarksOf(photo).known);
    if (!resection) return;
    if (resection->best.ambiguous && ambiguous != nullptr) {
      ambiguous->insert(photo);
      return;
    }
    if (ambiguous != nullptr) ambiguous->erase(photo);
    if (resection->best.ambiguous) {
      growth->values().warnings.push_back(
          "photo '" + photos_[photo] +
          "' fits its three known points from several places; the most upright was taken: mark a "
          "fourth");
    }
    if (!is_control) part_.placed_by_points.push_back(photos_[photo]);
    growth->SetPosed(photo);
  }

  void LeaveOutPhotos(const StartGrowth& growth) {
    for (size_t photo = 0; photo < photos_.size(); ++photo) {
      if (growth.IsPosed(photo) || is_left_out_[photo]) continue;
      const auto place = place_of_photo_.find(photos_[photo]);
      LeaveOut({LeftOut::Kind::kPhoto, photos_[photo], "",
                ReasonOfPhoto(growth.MarksOf(photo).known.size(), growth.CanResect(photo)),
                place == place_of_photo_.end() ? FileOfObservations(part_.survey) : place->second,
                growth.CanResect(photo)});
      is_left_out_[photo] = true;
    }
  }

  Sentence ReasonOf(const StartGrowth& growth, const std::string& point) const {
    const auto photos = photos_of_point_.find(point);
    return ReasonOfPoint(growth.Rays(point), photos == photos_of_point_.end()
                                                 ? std::set<std::string>()
                                                 : photos->second);
  }

  void LeaveOutPoints(const StartGrowth& growth) {
    const std::set<std::string>& unknown = growth.unknown();
    for (const std::string& name : unknown) {
      if (!points_told_.insert(name).second) continue;
      LeaveOut({LeftOut::Kind::kPoint, name, "", ReasonOf(growth, name), place_of_point_.at(name)});
    }
  }

  // From here on the growth's marks are gone.
  void EraseMarks(const std::set<std::string>& unknown) {
    const auto is_out = [&](const auto& row) {
      return static_cast<bool>(is_left_out_[index_of_photo_.at(row.photo)]);
    };
    for (const EdgeMark& edge : part_.survey.edges) {
      if (!is_out(edge)) continue;
      LeaveOut({LeftOut::Kind::kEdge, Joined({edge.from, edge.to}), edge.photo,
                Sentence("edgePhotoOut", "its photo is not placed"), edge.place});
    }
    std::erase_if(part_.survey.edges, is_out);
    std::erase_if(part_.survey.camera_positions, is_out);
    std::erase_if(part_.survey.observations, [&](const ImageObservation& mark) {
      return is_out(mark) || unknown.contains(mark.point);
    });
  }

  using Points = std::map<std::string, StartPoint>;

  // Leaves out the rows of a list that `fault` finds a reason for.
  template <typename Row, typename Fault>
  void Prune(std::vector<Row>* rows, const Fault& fault) {
    std::erase_if(*rows, [&](const Row& row) {
      std::optional<LeftOut> found = fault(row);
      if (!found) return false;
      LeaveOut(std::move(*found));
      return true;
    });
  }

  static std::optional<LeftOut> Undetermined(LeftOut::Kind kind, ReasonByName* reason,
                                             const std::string& name,
                                             const std::vector<std::string>& names,
                                             const FilePlace& place, const Points& points) {
    for (const std::string& needed : names) {
      if (points.contains(needed)) continue;
      return LeftOut{kind, name, "", reason(needed), place};
    }
    return std::nullopt;
  }

  void LeaveOutWhatNamesThem(const Points& points) {
    using Kind = LeftOut::Kind;
    Survey& survey = part_.survey;
    Prune(&survey.polygons, [&](const PolygonOutline& polygon) {
      return Undetermined(Kind::kPolygon, NoVertex, polygon.name, AllVertices(polygon),
                          polygon.place, points);
    });
    const auto of_pairs = [&](Kind kind) {
      return [&points, kind](const DirectionPair& pair) {
        return Undetermined(kind, NoPoint, Joined({pair.from, pair.to}), {pair.from, pair.to},
                            pair.place, points);
      };
    };
    Prune(&survey.sun_pairs, of_pairs(Kind::kSun));
    Prune(&survey.zenith_pairs, of_pairs(Kind::kZenith));
    Prune(&survey.edges, [&](const EdgeMark& edge) {
      auto fault = Undetermined(Kind::kEdge, NoEnd, Joined({edge.from, edge.to}),
                                {edge.from, edge.to}, edge.place, points);
      if (fault) fault->photo = edge.photo;
      return fault;
    });
    PruneConstraints(points);
  }

  void PruneConstraints(const Points& points) {
    std::set<std::string> polygons;
    for (const PolygonOutline& polygon : part_.survey.polygons) polygons.insert(polygon.name);
    Prune(&part_.survey.constraints, [&](const GeometricConstraint& c) -> std::optional<LeftOut> {
      const std::string name = Joined(c.polygons.empty() ? c.points : c.polygons);
      for (const std::string& polygon : c.polygons) {
        if (polygons.contains(polygon)) continue;
        return LeftOut{LeftOut::Kind::kConstraint, name, "", NoPolygon(polygon), c.place};
      }
      return Undetermined(LeftOut::Kind::kConstraint, NoPoint, name, c.points, c.place, points);
    });
  }

  // What would make the adjustment throw, or bend all the rest.
  void LeaveOutContradictions(const Points& points) {
    Prune(&part_.survey.polygons, [&](const PolygonOutline& polygon) -> std::optional<LeftOut> {
      Survey one;
      one.polygons = {polygon};
      try {
        RequirePlanar(one, points, options_.plane_sigma);
        return std::nullopt;
      } catch (const InputError& error) {
        return LeftOut{LeftOut::Kind::kPolygon, polygon.name,  "",
                       MessageOf(error),        polygon.place, true};
      }
    });
    PruneOpposingPairs(LeftOut::Kind::kSun, points, &part_.survey.sun_pairs);
    PruneOpposingPairs(LeftOut::Kind::kZenith, points, &part_.survey.zenith_pairs);
    Prune(&part_.survey.edges, [&](const EdgeMark& edge) -> std::optional<LeftOut> {
      if (Step(edge.from, edge.to, points).norm() > kApart) return std::nullopt;
      return LeftOut{
          LeftOut::Kind::kEdge, Joined({edge.from, edge.to}),
          edge.photo,           Sentence("edgeOnePlace", "its ends lie in the same place"),
          edge.place,           true};
    });
    Prune(&part_.survey.constraints, [&](const GeometricConstraint& c) -> std::optional<LeftOut> {
      if (c.kind == GeometricConstraint::Kind::kHeight) return std::nullopt;
      for (size_t i = 0; i + 1 < c.points.size(); i += 2) {
        if (Step(c.points[i], c.points[i + 1], points).norm() > kApart) continue;
        return LeftOut{LeftOut::Kind::kConstraint,
                       Joined(c.points),
                       "",
                       Sentence("constraintOnePlace", "its points lie in the same place"),
                       c.place,
                       true};
      }
      return std::nullopt;
    });
  }

  static Eigen::Vector3d Step(const std::string& from, const std::string& to,
                              const Points& points) {
    return points.at(to).position - points.at(from).position;
  }

  void PruneOpposingPairs(LeftOut::Kind kind, const Points& points,
                          std::vector<DirectionPair>* pairs) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const DirectionPair& pair : *pairs) sum += Step(pair.from, pair.to, points);
    Prune(pairs, [&](const DirectionPair& pair) -> std::optional<LeftOut> {
      if (Step(pair.from, pair.to, points).dot(sum) > 0) return std::nullopt;
      return LeftOut{
          kind,
          Joined({pair.from, pair.to}),
          "",
          Sentence("pairOpposed", "points away from the other pairs: are its ends exchanged?"),
          pair.place,
          true};
    });
  }

  void TakeStart(StartValues start) {
    std::vector<int> place(photos_.size(), -1);
    std::vector<PosedCamera> posed;
    for (size_t photo = 0; photo < photos_.size(); ++photo) {
      if (is_left_out_[photo]) continue;
      place[photo] = static_cast<int>(posed.size());
      posed.push_back(start.cameras[photo]);
      part_.photos.push_back(photos_[photo]);
      part_.indices.push_back(photo);
    }
    start.cameras = std::move(posed);
    for (StartTiePoint& point : start.tie_points) {
      for (StartTiePoint::Mark& mark : point.marks) mark.photo = place[mark.photo];
    }
    part_.start = std::move(start);
  }

  const std::vector<std::string>& photos_;
  const std::vector<Camera>& cameras_;
  const std::map<std::string, Rigid3>& initial_cam_from_world_;
  const AdjustmentOptions& options_;
  DeterminedPart part_;
  std::map<std::string, size_t> index_of_photo_;
  std::vector<bool> is_left_out_;      // by photo
  std::set<std::string> points_told_;  // points that left_out names
  std::map<std::string, FilePlace> place_of_point_, place_of_photo_;
  std::map<std::string, std::set<std::string>> photos_of_point_;
};

}  // namespace

const char* Word(LeftOut::Kind kind) {
  static const char* const kWords[] = {"photo",  "point", "polygon",    "sun",
                                       "zenith", "edge",  "constraint", "observation"};
  return kWords[static_cast<int>(kind)];
}

DeterminedPart FindDeterminedPart(const Survey& survey, const std::vector<std::string>& photos,
                                  const std::vector<Camera>& cameras,
                                  const std::map<std::string, Rigid3>& initial_cam_from_world,
                                  const AdjustmentOptions& options) {
  INSITU_CHECK(photos.size() == cameras.size());
  return PartFinder(survey, photos, cameras, initial_cam_from_world, options).Find();
}

}  // namespace insitu
