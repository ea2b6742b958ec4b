// SPDX-License-Identifier: GPL-3.0-or-later
// A DXF file cut into records. ASCII and binary files are read alike, a record at a time, so that a
// drawing of any size takes little memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/dxf/dxf_record.h"

namespace insitu {

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
    bool has_blank_before = false, has_blank_behind = false;  // that were trimmed away
  };
  static RawTag TagOf(int code, const std::string& text, std::string_view value, int64_t place);
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
  char line_end_ = '\n';  // CR alone in files of old Macintoshes
  std::string code_page_, written_, first_value_;
  int64_t first_place_ = 0;
  bool has_first_ = false;
  DxfRecord record_;
  std::vector<size_t> offsets_;  // of the record's values in its text
};

}  // namespace insitu
