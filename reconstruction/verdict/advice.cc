// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict/advice.h"

namespace insitu {
namespace {

using Kind = ObservationKind;

std::string InQuotes(const std::string& name) { return "'" + name + "'"; }

std::string Axis(const ObservationResidual& row) { return std::string(1, "xyz"[row.axis]); }

}  // namespace

std::string Group(const ObservationResidual& row) {
  switch (row.kind) {
    case Kind::kImage:
      return "image " + Axis(row);
    case Kind::kEdge:
      return "edge";
    case Kind::kControl:
      return "control " + Axis(row);
    case Kind::kCameraPosition:
      return "camera " + Axis(row);
    case Kind::kLens:
      return "lens";
    case Kind::kPlane:
      return "plane";
    case Kind::kSun:
      return "sun";
    case Kind::kZenith:
      return "zenith";
    case Kind::kDistance:
      return "distance";
    case Kind::kHeight:
      return "height";
    case Kind::kAngle:
      break;
  }
  return "angle";
}

std::string Subject(const ObservationResidual& row) {
  return row.kind == Kind::kPlane ? row.polygon + " " + row.subject : row.subject;
}

std::string Describe(const ObservationResidual& row) {
  const std::string subject = InQuotes(Subject(row)), photo = InQuotes(row.photo);
  switch (row.kind) {
    case Kind::kImage:
      return (row.is_tie_point ? "tie point " : "mark ") + subject + " on photo " + photo + " (" +
             Axis(row) + ")";
    case Kind::kEdge:
      return "edge " + subject + " on photo " + photo;
    case Kind::kControl:
      return "control point " + subject + " (" + Axis(row) + ")";
    case Kind::kCameraPosition:
      return "surveyed position of photo " + photo + " (" + Axis(row) + ")";
    case Kind::kLens:
      return "calibrated " + subject;
    default:
      return Group(row) + " " + subject;
  }
}

std::string Advice(const ObservationResidual& row) {
  const std::string subject = InQuotes(Subject(row)), photo = InQuotes(row.photo);
  if (row.is_tie_point) {
    return "image matching took two places for one: run insitu-tie-points with a smaller --points, "
           "which keeps those of most rays, or mark some points by hand on photo " +
           photo;
  }
  switch (row.kind) {
    case Kind::kImage:
      return "measure mark " + subject + " on photo " + photo +
             " again; if it was right, make sure that the other photos' marks of " + subject +
             " show the same place";
    case Kind::kEdge:
      return "measure edge " + subject + " on photo " + photo + " again";
    case Kind::kControl:
      return "check the surveyed coordinates of " + subject +
             " (typing error, swapped axes, another point?) and its marks";
    case Kind::kCameraPosition:
      return "check the surveyed position of photo " + photo +
             ": is it the lens that was measured?";
    case Kind::kLens:
      return "the site contradicts the lens's calibration: make sure that focus, zoom and camera "
             "are those of the boards, and look for the fault among marks and control first";
    case Kind::kPlane:
      return "make sure that the vertex of " + subject +
             " (polygon and vertex) lies in that plane; a wall that bulges needs a larger plane "
             "sigma or two polygons";
    case Kind::kSun:
      return "make sure that " + subject + " are a shadow and the point that casts it";
    case Kind::kZenith:
      return "make sure that " + subject + " stand plumb over each other";
    default:
      return "check the " + Group(row) + " of " + subject + " in constraints.json";
  }
}

}  // namespace insitu
