// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/files/whole_file.h"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "calibration/files/error.h"

namespace insitu {
namespace fs = std::filesystem;

void WriteWhole(const fs::path& target,
                const std::function<void(const fs::path& temporary)>& write) {
  if (target.has_parent_path()) fs::create_directories(target.parent_path());
  fs::path temporary = target.parent_path() / ".";
  temporary += target.stem();
  temporary += ".";
  temporary += std::to_string(getpid());
  temporary += target.extension();
  try {
    write(temporary);
    fs::rename(temporary, target);
  } catch (...) {
    std::error_code ignored;  // the first failure is the one to report
    fs::remove(temporary, ignored);
    throw;
  }
}

void WriteWhole(const fs::path& target, const std::string& content) {
  WriteWhole(target, [&](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << content;
    stream.close();
    if (!stream) throw std::runtime_error(target.string() + ": cannot be written");
  });
}

std::string ReadWhole(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || fs::is_directory(path)) throw InputError(path, "cannot be read");
  std::string content{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw InputError(path, "cannot be read");
  return content;
}

}  // namespace insitu
