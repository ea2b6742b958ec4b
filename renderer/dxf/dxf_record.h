// SPDX-License-Identifier: GPL-3.0-or-later
// DXF as pairs of group code and value, gathered into records that begin with code 0. ASCII and
// binary files are read alike, a record at a time, so that a drawing of any size takes little
// memory.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <fstream>
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

// Reads records up to and including EOF. Comments (999) are left out.
class DxfReader {
 public:
  // Throws InputError: unreadable, a DWG or no DXF at all, an ASCII file without an EOF at its end.
  explicit DxfReader(const std::filesystem::path& path);
  DxfReader(const DxfReader&) = delete;
  DxfReader& operator=(const DxfReader&) = delete;

  // The next record, valid until the next call; nullptr after EOF. Throws InputError: a group code
  // that is no number, a file that ends without EOF.
  const DxfRecord* Next();

  bool binary() const { return binary_; }
  // Of names in drawings before 2007 ($DWGCODEPAGE), e.g. "ANSI_1252".
  void SetCodePage(const std::string& code_page) { code_page_ = code_page; }

 private:
  struct RawTag {
    int code;
    std::string_view value;  // until the next read
    int64_t place;
  };
  RawTag ReadTag();
  RawTag ReadBinaryTag();
  void AppendBinaryValue(int code, std::string* text);
  std::string_view ReadLine();  // blanks trimmed
  bool Refill();
  std::string_view Take(size_t count);
  template <typename T>
  T TakeNumber();
  void CheckItsEnd();
  [[noreturn]] void ThrowCutShort();
  void AddTag(const RawTag& tag);
  void FinishRecord();

  std::filesystem::path path_;
  std::ifstream stream_;
  std::string buffer_;
  size_t next_ = 0;       // in the buffer
  int64_t consumed_ = 0;  // bytes before the buffer
  int64_t line_ = 0;
  bool binary_ = false, long_codes_ = true, at_eof_ = false;
  std::string code_page_, written_, first_value_;
  int64_t first_place_ = 0;
  bool has_first_ = false;
  DxfRecord record_;
  std::vector<size_t> offsets_;  // of the record's values in its text
};

// Text for a message: short, in quotes, and printable whatever the file holds.
std::string QuotedDxf(std::string_view text);

// A name as UTF-8. Bytes that are no UTF-8 are read in the drawing's code page (ANSI_1250 to 1258,
// 874, 932, 936, 949, 950; else Windows-1252); \U+XXXX becomes its character in any drawing.
std::string Utf8FromDxf(std::string_view text, const std::string& code_page = "ANSI_1252");

}  // namespace insitu
