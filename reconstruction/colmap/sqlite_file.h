// SPDX-License-Identifier: GPL-3.0-or-later
// A SQLite file with our kind of errors; the only header that meets sqlite3.h.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "calibration/files/error.h"

namespace insitu {

class SqliteFile {
 public:
  enum class Mode { kRead, kChange, kCreate };
  SqliteFile(const std::filesystem::path& path, Mode mode);

  void Execute(const std::string& sql);
  InputError Error(const std::string& message) const;  // file and SQLite's own words
  const std::filesystem::path& path() const { return path_; }
  sqlite3* get() const { return handle_.get(); }

 private:
  struct Closer {
    void operator()(sqlite3* handle) const { sqlite3_close(handle); }
  };
  std::filesystem::path path_;
  std::unique_ptr<sqlite3, Closer> handle_;
};

// One prepared statement; columns count from 0, parameters from 1.
class SqliteStatement {
 public:
  // `table` names what is read or written, for messages.
  SqliteStatement(SqliteFile* file, std::string table, const std::string& sql);

  bool Step();   // false: no further row
  void Reset();  // to bind and run again

  InputError Error(const std::string& message) const;  // names file, table and row

  int64_t Integer(int column) const;
  std::optional<double> Real(int column) const;  // nullopt: NULL or not finite
  std::string Text(int column) const;
  std::string_view Blob(int column) const;  // valid until the next Step; empty for NULL

  void Bind(int parameter, int64_t value);
  void Bind(int parameter, double value);
  void Bind(int parameter, const std::string& text);
  void BindBlob(int parameter, std::string_view bytes);

 private:
  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  SqliteFile* file_;
  std::string table_;
  int row_ = 0;
  std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
};

}  // namespace insitu
