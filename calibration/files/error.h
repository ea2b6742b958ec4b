// SPDX-License-Identifier: GPL-3.0-or-later
// The three kinds of error. Expected failure is a std::optional; bad input is an InputError with
// file and line; a caller's mistake is a CheckError.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace insitu {

// Where in a file a statement was made.
struct FilePlace {
  std::filesystem::path path;
  int line = 0;  // 0: the file as a whole
};

// Bad input. what() reads "file:line: message"; without a line (line <= 0) "file: message".
// Programs print it and exit with status 2.
class InputError : public std::runtime_error {
 public:
  InputError(const std::filesystem::path& file, int line, const std::string& message);
  InputError(const std::filesystem::path& file, const std::string& message)
      : InputError(file, 0, message) {}
};

// A broken precondition: a mistake of the calling code, never of the user.
class CheckError : public std::logic_error {
 public:
  CheckError(const char* file, int line, const char* condition);
};

}  // namespace insitu

#define INSITU_CHECK(condition)                                                   \
  do {                                                                            \
    if (!(condition)) throw ::insitu::CheckError(__FILE__, __LINE__, #condition); \
  } while (false)
