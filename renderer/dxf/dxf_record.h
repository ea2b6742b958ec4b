// SPDX-License-Identifier: GPL-3.0-or-later
// DXF as pairs of group code and value, gathered into records that begin with code 0.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/files/error.h"

namespace insitu {

struct DxfTag {
  int code;                // group code
  std::string_view value;  // blanks trimmed; of a binary file, the value written out
  int64_t place;           // of the value: line of an ASCII file, byte of a binary one
  bool has_blank_before = false, has_blank_behind = false;  // that were trimmed away
};

// What programs write in the place of a number ("nan", "-1.#IND"): it costs its entity.
struct DxfNoNumber : InputError {
  explicit DxfNoNumber(const InputError& error) : InputError(error) {}
};

// Where a record stands, for messages after it is gone.
struct DxfPlace {
  std::filesystem::path file;
  bool binary = false;
  int64_t place = 0;

  InputError Error(const std::string& message) const;  // to be thrown
};

// An entity, a table entry, or the head of a section. Every accessor throws InputError at the
// value's place when the value is not what is asked for.
class DxfRecord {
 public:
  std::string_view kind() const { return tags_.front().value; }
  std::span<const DxfTag> tags() const { return tags_; }
  DxfPlace place() const;

  const DxfTag* Find(int code) const;                                   // the first; or nullptr
  std::string Name(int code, const std::string& if_absent = "") const;  // as UTF-8
  int Integer(int code, int if_absent) const;
  double Number(int code, double if_absent) const;  // finite
  // x at `code`, y at `code` + 10, z at `code` + 20 (0 if absent); nullopt without an x.
  std::optional<Eigen::Vector3d> FindPoint(int code) const;
  Eigen::Vector3d Point(int code) const;  // must be there

  int IntegerOf(const DxfTag& tag) const;
  // Finite, and no larger than any plausible drawing: |value| <= 1e12, so that no sum or product
  // of coordinates overflows.
  double NumberOf(const DxfTag& tag) const;

  InputError Error(const std::string& message) const;  // about this record, to be thrown
  InputError ErrorAt(const DxfTag& tag, const std::string& message) const;

 private:
  friend class DxfReader;
  const std::filesystem::path* file_ = nullptr;
  bool binary_ = false;
  const std::string* code_page_ = nullptr;
  std::vector<char> text_;  // the tags look into it; a vector's content stays when it is moved
  std::vector<DxfTag> tags_;
};

// The axes of an entity's own coordinate system, as columns, from its extrusion direction (group
// 210; z if absent), by AutoCAD's arbitrary axis algorithm. Throws InputError: a zero direction.
Eigen::Matrix3d DxfEntityAxes(const DxfRecord& entity);

}  // namespace insitu
