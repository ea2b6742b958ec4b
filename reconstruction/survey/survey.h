// SPDX-License-Identifier: GPL-3.0-or-later
// What the surveyor measured: control points, marks on photographs, polygons, directions; camera
// positions, edges and constraints where there are some. Each with the place in its file.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/sentence.h"
#include "reconstruction/survey/tie_points.h"

namespace insitu {

enum class ControlRole { kControl, kCheck };

// control_points.csv: name,x,y,z,sigma_x,sigma_y,sigma_z,role
struct ControlPoint {
  std::string name;
  Eigen::Vector3d position;  // [m], world
  Eigen::Vector3d sigma;     // [m], > 0
  ControlRole role = ControlRole::kControl;
  FilePlace place;
};

// observations.csv: photo,point,x,y,sigma
struct ImageObservation {
  std::string photo;
  std::string point;
  Eigen::Vector2d pixel;  // of the original photograph, distortion and all
  double sigma_px = 0;    // > 0
  FilePlace place;
};

// polygons.json
struct PolygonOutline {
  std::string name;
  std::vector<std::string> vertices;  // >= 3 distinct point names, counter-clockwise from outside
  std::optional<std::string> photo;   // the image attribute; nullopt: seen in no photo
  std::string material;
  std::optional<std::string> mask;  // a PNG in survey/, white where the polygon is really visible
  FilePlace place;
  std::vector<std::vector<std::string>> holes = {};  // each >= 3 names, whichever way they turn
};

// A polygon's point names: its outline's, then each hole's.
std::vector<std::string> AllVertices(const PolygonOutline& polygon);

// directions.json: a sun pair points from a shadow to the point that casts it, a zenith pair from
// bottom to top.
struct DirectionPair {
  std::string from, to;
  FilePlace place;
};

// camera_positions.csv: photo,x,y,z,sigma_x,sigma_y,sigma_z,role
// A surveyed centre of projection; role: fixed (taken as exact), weighted, or free (a start value).
enum class PositionRole { kFixed, kWeighted, kFree };
struct CameraPosition {
  std::string photo;
  Eigen::Vector3d position;  // [m], world
  Eigen::Vector3d sigma;     // [m], > 0
  PositionRole role = PositionRole::kWeighted;
  FilePlace place;
  // From the centre of projection to what was surveyed, an antenna, in the camera's axes [m].
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();
};

// edges.csv: photo,from,to,x,y,sigma. A pixel anywhere on the image of a straight edge.
struct EdgeMark {
  std::string photo, from, to;
  Eigen::Vector2d pixel;
  double sigma_px = 0;  // > 0
  FilePlace place;
};

// constraints.json: what is known of the site besides coordinates, each with its sigma.
struct GeometricConstraint {
  enum class Kind {
    kDistance,       // points: from, to; value [m]
    kHeight,         // points: from, to; value [m] along the zenith, 0: equal heights
    kVertical,       // polygons: one wall; or points: an edge
    kHorizontal,     // polygons: one floor; or points: an edge
    kParallel,       // polygons: two; or points: two edges
    kPerpendicular,  // polygons: two; or points: two edges
  };
  Kind kind;
  std::vector<std::string> polygons;  // one or two, or none
  std::vector<std::string> points;    // two or four (edge by edge), or none
  double value = 0;                   // [m], of distances and heights
  double sigma = 0;                   // [m] of distances and heights, else [rad]; > 0
  FilePlace place;
};

// The only mark of a point that is named nowhere else: one ray, which determines nothing.
struct LoneMark {
  ImageObservation mark;
  Sentence question;  // "; did you mean 'P7'?", or empty
};

struct Survey {
  std::vector<ControlPoint> control_points;
  std::vector<ImageObservation> observations;
  std::vector<PolygonOutline> polygons;
  std::vector<DirectionPair> sun_pairs;
  std::vector<DirectionPair> zenith_pairs;
  std::vector<CameraPosition> camera_positions;
  std::vector<EdgeMark> edges;
  std::vector<GeometricConstraint> constraints;
  std::optional<TiePoints> tie_points =
      {};                                 // in their own frame; of insitu-tie-points, if it was run
  std::vector<LoneMark> lone_marks = {};  // none of these is among the observations
};

// Points that a pair, an edge or a constraint joins.
struct JoinedPoints {
  std::string subject;  // "sun pair", "edge", ...
  std::vector<std::string> names;
  FilePlace place;
};
std::vector<JoinedPoints> JoinedByPairs(const Survey& survey);

// The points that are to be found: marked, vertices, ends of direction pairs and edges, or part of
// a constraint. Control points that nothing refers to are not among them.
std::set<std::string> PointsInUse(const Survey& survey);

// Where a point is first stated: its first mark, else its control row, polygon, direction pair,
// edge or constraint.
FilePlace PlaceOfPoint(const Survey& survey, const std::string& name);

// Where the marks stand, for faults that none of them is to blame for.
FilePlace FileOfObservations(const Survey& survey);

}  // namespace insitu
