// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/coordinate_system.h"

#include <proj.h>

#include <cmath>

#include "calibration/files/error.h"
#include "reconstruction/geometry/coordinate_system.h"

namespace insitu {
namespace {

// Vertices are metres by now: PROJ would take them for what the system counts in.
void RequireMetres(const std::filesystem::path& file, const std::string& name) {
  const auto system = CoordinateSystem::FromText(name);
  if (!system) return;  // PROJ's way to the other one tells
  const bool is_metric = !system->is_geographic() &&
                         std::abs(system->metres_per_unit() - 1) < 1e-12 &&
                         std::abs(system->metres_per_height() - 1) < 1e-12;
  if (is_metric) return;
  throw InputError(file, "the coordinate system \"" + name +
                             "\" is not in metres, heights included; expected a projected one in "
                             "metres, such as EPSG:2056");
}

}  // namespace

struct CoordinateTransformation::Proj {
  PJ_CONTEXT* context = nullptr;
  PJ* transformation = nullptr;
  ~Proj() {
    proj_destroy(transformation);
    proj_context_destroy(context);
  }
};

CoordinateTransformation::CoordinateTransformation(const std::filesystem::path& file,
                                                   const std::string& from, const std::string& to)
    : file_(file), names_(from + " to " + to), proj_(std::make_unique<Proj>()) {
  RequireMetres(file, from);
  RequireMetres(file, to);
  proj_->context = proj_context_create();
  proj_context_set_enable_network(proj_->context, 0);
  proj_log_level(proj_->context, PJ_LOG_NONE);
  PJ* raw = proj_create_crs_to_crs(proj_->context, from.c_str(), to.c_str(), nullptr);
  if (!raw) {
    throw InputError(file, "PROJ knows no way from \"" + from + "\" to \"" + to +
                               "\", expected names such as EPSG:2056");
  }
  proj_->transformation = proj_normalize_for_visualization(proj_->context, raw);  // east first
  proj_destroy(raw);
}

CoordinateTransformation::~CoordinateTransformation() = default;

Eigen::Vector3d CoordinateTransformation::Apply(const Eigen::Vector3d& point) const {
  const PJ_COORD result = proj_trans(proj_->transformation, PJ_FWD,
                                     proj_coord(point.x(), point.y(), point.z(), HUGE_VAL));
  const Eigen::Vector3d image(result.xyz.x, result.xyz.y, result.xyz.z);
  if (!image.allFinite()) {
    throw InputError(file_, "PROJ cannot take (" + std::to_string(point.x()) + ", " +
                                std::to_string(point.y()) + ") from " + names_);
  }
  return image;
}

}  // namespace insitu
