// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/coordinate_system.h"

#include <proj.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibration/error.h"
#include "reconstruction/text_table.h"

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

Axis FirstAxis(PJ_CONTEXT* context, const PJ* system) {
  const Object axes(proj_crs_get_coordinate_system(context, system));
  const char* direction = nullptr;
  Axis axis;
  if (axes && proj_cs_get_axis_info(context, axes.get(), 0, nullptr, nullptr, &direction,
                                    &axis.factor, nullptr, nullptr, nullptr)) {
    axis.direction = direction;
  }
  return axis;
}

}  // namespace

struct CoordinateSystem::Definition {
  Context context = MakeContext();
  Object object;
  PJ_TYPE type = PJ_TYPE_UNKNOWN;
  Axis first_axis;
};

CoordinateSystem::CoordinateSystem(std::shared_ptr<const Definition> definition)
    : definition_(std::move(definition)), name_(proj_get_name(definition_->object.get())) {}

std::optional<CoordinateSystem> CoordinateSystem::FromText(const std::string& text) {
  auto definition = std::make_shared<Definition>();
  PJ_CONTEXT* context = definition->context.get();
  const std::string for_proj = ForProj(text);
  Object object(proj_create(context, for_proj.c_str()));
  if (!object || IsAccident(for_proj, object.get())) return std::nullopt;
  if (proj_get_type(object.get()) == PJ_TYPE_BOUND_CRS) {
    object.reset(proj_get_source_crs(context, object.get()));
  }
  if (object && proj_get_type(object.get()) == PJ_TYPE_COMPOUND_CRS) {
    object.reset(proj_crs_get_sub_crs(context, object.get(), 0));
  }
  if (!object) return std::nullopt;
  definition->type = proj_get_type(object.get());
  const bool is_known = IsGeographic(definition->type) ||
                        definition->type == PJ_TYPE_PROJECTED_CRS ||
                        definition->type == PJ_TYPE_ENGINEERING_CRS;
  if (!is_known) return std::nullopt;
  definition->first_axis = FirstAxis(context, object.get());
  definition->object = std::move(object);
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

bool CoordinateSystem::has_north_first() const {
  return definition_->first_axis.direction == "north";
}

bool CoordinateSystem::operator==(const CoordinateSystem& other) const {
  return proj_is_equivalent_to(definition_->object.get(), other.definition_->object.get(),
                               PJ_COMP_EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS) != 0;
}

std::optional<Eigen::Vector2d> CoordinateSystem::Convert(const CoordinateSystem& source,
                                                         const CoordinateSystem& target,
                                                         const Eigen::Vector2d& xy) {
  const Context context = MakeContext();
  const Object as_defined(
      proj_create_crs_to_crs_from_pj(context.get(), source.definition_->object.get(),
                                     target.definition_->object.get(), nullptr, nullptr));
  if (!as_defined) return std::nullopt;
  const Object east_first(proj_normalize_for_visualization(context.get(), as_defined.get()));
  if (!east_first) return std::nullopt;
  const PJ_COORD result =
      proj_trans(east_first.get(), PJ_FWD, proj_coord(xy.x(), xy.y(), 0, HUGE_VAL));
  if (!std::isfinite(result.xy.x) || !std::isfinite(result.xy.y)) return std::nullopt;
  return Eigen::Vector2d(result.xy.x, result.xy.y);
}

}  // namespace insitu
