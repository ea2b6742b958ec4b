// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/dxf/dxf_record.h"

#include <Eigen/Geometry>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "calibration/files/plain_text.h"
#include "calibration/files/wording.h"
#include "renderer/dxf/dxf_name.h"

namespace insitu {
namespace {

constexpr double kLargestNumber = 1e12;

template <typename T>
std::optional<T> Parsed(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  T value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

InputError DxfPlace::Error(const std::string& message) const {
  if (binary) return InputError(file, "byte " + std::to_string(place) + ": " + message);
  return InputError(file, static_cast<int>(place), message);
}

DxfPlace DxfRecord::place() const { return {*file_, binary_, tags_.front().place}; }

const DxfTag* DxfRecord::Find(int code) const {
  for (const DxfTag& tag : tags_) {
    if (tag.code == code) return &tag;
  }
  return nullptr;
}

std::string DxfRecord::Name(int code, const std::string& if_absent) const {
  const DxfTag* tag = Find(code);
  return tag ? Utf8FromDxf(tag->value, *code_page_) : if_absent;
}

int DxfRecord::Integer(int code, int if_absent) const {
  const DxfTag* tag = Find(code);
  return tag ? IntegerOf(*tag) : if_absent;
}

double DxfRecord::Number(int code, double if_absent) const {
  const DxfTag* tag = Find(code);
  return tag ? NumberOf(*tag) : if_absent;
}

std::optional<Eigen::Vector3d> DxfRecord::FindPoint(int code) const {
  const DxfTag* x = Find(code);
  if (!x) return std::nullopt;
  const DxfTag* y = Find(code + 10);
  if (!y) {
    throw ErrorAt(*x, "group " + std::to_string(code) + " (x) has no group " +
                          std::to_string(code + 10) + " (y) beside it");
  }
  return Eigen::Vector3d(NumberOf(*x), NumberOf(*y), Number(code + 20, 0));
}

Eigen::Vector3d DxfRecord::Point(int code) const {
  const std::optional<Eigen::Vector3d> point = FindPoint(code);
  if (!point) {
    throw Error(std::string(kind()) + " has no point, expected one at group " +
                std::to_string(code));
  }
  return *point;
}

// Programs also write "7.0", and colours of 32 bits without a sign.
int DxfRecord::IntegerOf(const DxfTag& tag) const {
  constexpr double kLowest = -2147483648.0, kHighest = 4294967295.0;
  const std::optional<double> value = Parsed<double>(tag.value);
  if (!value || !(*value >= kLowest && *value <= kHighest) || std::trunc(*value) != *value) {
    throw ErrorAt(
        tag, Quoted(tag.value) + ", expected an integer for group " + std::to_string(tag.code));
  }
  return static_cast<int>(static_cast<uint32_t>(static_cast<int64_t>(*value)));
}

double DxfRecord::NumberOf(const DxfTag& tag) const {
  const std::optional<double> value = Parsed<double>(tag.value);
  if (IsNoNumber(tag.value)) {
    throw DxfNoNumber(ErrorAt(tag, Quoted(tag.value) + ", expected a number"));
  }
  if (!value || !(std::abs(*value) <= kLargestNumber)) {
    throw ErrorAt(tag, Quoted(tag.value) + ", expected a number of at most 1e12 for group " +
                           std::to_string(tag.code));
  }
  return *value;
}

InputError DxfRecord::Error(const std::string& message) const {
  return ErrorAt(tags_.front(), message);
}

InputError DxfRecord::ErrorAt(const DxfTag& tag, const std::string& message) const {
  return DxfPlace{*file_, binary_, tag.place}.Error(message);
}

Eigen::Matrix3d DxfEntityAxes(const DxfRecord& entity) {
  const std::optional<Eigen::Vector3d> extrusion = entity.FindPoint(210);
  if (!extrusion) return Eigen::Matrix3d::Identity();
  if (extrusion->norm() == 0) {
    throw entity.ErrorAt(*entity.Find(210), "an extrusion direction of no length");
  }
  const Eigen::Vector3d z = extrusion->normalized();
  const bool near_world_z = std::abs(z.x()) < 1.0 / 64 && std::abs(z.y()) < 1.0 / 64;
  const Eigen::Vector3d x =
      (near_world_z ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ()).cross(z).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

}  // namespace insitu
