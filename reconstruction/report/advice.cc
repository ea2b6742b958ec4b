// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/advice.h"

namespace insitu {
namespace {

std::string Quoted(const std::string& name) { return "'" + name + "'"; }

}  // namespace

std::string Describe(const ObservationResidual& row) {
  if (row.group.starts_with("image")) {
    return std::string(row.is_tie_point ? "tie point " : "mark ") + Quoted(row.subject) +
           " on photo " + Quoted(row.photo) + " (" + row.group.back() + ")";
  }
  if (row.group == "edge") {
    return "edge " + Quoted(row.subject) + " on photo " + Quoted(row.photo);
  }
  if (row.group.starts_with("control")) {
    return "control point " + Quoted(row.subject) + " (" + row.group.back() + ")";
  }
  if (row.group.starts_with("camera")) {
    return "surveyed position of photo " + Quoted(row.photo) + " (" + row.group.back() + ")";
  }
  if (row.group == "lens") return "calibrated " + Quoted(row.subject);
  return row.group + " " + Quoted(row.subject);
}

std::string Advice(const ObservationResidual& row) {
  const std::string subject = Quoted(row.subject), photo = Quoted(row.photo);
  if (row.is_tie_point) {
    return "image matching took two places for one: run insitu-tie-points with a smaller --points, "
           "which keeps those of most rays, or mark some points by hand on photo " +
           photo;
  }
  if (row.group.starts_with("image")) {
    return "measure mark " + subject + " on photo " + photo +
           " again; if it was right, make sure that the other photos' marks of " + subject +
           " show the same place";
  }
  if (row.group == "edge") return "measure edge " + subject + " on photo " + photo + " again";
  if (row.group.starts_with("control")) {
    return "check the surveyed coordinates of " + subject +
           " (typing error, swapped axes, another point?) and its marks";
  }
  if (row.group.starts_with("camera")) {
    return "check the surveyed position of photo " + photo + ": is it the lens that was measured?";
  }
  if (row.group == "lens") {
    return "the site contradicts the lens's calibration: make sure that focus, zoom and camera are "
           "those of the boards, and look for the fault among marks and control first";
  }
  if (row.group == "plane") {
    return "make sure that the vertex of " + subject +
           " (polygon and vertex) lies in that plane; a wall that bulges needs a larger plane "
           "sigma or two polygons";
  }
  if (row.group == "sun") {
    return "make sure that " + subject + " are a shadow and the point that casts it";
  }
  if (row.group == "zenith") return "make sure that " + subject + " stand plumb over each other";
  return "check the " + row.group + " of " + subject + " in constraints.json";
}

}  // namespace insitu
