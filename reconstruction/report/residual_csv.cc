// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/residual_csv.h"

#include <charconv>
#include <optional>

#include "reconstruction/verdict/advice.h"

namespace insitu {
namespace {

// Quoted where RFC 4180 asks for it.
std::string Field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

// The same in every locale; empty where nothing is known.
std::string Field(std::optional<double> value) {
  if (!value) return "";
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, *value, std::chars_format::general, 12);
  return std::string(text, end.ptr);
}

template <typename... Fields>
std::string Line(const Fields&... fields) {
  std::string line;
  ((line += Field(fields) + ","), ...);
  line.back() = '\n';
  return line;
}

}  // namespace

std::string ObservationsCsv(const Adjustment& adjustment) {
  std::string csv =
      "group,photo,subject,is_tie_point,observed,residual,sigma,redundancy,w,detectable,external,"
      "point_shift_m\n";
  for (const ObservationResidual& row : adjustment.residuals) {
    csv += Line(Group(row), row.photo, Subject(row), std::string(row.is_tie_point ? "1" : "0"),
                row.observed, row.residual, row.sigma, row.redundancy, row.w, row.detectable,
                row.external, row.point_shift_m);
  }
  return csv;
}

std::string PointsCsv(const Adjustment& adjustment) {
  std::string csv = "name,is_tie_point,x,y,z,var_x,var_y,var_z,cov_xy,cov_xz,cov_yz,rays,rms_px\n";
  for (const AdjustedPoint& point : adjustment.points) {
    const Eigen::Vector3d& x = point.position;
    const Eigen::Matrix3d& c = point.covariance;
    csv += Line(point.name, std::string(point.is_tie_point ? "1" : "0"), x[0], x[1], x[2], c(0, 0),
                c(1, 1), c(2, 2), c(0, 1), c(0, 2), c(1, 2), static_cast<double>(point.rays),
                point.rms_px);
  }
  return csv;
}

}  // namespace insitu
