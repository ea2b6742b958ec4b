// SPDX-License-Identifier: GPL-3.0-or-later
// Start values as they grow: each posed photo finds points, each found point may pose a photo or
// find others.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reconstruction/adjustment/start_values.h"
#include "reconstruction/geometry/intersection.h"
#include "reconstruction/geometry/plane.h"
#include "reconstruction/geometry/resection.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// The photos posed and the points known so far. Everything is looked up by name, and only what a
// change concerns is tried again. Arguments must outlive it; marks of photos that are not among
// `photos` are passed over.
class StartGrowth {
 public:
  StartGrowth(const Survey& survey, const std::vector<std::string>& photos,
              const std::vector<Camera>& cameras,
              const std::map<std::string, Rigid3>& initial_cam_from_world);

  // Control points in use become known; the other points in use are unknown. Warns of check points
  // that no photo shows.
  void TakeControl();

  // Photos that image matching placed stand where its model, moved into the world, has them. Where
  // too little control tells where that is, photos that show enough of their own are to be
  // resected. Throws InputError: control that contradicts the model.
  void PlaceByTiePoints();

  // Start values of the tie points on posed photos: in the world as aligned, else intersected.
  void TakeTiePoints();

  struct PhotoMarks {
    std::vector<ResectionPoint> known;  // those of known points
    const ImageObservation* first_known = nullptr;
    const ImageObservation* first = nullptr;  // of all
  };
  PhotoMarks MarksOf(size_t photo) const;

  // Whether the known points on a photo do not lie on one line.
  bool CanResect(size_t photo) const;

  // The pose that explains the marks becomes the photo's, which does not count as posed yet; a
  // user's estimate or a surveyed camera position picks among several.
  std::optional<Resections> Resect(size_t photo, const std::vector<ResectionPoint>& points);

  void SetPosed(size_t photo);
  bool IsPosed(size_t photo) const { return is_posed_[photo]; }

  // Strong intersections first, then planes, then weak intersections, until nothing changes.
  void FindPoints();

  // The photos not posed that show points found since the last call.
  std::set<size_t> TakeChangedPhotos();

  // How many posed photos show a point.
  size_t Rays(const std::string& point) const { return SightsOf(point).sights.size(); }

  const std::set<std::string>& unknown() const { return unknown_; }
  StartValues& values() { return values_; }

 private:
  struct PointSights {
    std::vector<Sight> sights;
    std::vector<double> sigmas_px;  // of their marks
  };
  PointSights SightsOf(const std::string& point) const;
  void SetKnown(const std::string& name, const StartPoint& point);
  std::optional<StartPoint> FromSights(const std::string& name, double min_angle) const;
  std::vector<Plane> PlanesThrough(const std::string& name) const;
  std::optional<StartPoint> FromPlanes(const std::string& name) const;
  template <typename Finder>
  bool FindEach(std::set<std::string>* changed, const Finder& find);

  const Survey& survey_;
  const std::map<std::string, Rigid3>& initial_cam_from_world_;
  StartValues values_;
  std::map<std::string, size_t> index_of_photo_;
  std::vector<std::vector<const ImageObservation*>> marks_on_;             // by photo
  std::map<std::string, std::vector<const ImageObservation*>> marks_of_;   // by point
  std::map<std::string, std::vector<const PolygonOutline*>> polygons_of_;  // by vertex
  std::vector<bool> is_posed_;
  std::set<std::string> unknown_;
  // Unknown points for which something changed since each way to find them was tried.
  std::set<std::string> strong_, on_planes_, weak_;
  std::set<size_t> changed_photos_;
  std::optional<TiePoints> aligned_;  // the tie points in the world, if their poses are used
};

}  // namespace insitu
