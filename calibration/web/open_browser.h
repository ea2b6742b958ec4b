// SPDX-License-Identifier: GPL-3.0-or-later
// A page in the user's browser, by an address that nobody else may see.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace insitu {

// Arguments of a program are seen by every user of the machine: what the browser is given is the
// name of a file that only this user can read, which leads on to `url`.
class OpenedPage {
 public:
  // Does nothing where there is no display. Throws nothing: print the address too, for browsers
  // that may not read the file.
  explicit OpenedPage(const std::string& url);
  ~OpenedPage();  // removes the file
  OpenedPage(const OpenedPage&) = delete;
  OpenedPage& operator=(const OpenedPage&) = delete;

  bool is_opened() const { return opener_ > 0; }  // xdg-open was started

 private:
  std::filesystem::path file_;
  int opener_ = 0;  // its process
};

}  // namespace insitu
