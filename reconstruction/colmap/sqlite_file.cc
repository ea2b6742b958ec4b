// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/sqlite_file.h"

#include <cmath>

namespace insitu {
namespace {

int Flags(SqliteFile::Mode mode) {
  switch (mode) {
    case SqliteFile::Mode::kRead:
      return SQLITE_OPEN_READONLY;
    case SqliteFile::Mode::kChange:
      return SQLITE_OPEN_READWRITE;
    case SqliteFile::Mode::kCreate:
      break;
  }
  return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
}

}  // namespace

SqliteFile::SqliteFile(const std::filesystem::path& path, Mode mode) : path_(path) {
  sqlite3* handle = nullptr;
  const int status = sqlite3_open_v2(path.c_str(), &handle, Flags(mode), nullptr);
  handle_.reset(handle);
  if (status != SQLITE_OK) throw InputError(path, "cannot be opened, expected a SQLite database");
  sqlite3_extended_result_codes(handle, 1);
}

InputError SqliteFile::Error(const std::string& message) const {
  return InputError(path_, message + " (SQLite: " + sqlite3_errmsg(get()) + ")");
}

void SqliteFile::Execute(const std::string& sql) {
  if (sqlite3_exec(get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
    throw Error("cannot be worked on, expected a whole SQLite database of COLMAP");
  }
}

SqliteStatement::SqliteStatement(SqliteFile* file, std::string table, const std::string& sql)
    : file_(file), table_(std::move(table)) {
  sqlite3_stmt* statement = nullptr;
  const int status = sqlite3_prepare_v2(file->get(), sql.c_str(), -1, &statement, nullptr);
  statement_.reset(statement);
  if (status != SQLITE_OK) {
    throw file->Error("table " + table_ + " cannot be read, expected a database of COLMAP");
  }
}

bool SqliteStatement::Step() {
  const int status = sqlite3_step(statement_.get());
  row_ += 1;
  if (status == SQLITE_ROW) return true;
  if (status == SQLITE_DONE) return false;
  throw file_->Error("table " + table_ + ", row " + std::to_string(row_) +
                     " cannot be read or written, expected a whole database");
}

void SqliteStatement::Reset() {
  sqlite3_reset(statement_.get());
  sqlite3_clear_bindings(statement_.get());
}

InputError SqliteStatement::Error(const std::string& message) const {
  return InputError(file_->path(),
                    "table " + table_ + ", row " + std::to_string(row_) + ": " + message);
}

int64_t SqliteStatement::Integer(int column) const {
  if (sqlite3_column_type(statement_.get(), column) != SQLITE_INTEGER) {
    throw Error(std::string(sqlite3_column_name(statement_.get(), column)) + " is no whole number");
  }
  return sqlite3_column_int64(statement_.get(), column);
}

std::optional<double> SqliteStatement::Real(int column) const {
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) return std::nullopt;
  const double value = sqlite3_column_double(statement_.get(), column);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string SqliteStatement::Text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  return text ? std::string(text) : std::string();
}

std::string_view SqliteStatement::Blob(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return bytes ? std::string_view(bytes, static_cast<size_t>(size)) : std::string_view();
}

void SqliteStatement::Bind(int parameter, int64_t value) {
  INSITU_CHECK(sqlite3_bind_int64(statement_.get(), parameter, value) == SQLITE_OK);
}
void SqliteStatement::Bind(int parameter, double value) {
  INSITU_CHECK(sqlite3_bind_double(statement_.get(), parameter, value) == SQLITE_OK);
}
void SqliteStatement::Bind(int parameter, const std::string& text) {
  INSITU_CHECK(sqlite3_bind_text(statement_.get(), parameter, text.data(),
                                 static_cast<int>(text.size()), SQLITE_TRANSIENT) == SQLITE_OK);
}
void SqliteStatement::BindBlob(int parameter, std::string_view bytes) {
  INSITU_CHECK(sqlite3_bind_blob64(statement_.get(), parameter, bytes.data(), bytes.size(),
                                   SQLITE_TRANSIENT) == SQLITE_OK);
}

}  // namespace insitu
