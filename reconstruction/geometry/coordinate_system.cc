// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/coordinate_system.h"

#include <proj.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/text_table.h"

namespace insitu {
namespace {

struct Destroy {
  void operator()(PJ* object) const { proj_destroy(object); }
};
using Object = std::unique_ptr<PJ, Destroy>;

struct DestroyContext {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
using Context = std::unique_ptr<PJ_CONTEXT, DestroyContext>;

Context MakeContext() {
  Context context(proj_context_create());
  proj_context_set_enable_network(context.get(), 0);
  proj_log_level(context.get(), PJ_LOG_NONE);
  return context;
}

// OpenDroneMap's own words, as PROJ understands them.
std::string ForProj(const std::string& text) {
  const std::vector<std::string> words = SplitAtBlanks(text);
  if (words.empty() || (words[0] != "WGS84" && words[0] != "wgs84")) {
    return text.starts_with("+") && text.find("+type=crs") == std::string::npos
               ? text + " +type=crs"
               : text;
  }
  if (words.size() == 1) return "EPSG:4326";
  if (words.size() != 3 || words[1] != "UTM" || words[2].size() < 2) return text;
  const char hemisphere = words[2].back();
  const auto zone = ParseNumber(std::string_view(words[2]).substr(0, words[2].size() - 1));
  if (!zone || *zone < 1 || *zone > 60 || (hemisphere != 'N' && hemisphere != 'S')) return text;
  const int code = (hemisphere == 'N' ? 32600 : 32700) + static_cast<int>(*zone);
  return "EPSG:" + std::to_string(code);
}

// PROJ finds systems also by parts of their names; only a whole name is no accident.
bool IsAccident(const std::string& text, const PJ* system) {
  return text.find_first_of(":+[{") == std::string::npos && text != proj_get_name(system);
}

bool IsGeographic(PJ_TYPE type) {
  return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
}

struct Axis {
  std::string direction;
  double factor = 1;  // [m or rad] per unit
};

Axis AxisOf(PJ_CONTEXT* context, const PJ* system, int index) {
  const Object axes(proj_crs_get_coordinate_system(context, system));
  const char* direction = nullptr;
  Axis axis;
  if (axes && proj_cs_get_axis_info(context, axes.get(), index, nullptr, nullptr, &direction,
                                    &axis.factor, nullptr, nullptr, nullptr)) {
    axis.direction = direction;
  }
  return axis;
}

// Without what ties a system to another one.
Object Unbound(PJ_CONTEXT* context, Object system) {
  if (!system || proj_get_type(system.get()) != PJ_TYPE_BOUND_CRS) return system;
  return Object(proj_get_source_crs(context, system.get()));
}

struct Parts {
  Object horizontal;  // or three-dimensional
  std::optional<Axis> height;
};

Parts PartsOf(PJ_CONTEXT* context, Object system) {
  system = Unbound(context, std::move(system));
  if (!system) return {};
  if (proj_get_type(system.get()) == PJ_TYPE_COMPOUND_CRS) {
    const auto part = [&](int index) {
      return Unbound(context, Object(proj_crs_get_sub_crs(context, system.get(), index)));
    };
    const Object vertical = part(1);
    if (!vertical) return {part(0), std::nullopt};
    return {part(0), AxisOf(context, vertical.get(), 0)};
  }
  const Object axes(proj_crs_get_coordinate_system(context, system.get()));
  std::optional<Axis> height;
  if (axes && proj_cs_get_axis_count(context, axes.get()) == 3) {
    height = AxisOf(context, system.get(), 2);
  }
  return {std::move(system), height};
}

std::optional<Eigen::Vector3d> Converted(PJ* pipeline, const Eigen::Vector3d& xyz) {
  if (!pipeline) return std::nullopt;
  const PJ_COORD result =
      proj_trans(pipeline, PJ_FWD, proj_coord(xyz.x(), xyz.y(), xyz.z(), HUGE_VAL));
  const Eigen::Vector3d converted(result.xyz.x, result.xyz.y, result.xyz.z);
  return converted.allFinite() ? std::optional(converted) : std::nullopt;
}

}  // namespace

struct CoordinateSystem::Definition {
  Context context = MakeContext();
  Object whole;   // as it was given
  Object object;  // horizontal, or three-dimensional
  PJ_TYPE type = PJ_TYPE_UNKNOWN;
  Axis first_axis;
  std::optional<Axis> height;
};

CoordinateSystem::CoordinateSystem(std::shared_ptr<const Definition> definition)
    : definition_(std::move(definition)), name_(proj_get_name(definition_->object.get())) {}

std::optional<CoordinateSystem> CoordinateSystem::FromText(const std::string& text) {
  auto definition = std::make_shared<Definition>();
  PJ_CONTEXT* context = definition->context.get();
  const std::string for_proj = ForProj(text);
  Object object(proj_create(context, for_proj.c_str()));
  if (!object || IsAccident(for_proj, object.get())) return std::nullopt;
  definition->whole.reset(proj_clone(context, object.get()));
  auto [horizontal, height] = PartsOf(context, std::move(object));
  if (!horizontal) return std::nullopt;
  definition->type = proj_get_type(horizontal.get());
  const bool is_known = IsGeographic(definition->type) ||
                        definition->type == PJ_TYPE_PROJECTED_CRS ||
                        definition->type == PJ_TYPE_ENGINEERING_CRS;
  if (!is_known) return std::nullopt;
  definition->first_axis = AxisOf(context, horizontal.get(), 0);
  definition->height = height;
  definition->object = std::move(horizontal);
  return CoordinateSystem(std::move(definition));
}

// Norway's and Svalbard's wider zones are not made: theirs is the plain zone.
CoordinateSystem CoordinateSystem::UtmZone(double longitude_deg, double latitude_deg) {
  INSITU_CHECK(std::abs(longitude_deg) <= 180 && std::abs(latitude_deg) <= 90);
  const int zone = std::min(60, static_cast<int>(std::floor((longitude_deg + 180) / 6)) + 1);
  const int code = (latitude_deg < 0 ? 32700 : 32600) + zone;
  const auto system = FromText("EPSG:" + std::to_string(code));
  INSITU_CHECK(system.has_value());
  return *system;
}

std::string CoordinateSystem::Code() const {
  const PJ* object = definition_->object.get();
  const char* authority = proj_get_id_auth_name(object, 0);
  const char* code = proj_get_id_code(object, 0);
  if (authority && code) return std::string(authority) + ":" + code;
  const Context context = MakeContext();
  const char* text = proj_as_proj_string(context.get(), object, PJ_PROJ_4, nullptr);
  return text ? text : name_;
}

bool CoordinateSystem::is_geographic() const { return IsGeographic(definition_->type); }
bool CoordinateSystem::is_local() const { return definition_->type == PJ_TYPE_ENGINEERING_CRS; }

double CoordinateSystem::metres_per_unit() const {
  return is_geographic() ? 1 : definition_->first_axis.factor;
}

double CoordinateSystem::metres_per_height() const {
  const std::optional<Axis>& height = definition_->height;
  if (!height) return 1;
  return height->direction == "down" ? -height->factor : height->factor;
}

bool CoordinateSystem::has_north_first() const {
  return definition_->first_axis.direction == "north";
}

bool CoordinateSystem::operator==(const CoordinateSystem& other) const {
  return proj_is_equivalent_to(definition_->object.get(), other.definition_->object.get(),
                               PJ_COMP_EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS) != 0;
}

struct CoordinateConversion::Pipelines {
  Context context = MakeContext();
  Object flat, with_heights;  // null: PROJ knows no conversion
};

CoordinateConversion::CoordinateConversion(const CoordinateSystem& source,
                                           const CoordinateSystem& target) {
  auto pipelines = std::make_shared<Pipelines>();
  PJ_CONTEXT* context = pipelines->context.get();
  const auto between = [context](const Object& from, const Object& to) -> Object {
    const Object as_defined(
        proj_create_crs_to_crs_from_pj(context, from.get(), to.get(), nullptr, nullptr));
    if (!as_defined) return nullptr;
    return Object(proj_normalize_for_visualization(context, as_defined.get()));
  };
  pipelines->flat = between(source.definition_->object, target.definition_->object);
  pipelines->with_heights = between(source.definition_->whole, target.definition_->whole);
  pipelines_ = std::move(pipelines);
}

std::optional<Eigen::Vector2d> CoordinateConversion::operator()(const Eigen::Vector2d& xy) const {
  const auto converted = Converted(pipelines_->flat.get(), {xy.x(), xy.y(), 0});
  return converted ? std::optional<Eigen::Vector2d>(converted->head<2>()) : std::nullopt;
}

std::optional<Eigen::Vector3d> CoordinateConversion::WithHeight(const Eigen::Vector3d& xyz) const {
  return Converted(pipelines_->with_heights.get(), xyz);
}

}  // namespace insitu
