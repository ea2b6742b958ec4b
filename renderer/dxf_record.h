// SPDX-License-Identifier: GPL-3.0-or-later
// DXF as text: pairs of group code and value, gathered into records that begin with code 0.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/error.h"

namespace insitu {

struct DxfTag {
  int code;                // group code
  std::string_view value;  // blanks trimmed
  int line;                // of the value
};

// An entity, a table entry, or the head of a section. Every accessor throws InputError at the
// value's line when the value is not what is asked for.
class DxfRecord {
 public:
  // `tags` begins with a code 0; both arguments outlive the record.
  DxfRecord(const std::filesystem::path& file, std::span<const DxfTag> tags)
      : file_(&file), tags_(tags) {}

  std::string_view kind() const { return tags_.front().value; }
  int line() const { return tags_.front().line; }
  std::span<const DxfTag> tags() const { return tags_; }

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
  const std::filesystem::path* file_;
  std::span<const DxfTag> tags_;
};

// A whole ASCII drawing, up to and including its EOF. Comments (999) are left out.
class DxfFile {
 public:
  // Throws InputError: unreadable, binary DXF or DWG, a group code that is no number, no EOF.
  explicit DxfFile(const std::filesystem::path& path);
  DxfFile(const DxfFile&) = delete;
  DxfFile& operator=(const DxfFile&) = delete;

  std::span<const DxfRecord> records() const { return records_; }

 private:
  void SplitIntoTags();
  void GatherRecords();

  std::filesystem::path path_;
  std::string text_;  // the tags look into it
  std::vector<DxfTag> tags_;
  std::vector<DxfRecord> records_;
};

// A name as UTF-8. Drawings before 2007 carry a code page: bytes that are no UTF-8 are read as
// Windows-1252 (Western European); \U+XXXX becomes its character in any drawing.
std::string Utf8FromDxf(std::string_view text);

}  // namespace insitu
